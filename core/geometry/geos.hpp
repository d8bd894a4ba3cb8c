#pragma once

#include "geometry/outlines.hpp"

#include <memory>
#include <string>
#include <vector>

#define GEOS_USE_ONLY_R_API
#include <geos_c.h>

namespace talus {

/// What is used of GEOS, with geometries that free themselves. Failures come as std::runtime_error in its
/// words. GEOS promises no order of what it returns: whoever asks must sort.
class Geos {
 public:
  struct Destroy {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

  Geos();
  ~Geos();
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  Geometry line(const std::vector<Vec2>& points) const;
  Geometry points(const std::vector<Vec2>& points) const;
  Geometry polygon(const Loops& loops) const;
  Geometry collection(int type, std::vector<Geometry> parts) const;

  /// All lines of a collection together, with a vertex wherever they meet; on a grid so wide, m, that all
  /// vertices are moved to, which no rounding upsets, or where they are: 0.
  Geometry noded(const GEOSGeometry& lines, double grid) const;
  /// The bounded faces between lines that are noded; ends that lead nowhere bound none.
  std::vector<Loops> faces(const GEOSGeometry& lines) const;
  /// The union of polygons whose common sides have the same vertices.
  std::vector<Loops> joined(const std::vector<const Loops*>& polygons) const;
  /// The sides of the Voronoi cells of points, as far as they are near the box around `around`.
  std::vector<std::vector<Vec2>> voronoi_sides(const std::vector<Vec2>& points, const Ring& around) const;
  /// Some point within.
  Vec2 point_within(const Loops& polygon) const;

  /// A geometry that a call of GEOS has made, or its failure.
  Geometry taken(GEOSGeometry* geometry) const;
  GEOSContextHandle_t context() const { return context_; }

 private:
  std::vector<Vec2> points_of(const GEOSGeometry* line) const;
  std::vector<Loops> polygons_of(const GEOSGeometry& collection) const;
  GEOSCoordSequence* sequence(const std::vector<Vec2>& points, bool closed) const;
  Geometry ring(const Ring& ring) const;

  GEOSContextHandle_t context_;
  mutable std::string failure_;
};

}  // namespace talus
