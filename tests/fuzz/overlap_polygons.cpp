#include "targets.hpp"

#include "conformance/boundary_arrays.hpp"
#include "geometry/convex_pieces.hpp"
#include "geometry/geos.hpp"
#include "geometry/triangulate.hpp"
#include "given_polygon.hpp"

#include <talus/overlap/cells.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

namespace talus::fuzz {

namespace {

using conformance::BoundaryArrays;

/// What GEOS says, m²; nothing where it fails. With corners on a grid of so many metres where that is not 0.
std::optional<double> area_by_geos(const Ring& a, const Ring& b, double grid) {
  const Geos geos;
  try {
    const auto first = geos.polygon({a}), second = geos.polygon({b});
    const auto both =
        geos.taken(grid == 0 ? GEOSIntersection_r(geos.context(), first.get(), second.get())
                             : GEOSIntersectionPrec_r(geos.context(), first.get(), second.get(), grid));
    double area = 0;
    GEOSArea_r(geos.context(), both.get(), &area);
    return area;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// The least distance of a corner to a side that does not end in it, m: where it is well above rounding,
/// every polygon can be cut.
double smallest_feature(const Ring& ring) {
  double least = extent({ring});
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 from = ring[i], to = ring[(i + 1) % ring.size()], along = to - from;
    for (const Vec2 corner : ring) {
      const Vec2 away = corner - from;
      const double share = std::clamp(dot(away, along) / dot(along, along), 0.0, 1.0);
      const double distance = std::hypot(away.x - share * along.x, away.y - share * along.y);
      if (size_of(away) > 0 && size_of(corner - to) > 0) least = std::min(least, distance);
    }
  }
  return least;
}

/// Nothing where the polygon is too fine to be cut.
std::optional<std::vector<ConvexPiece>> pieces_of(const Ring& ring, double size, double rounding) {
  Loop outer{ring, {}};
  outer.surface_class.assign(ring.size(), 0);
  std::vector<ConvexPiece> pieces;
  try {
    pieces = convex_pieces(outer, {});
  } catch (const Indivisible& refusal) {
    demand(smallest_feature(ring) < 1e-6 * size, refusal.what());
    return std::nullopt;
  }
  double sum = 0;
  for (const ConvexPiece& piece : pieces) {
    Ring corners;
    for (const PieceCorner& corner : piece) corners.push_back(corner.at);
    sum += signed_area(corners);
  }
  const double area = signed_area(ring);
  demand(std::abs(sum - area) <= rounding, fmt::format("pieces of {} m2 of a polygon of {}", sum, area));
  return pieces;
}

/// The area that contact laws see, m².
double area_by_pieces(const std::vector<ConvexPiece>& a, const std::vector<ConvexPiece>& b) {
  std::vector<conformance::HeldBody> bodies(2);
  bodies[0].pieces = a;
  bodies[1].pieces = b;
  const BoundaryArrays arrays(bodies);
  overlap::OverlapFinder finder;
  double area = 0;
  for (std::uint32_t p = 0; p < arrays.body_piece[1]; ++p) {
    for (std::uint32_t q = arrays.body_piece[1]; q < arrays.body_piece[2]; ++q) {
      const overlap::Piece first(arrays.view(), p, {0, 0}, 0), second(arrays.view(), q, {0, 0}, 0);
      const overlap::Polygon& common = finder.find(first, second);
      if (!common.empty()) area += overlap::area_centroid(common).area;
    }
  }
  return area;
}

void check_triangles(const Ring& ring, double rounding) {
  double sum = 0;
  for (const auto& [i, j, k] : triangulate({ring})) {
    demand(i < ring.size() && j < ring.size() && k < ring.size(), "a triangle without a corner");
    sum += std::abs(cross(ring[j] - ring[i], ring[k] - ring[i])) / 2;
  }
  demand(std::abs(sum - signed_area(ring)) <= rounding,
         fmt::format("triangles of {} m2 fill a polygon of {}", sum, signed_area(ring)));
}

std::string written(const Ring& ring) {
  std::string all;
  for (const Vec2 at : ring) all += fmt::format("[{}, {}], ", at.x, at.y);
  return all;
}

void check_pair(const Ring& a, const Ring& b) {
  const double size = std::max({extent({a}), extent({b}), std::abs(a[0].x), std::abs(a[0].y)});
  const double rounding = 1e-10 * size * size;
  check_triangles(a, rounding);
  std::optional<double> due = area_by_geos(a, b, 0);
  if (!due) return;
  // Of sides that lie on each other but for rounding GEOS 3.11 may lose all that is common; not on a grid.
  const auto ask_again_about = [&](double area) {
    if (std::abs(area - *due) > rounding) due = area_by_geos(a, b, 1e-9 * size);
    return due.has_value();
  };
  const auto of_a = pieces_of(a, size, rounding), of_b = pieces_of(b, size, rounding);
  if (of_a && of_b) {
    const double pieces = area_by_pieces(*of_a, *of_b);
    if (!ask_again_about(pieces)) return;
    demand(std::abs(pieces - *due) <= 1e-8 * size * size,
           fmt::format("pieces overlap by {} m2, GEOS says {}", pieces, *due));
  }
  const Loops first{a}, second{b};
  const std::vector<BodyOverlap> told = overlapping_bodies({&first, &second});
  if (!ask_again_about(told.empty() ? 0 : told[0].area)) return;
  if (told.empty()) {
    demand(*due <= 1e-5 * size * size, fmt::format("bodies that overlap by {} m2 pass", *due));
  } else {
    demand(std::abs(told[0].area - *due) <= 1e-8 * size * size,
           fmt::format("bodies overlap by {} m2, GEOS says {}", told[0].area, *due));
  }
}

}  // namespace

void overlap_polygons(std::string_view bytes) {
  GivenPolygons given(bytes);
  const Ring a = given.next(), b = given.next();
  if (!shape_faults({a}).empty() || !shape_faults({b}).empty()) return;
  try {
    check_pair(a, b);
  } catch (const std::exception& problem) {
    demand(false, fmt::format("{}\na: {}\nb: {}", problem.what(), written(a), written(b)));
  }
}

}  // namespace talus::fuzz
