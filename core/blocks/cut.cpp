#include "blocks/cut.hpp"

#include "blocks/faces.hpp"
#include "blocks/line_ends.hpp"
#include "blocks/loose_ends.hpp"
#include "blocks/pinches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace talus {
namespace {

// Shares of the domain's size.
constexpr double reach_of_size = 1e-8;        // by which ends of lines are lengthened
constexpr double thinnest_of_size = 1e-7;     // width below which a block is a sliver, well above the reach
constexpr double grids[] = {0, 1e-10, 1e-9};  // that vertices are moved to, the first that does
constexpr double idle = 1e-10;                // off a straight side that a vertex is left out of
constexpr double hairline = 1e-11;            // width of a face that rounding alone made

// Share of the square around the domain by which faces may miss its area: less than any block that is none.
constexpr double lost = 1e-8;

Vec2 beyond(Vec2 before, Vec2 end, double length) {
  const double dx = end.x - before.x, dy = end.y - before.y, whole = std::hypot(dx, dy);
  return {end.x + dx / whole * length, end.y + dy / whole * length};
}

/// A line with both ends lengthened, so that one which ends on another within rounding cuts it. The ends
/// stay vertices: lines that share one still do. What leads nowhere bounds no face.
std::vector<Vec2> lengthened(const std::vector<Vec2>& points, double length) {
  const std::size_t last = points.size() - 1;
  if (points[0].x == points[last].x && points[0].y == points[last].y) return points;
  std::vector<Vec2> all{beyond(points[1], points[0], length)};
  all.insert(all.end(), points.begin(), points.end());
  all.push_back(beyond(points[last - 1], points[last], length));
  return all;
}

double area_of(const Loops& loops) {
  return std::accumulate(loops.begin(), loops.end(), 0.0,
                         [](double sum, const Ring& ring) { return sum + signed_area(ring); });
}

/// What lies within the domain, of voids, too.
std::vector<Block> faces_within(const Block& domain, const GEOSGeometry& lines, double grid,
                                const Geos& geos) {
  std::vector<Block> faces;
  for (Loops& loops : geos.faces(*geos.noded(lines, grid))) {
    if (!contains(domain.loops, geos.point_within(loops), 0)) continue;
    orient(faces.emplace_back(Block{std::move(loops), {}, 0, {}}));
  }
  return faces;
}

/// Where two lines all but lie on each other, rounding decides where they cross: hairlines lie between them,
/// and faces beside those may be lost. Then all vertices are moved to a grid.
std::vector<Block> faces_of(const CutOrder& order, const std::vector<Cut>& cuts, double size,
                            const Geos& geos) {
  std::vector<Geos::Geometry> parts;
  for (const Ring& ring : order.domain.loops) {
    Ring closed = ring;
    closed.push_back(ring[0]);
    parts.push_back(geos.line(closed));
  }
  for (const Cut& cut : cuts) parts.push_back(geos.line(lengthened(cut.points, reach_of_size * size)));
  const Geos::Geometry lines = geos.collection(GEOS_MULTILINESTRING, std::move(parts));
  const double domain = area_of(order.domain.loops);
  for (const double grid : grids) {
    std::vector<Block> faces = faces_within(order.domain, *lines, grid * size, geos);
    double sum = 0;
    for (const Block& face : faces) sum += face.area;
    const auto is_hairline = [&](const Block& face) {
      return 2 * face.area < hairline * size * perimeter_of(face.loops);
    };
    if (std::abs(sum - domain) > lost * size * size) continue;
    if (grid == 0 && std::any_of(faces.begin(), faces.end(), is_hairline)) continue;
    if (order.is_void)
      std::erase_if(faces, [&](const Block& face) { return order.is_void(geos.point_within(face.loops)); });
    return faces;
  }
  throw std::runtime_error(
      "the lines cannot be cut into faces that fill the domain: some of them nearly coincide; move them "
      "apart or onto each other");
}

}  // namespace

CutDomain cut_domain(const CutOrder& order, const Geos& geos) {
  const Box box = box_around(order.domain.loops[0]);
  const double size = box.size();
  const double farthest =
      std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  const double tolerance = idle * size + 0x1p-50 * farthest;
  const bool drawn =
      std::any_of(order.cuts.begin(), order.cuts.end(), [](const Cut& cut) { return cut.drawn; });
  std::optional<SidesByPlace> sides;
  if (drawn) sides.emplace(order.cuts, order.domain, reach_of_size * size, geos);
  const std::vector<Cut> cuts =
      drawn ? joined_ends(order.cuts, order.domain, *sides, reach_of_size * size) : order.cuts;
  std::vector<Block> faces = faces_of(order, cuts, size, geos);
  sort_blocks(faces, 1e-9 * size);
  CutDomain made;
  made.pieces = faces.size();
  if (drawn) made.loose_ends = loose_ends(ends_of(order.cuts), faces, *sides, reach_of_size * size);
  double sum = 0;
  for (const Block& face : faces) sum += face.area;
  const double mean = faces.empty() ? 0 : sum / static_cast<double>(faces.size());
  const double smallest = std::max(order.smallest_area, order.smallest_share * mean);
  std::vector<Block>& blocks = made.blocks;
  blocks = merge_small_faces(std::move(faces), smallest, thinnest_of_size * size, geos);
  made.left_out = sum;
  for (const Block& block : blocks) made.left_out -= block.area;
  if (made.left_out < lost * size * size) made.left_out = 0;
  const Bridged bridged = bridge_pinches(blocks, 10 * reach_of_size * size, geos);
  made.bridged = bridged.points;
  for (Block& block : blocks) orient(block);
  made.names_of_one_line =
      name_edges(blocks, order.domain, cuts, bridged.chords, 10 * reach_of_size * size, geos);
  drop_idle_vertices(blocks, tolerance);
  for (const Block& block : blocks) {
    if (std::abs(area_of(block.loops) - block.area) > lost * size * size)
      throw std::runtime_error("a block loses its shape where vertices all but coincide: move lines apart");
  }
  sort_blocks(blocks, 1e-9 * size);
  if (order.split_share == 0) return made;
  split_quadrilaterals(blocks, order.split_share, order.split_seed, smallest, thinnest_of_size * size);
  for (Block& block : blocks) orient(block);
  sort_blocks(blocks, 1e-9 * size);
  return made;
}

}  // namespace talus
