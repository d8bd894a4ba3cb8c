#include "blocks/cut.hpp"

#include "blocks/faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {
namespace {

// Shares of the domain's size.
constexpr double reach = 1e-8;             // by which ends of lines are lengthened
constexpr double thinnest_of_size = 1e-7;  // width below which a block is a sliver, well above the reach
constexpr double rounding = 1e-12;         // what crossings may lie off the lines that they are on

Vec2 beyond(Vec2 before, Vec2 end, double length) {
  const double dx = end.x - before.x, dy = end.y - before.y, whole = std::hypot(dx, dy);
  return {end.x + dx / whole * length, end.y + dy / whole * length};
}

/// A line with both ends lengthened, so that one which ends on another within rounding cuts it. The old ends
/// stay vertices: lines that share one still do. What leads nowhere bounds no face.
std::vector<Vec2> lengthened(const std::vector<Vec2>& points, double length) {
  const std::size_t last = points.size() - 1;
  if (points[0].x == points[last].x && points[0].y == points[last].y) return points;
  std::vector<Vec2> all{beyond(points[1], points[0], length)};
  all.insert(all.end(), points.begin(), points.end());
  all.push_back(beyond(points[last - 1], points[last], length));
  return all;
}

std::vector<Block> faces_of(const CutOrder& order, double size, const Geos& geos) {
  std::vector<Geos::Geometry> lines;
  for (const Ring& ring : order.domain.loops) {
    Ring closed = ring;
    closed.push_back(ring[0]);
    lines.push_back(geos.line(closed));
  }
  for (const Cut& cut : order.cuts) lines.push_back(geos.line(lengthened(cut.points, reach * size)));
  std::vector<Block> faces;
  for (Loops& loops : geos.faces(*geos.noded(std::move(lines)))) {
    const Vec2 within = geos.point_within(loops);
    if (!contains(order.domain.loops, within, 0) || (order.is_void && order.is_void(within))) continue;
    orient(faces.emplace_back(Block{std::move(loops), {}, 0, {}}));
  }
  return faces;
}

}  // namespace

std::vector<Block> cut_domain(const CutOrder& order, const Geos& geos) {
  const Box box = box_around(order.domain.loops[0]);
  const double size = box.size();
  const double farthest =
      std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  const double tolerance = rounding * size + 0x1p-50 * farthest;
  std::vector<Block> faces = faces_of(order, size, geos);
  sort_blocks(faces, 1e-9 * size);
  double sum = 0;
  for (const Block& face : faces) sum += face.area;
  const double mean = faces.empty() ? 0 : sum / static_cast<double>(faces.size());
  const double smallest = std::max(order.smallest_area, order.smallest_share * mean);
  std::vector<Block> blocks = merge_small_faces(std::move(faces), smallest, thinnest_of_size * size, geos);
  for (Block& block : blocks) orient(block);
  name_edges(blocks, order.domain, order.cuts, 10 * reach * size, geos);
  for (Block& block : blocks) drop_idle_vertices(block, tolerance);
  sort_blocks(blocks, 1e-9 * size);
  if (order.split_share == 0) return blocks;
  split_quadrilaterals(blocks, order.split_share, order.split_seed, smallest);
  for (Block& block : blocks) orient(block);
  sort_blocks(blocks, 1e-9 * size);
  return blocks;
}

}  // namespace talus
