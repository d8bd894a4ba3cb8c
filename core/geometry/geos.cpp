#include "geometry/geos.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace talus {
namespace {

void keep_failure(const char* message, void* failure) {
  *static_cast<std::string*>(failure) = message;
}

}  // namespace

Geos::Geos() : context_(GEOS_init_r()) {
  GEOSContext_setErrorMessageHandler_r(context_, keep_failure, &failure_);
}

Geos::~Geos() {
  GEOS_finish_r(context_);
}

Geos::Geometry Geos::taken(GEOSGeometry* geometry) const {
  if (geometry == nullptr) throw std::runtime_error(fmt::format("GEOS: {}", failure_));
  return {geometry, Destroy{context_}};
}

GEOSCoordSequence* Geos::sequence(const std::vector<Vec2>& points, bool closed) const {
  std::vector<double> flat;
  for (const Vec2 point : points) flat.insert(flat.end(), {point.x, point.y});
  if (closed) flat.insert(flat.end(), {points[0].x, points[0].y});
  GEOSCoordSequence* made =
      GEOSCoordSeq_copyFromBuffer_r(context_, flat.data(), static_cast<unsigned>(flat.size() / 2), 0, 0);
  if (made == nullptr) throw std::runtime_error(fmt::format("GEOS: {}", failure_));
  return made;
}

Geos::Geometry Geos::line(const std::vector<Vec2>& points) const {
  return taken(GEOSGeom_createLineString_r(context_, sequence(points, false)));
}

Geos::Geometry Geos::points(const std::vector<Vec2>& points) const {
  std::vector<Geometry> all;
  for (const Vec2 point : points)
    all.push_back(taken(GEOSGeom_createPointFromXY_r(context_, point.x, point.y)));
  return collection(GEOS_MULTIPOINT, std::move(all));
}

Geos::Geometry Geos::ring(const Ring& ring) const {
  return taken(GEOSGeom_createLinearRing_r(context_, sequence(ring, true)));
}

Geos::Geometry Geos::polygon(const Loops& loops) const {
  std::vector<Geometry> rings;
  for (const Ring& loop : loops) rings.push_back(ring(loop));
  std::vector<GEOSGeometry*> bare;
  for (Geometry& each : rings) bare.push_back(each.release());
  return taken(
      GEOSGeom_createPolygon_r(context_, bare[0], bare.data() + 1, static_cast<unsigned>(bare.size() - 1)));
}

Geos::Geometry Geos::collection(int type, std::vector<Geometry> parts) const {
  std::vector<GEOSGeometry*> bare;
  for (Geometry& part : parts) bare.push_back(part.release());
  return taken(GEOSGeom_createCollection_r(context_, type, bare.data(), static_cast<unsigned>(bare.size())));
}

Geos::Geometry Geos::noded(const GEOSGeometry& lines, double grid) const {
  return taken(grid > 0 ? GEOSUnaryUnionPrec_r(context_, &lines, grid) : GEOSUnaryUnion_r(context_, &lines));
}

std::vector<Vec2> Geos::points_of(const GEOSGeometry* line) const {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_, line);
  unsigned count = 0;
  GEOSCoordSeq_getSize_r(context_, sequence, &count);
  std::vector<double> flat(2 * std::size_t{count});
  GEOSCoordSeq_copyToBuffer_r(context_, sequence, flat.data(), 0, 0);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({flat[2 * i], flat[2 * i + 1]});
  return points;
}

std::vector<Loops> Geos::polygons_of(const GEOSGeometry& collection) const {
  std::vector<Loops> all;
  const int count = GEOSGetNumGeometries_r(context_, &collection);
  for (int i = 0; i < count; ++i) {
    const GEOSGeometry* polygon = GEOSGetGeometryN_r(context_, &collection, i);
    if (GEOSGeomTypeId_r(context_, polygon) != GEOS_POLYGON) continue;
    Loops& loops = all.emplace_back();
    loops.push_back(points_of(GEOSGetExteriorRing_r(context_, polygon)));
    const int holes = GEOSGetNumInteriorRings_r(context_, polygon);
    for (int hole = 0; hole < holes; ++hole)
      loops.push_back(points_of(GEOSGetInteriorRingN_r(context_, polygon, hole)));
    for (Ring& ring : loops) ring.pop_back();  // it repeats the first
  }
  return all;
}

std::vector<Loops> Geos::faces(const GEOSGeometry& lines) const {
  const GEOSGeometry* const all[] = {&lines};
  return polygons_of(*taken(GEOSPolygonize_r(context_, all, 1)));
}

std::vector<Loops> Geos::joined(const std::vector<const Loops*>& polygons) const {
  std::vector<Geometry> parts;
  for (const Loops* loops : polygons) parts.push_back(polygon(*loops));
  const Geometry all = collection(GEOS_MULTIPOLYGON, std::move(parts));
  return polygons_of(*taken(GEOSCoverageUnion_r(context_, all.get())));
}

std::vector<std::vector<Vec2>> Geos::voronoi_sides(const std::vector<Vec2>& points,
                                                   const Ring& around) const {
  const Geometry sites = this->points(points), box = line(around);
  const Geometry sides = taken(GEOSVoronoiDiagram_r(context_, sites.get(), box.get(), 0, 1));
  std::vector<std::vector<Vec2>> all;
  const int count = GEOSGetNumGeometries_r(context_, sides.get());
  for (int i = 0; i < count; ++i) {
    const GEOSGeometry* side = GEOSGetGeometryN_r(context_, sides.get(), i);
    if (GEOSisEmpty_r(context_, side) == 0) all.push_back(points_of(side));
  }
  return all;
}

Vec2 Geos::point_within(const Loops& loops) const {
  const Geometry shape = polygon(loops);
  const Geometry point = taken(GEOSPointOnSurface_r(context_, shape.get()));
  Vec2 at;
  GEOSGeomGetX_r(context_, point.get(), &at.x);
  GEOSGeomGetY_r(context_, point.get(), &at.y);
  return at;
}

}  // namespace talus
