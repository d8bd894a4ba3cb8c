// A body that does not deform: three unknowns, no patch, no stress (DEM). See README.md beside.

#include <talus/library.hpp>

namespace {

using namespace talus;

class Rigid final : public CoverBuilder {
 public:
  explicit Rigid(const double* /*values*/) {}

  void build(const BodyShape& body, CoverSink& sink) const noexcept override {
    if (body.discontinuities.line_count > 0) {
      sink.refuse("a rigid body cannot be cut by discontinuities; take the cover \"hexagonal\"");
      return;
    }
    sink.make_rigid();
  }
};

constexpr Component components[] = {cover_builder<Rigid>(
    "rigid", "A body of three unknowns that does not deform and carries no stress.", {})};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("rigid", "0.1.0", "the talus authors", components);
