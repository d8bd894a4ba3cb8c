// The cover my_component. See README.md beside.

#include <talus/library.hpp>

#include <cmath>

namespace {

class MyComponent final : public talus::CoverBuilder {
 public:
  explicit MyComponent(const double* /*values*/) {}

  void build(const talus::BodyShape& body, talus::CoverSink& sink) const noexcept override {
    const talus::Region& outline = body.outline;
    if (body.discontinuities.line_count > 0) {
      sink.refuse("one element cannot be cut by discontinuities");
      return;
    }
    double width = 0, height = 0;
    for (std::uint32_t i = 0; i < outline.ring_start[1]; ++i) {
      width = std::fmax(width, std::abs(outline.x[i]));
      height = std::fmax(height, std::abs(outline.y[i]));
    }
    // ---- the cover: these lines are yours
    // ---------------------------------------------------------------------- One triangle around the
    // rectangle of 2 width x 2 height about the reference centre, and the body as its element.
    const std::uint32_t patches[3] = {sink.add_patch(-2 * width, -height), sink.add_patch(2 * width, -height),
                                      sink.add_patch(0, 3 * height)};
    sink.add_element(patches, outline);
    // ---- a body of several elements needs its boundary, too: CoverSink::add_boundary_vertex
    // --------------------------
  }
};

constexpr talus::Component components[] = {talus::cover_builder<MyComponent>(
    "my_component", "One triangle of three patches around each body: uniform strain.", {})};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("my_component", "0.1.0", "its author", components);
