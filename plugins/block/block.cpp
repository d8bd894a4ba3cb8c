// One equilateral triangle of three patches around each body: an affine block, the first-order block of DDA
// (§5 of the paper, Fig. 16). See README.md beside.

#include <talus/library.hpp>

#include <cmath>

namespace {

using namespace talus;

constexpr Parameter parameters[] = {
    number("strain_mass_scale", "-", 1, 1, 1e6,
           "How many times as heavy strain is as motion without strain, which keeps its mass and inertia: a "
           "longer "
           "step (selective mass scaling)."),
};

class Block final : public CoverBuilder {
 public:
  explicit Block(const double* values) : strain_mass_scale_(values[0]) {}

  /// The triangle is circumscribed to the circle about the centroid that reaches the farthest vertex.
  void build(const BodyShape& body, CoverSink& sink) const noexcept override {
    const Region& outline = body.outline;
    if (body.discontinuities.line_count > 0) {
      sink.refuse("one element cannot be cut by discontinuities; take the cover \"hexagonal\"");
      return;
    }
    double squared_radius = 0;
    for (std::uint32_t i = 0; i < outline.ring_start[1]; ++i) {
      squared_radius = std::fmax(squared_radius, outline.x[i] * outline.x[i] + outline.y[i] * outline.y[i]);
    }
    const double inradius = std::sqrt(squared_radius);
    const double half_side = std::sqrt(3.0) * inradius;
    const std::uint32_t patches[3] = {sink.add_patch(-half_side, -inradius),
                                      sink.add_patch(half_side, -inradius), sink.add_patch(0, 2 * inradius)};
    sink.add_element(patches, outline);
    if (strain_mass_scale_ != 1) sink.scale_strain_mass(strain_mass_scale_);
  }

 private:
  double strain_mass_scale_;
};

constexpr Component components[] = {cover_builder<Block>(
    "block", "One triangle of three patches around each body: a block with uniform strain (first-order DDA).",
    parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("block", "0.1.0", "the talus authors", components);
