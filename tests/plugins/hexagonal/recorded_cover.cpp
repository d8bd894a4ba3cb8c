#include "recorded_cover.hpp"

#include "plugin/registry.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
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

double outline_length(const DrawnBody& body) {
  double sum = 0;
  for (const Line& ring : body.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(ring[i], ring[(i + 1) % ring.size()]);
  }
  return sum;
}

double boundary_length(const RecordedCover& cover) {
  double sum = 0;
  for (const auto& loop : cover.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) sum += distance(loop[i].at, loop[(i + 1) % loop.size()].at);
  }
  return sum;
}

bool segments_cross(Point p, Point q, Point r, Point s) {
  const auto side = [](Point from, Point to, Point at) {
    return (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x);
  };
  return side(p, q, r) * side(p, q, s) <= 0 && side(r, s, p) * side(r, s, q) <= 0;
}

Line reversed(Line line) {
  std::reverse(line.begin(), line.end());
  return line;
}

std::vector<double> row_sums(const RecordedCover& cover) {
  std::vector<double> sums(cover.stars.size(), 0);
  for (std::uint32_t e = 0; e < cover.elements.size(); ++e) {
    const AreaMoments m = moments_of(cover.elements[e].rings);
    const auto w = cover.weights(e, {m.x / m.area, m.y / m.area});
    for (std::size_t k = 0; k < 3; ++k) sums[cover.elements[e].patch[k]] += m.area * w[k];
  }
  return sums;
}

}  // namespace talus::covered
