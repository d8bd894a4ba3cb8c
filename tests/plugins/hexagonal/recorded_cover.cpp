#include "recorded_cover.hpp"

#include "plugin/registry.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <numbers>

namespace talus::covered {

using std::numbers::pi;

RecordedCover lay(const DrawnBody& body, const Settings& settings) {
  const RegisteredComponent* found = shipped_registry().find(ComponentKind::cover_builder, "hexagonal");
  REQUIRE(found != nullptr);
  const Point c = body.centroid();
  const auto builder = make<CoverBuilder>(
      *found, std::array{settings.size, settings.vertex.x - c.x, settings.vertex.y - c.y,
                         settings.angle * pi / 180, settings.slivers, settings.sliver_share});
  RecordedCover cover;
  builder->build(body.shape(), cover);
  return cover;
}

}  // namespace talus::covered
