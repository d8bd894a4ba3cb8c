// The regular triangular lattice of hexagonal patches over any body (§2.2 of the paper). See README.md
// beside.

#include "arrangement.hpp"
#include "connectivity.hpp"
#include "faces.hpp"
#include "lattice.hpp"
#include "noding.hpp"
#include "rings.hpp"
#include "slivers.hpp"

#include <talus/library.hpp>

#include <cmath>
#include <exception>
#include <new>
#include <utility>
#include <vector>

namespace {

using namespace talus;
using namespace talus::hexagonal;

constexpr Parameter parameters[] = {
    number("size", "m", required, 1e-300, 1e300, "Side of the equilateral triangles of the lattice."),
    number("offset_x", "m", 0, -1e300, 1e300, "Place of a lattice vertex from the centroid of the body, x."),
    number("offset_y", "m", 0, -1e300, 1e300, "Place of a lattice vertex from the centroid of the body, y."),
    number("angle", "deg", 0, -360, 360, "How far the lattice is turned from the x axis."),
    choice(
        "slivers", "merge|mass_scale|keep", 0,
        "What becomes of patches with little of the body: they follow their neighbours, or deviations from "
        "that get inertia, or nothing is done."),
    number("sliver_share", "-", 0.1, 0, 0.5,
           "Share of a full hexagon's mass below which a patch has little."),
};

/// Everything is worked out before the first word to the sink.
struct Cover {
  Connectivity connectivity;
  Regions regions;
  Boundary boundary;
  std::vector<Point> stars;
  std::vector<Steadied> steadied;
};

/// Of any number, also of one that no choice has.
Slivers treatment_of(double choice) {
  if (choice == 1) return Slivers::mass_scale;
  return choice == 2 ? Slivers::keep : Slivers::merge;
}

class Hexagonal final : public CoverBuilder {
 public:
  explicit Hexagonal(const double* values)
      : size_(values[0]),
        vertex_{values[1], values[2]},
        angle_(values[3]),
        treatment_(treatment_of(values[4])),
        share_(values[5]) {}

  void build(const BodyShape& body, CoverSink& sink) const noexcept override {
    try {
      hand_over(cover(body), sink);
    } catch (const std::bad_alloc&) {
      sink.refuse("there is not enough memory for that many triangles; take a larger size");
    } catch (const std::exception& problem) {
      sink.refuse(problem.what());
    } catch (...) {
      sink.refuse("the cover threw something that is no std::exception");
    }
  }

 private:
  Cover cover(const BodyShape& body) const {
    const Lattice lattice(size_, vertex_, angle_);
    for (const std::int64_t tolerance : tolerances) {
      try {
        return cover(body, lattice, tolerance);
      } catch (const TooClose&) {
        continue;
      }
    }
    throw TooClose();
  }

  Cover cover(const BodyShape& body, const Lattice& lattice, std::int64_t tolerance) const {
    Arrangement arrangement = arrange(body, lattice, tolerance);
    if (!is_in_order(arrangement, lattice)) throw TooClose();
    const Faces faces = make_faces(std::move(arrangement));
    Cover made;
    made.connectivity = connect(faces);
    if (made.connectivity.elements.empty()) {
      throw Refusal("nothing of the body is left on so large a lattice; take a smaller size");
    }
    made.regions = regions(faces, made.connectivity);
    const double slack = 4 * static_cast<double>(tolerance) / static_cast<double>(unit);
    if (!is_sound(made, lattice, body, slack)) throw TooClose();
    made.boundary = boundary(faces, made.connectivity);
    for (const LatticeVertex& vertex : made.connectivity.patches) {
      made.stars.push_back(lattice.point(vertex));
    }
    const double full = std::sqrt(3.0) / 2 * size_ * size_;
    made.steadied =
        steady_slivers(made.connectivity, made.stars, row_sums(made.connectivity, made.regions, made.stars),
                       full, treatment_, share_);
    return made;
  }

  /// Whether all regions have an area, together that of the body, and none leaves its triangle.
  static bool is_sound(const Cover& made, const Lattice& lattice, const BodyShape& body, double slack) {
    double squared_radius = 0;
    for (std::uint32_t i = 0; i < body.outline.ring_start[1]; ++i) {
      const double x = body.outline.x[i], y = body.outline.y[i];
      squared_radius = std::fmax(squared_radius, x * x + y * y);
    }
    double sum = 0, lost = 0;  // compensated: a million equal areas round in the same direction
    for (std::size_t e = 0; e < made.connectivity.elements.size(); ++e) {
      const Region region = made.regions.of(e);
      const double part = moments_about({region.x[0], region.y[0]}, region).area;
      if (part <= 0) return false;
      const double before = sum;
      sum += part + lost;
      lost += part - (sum - before);
      for (std::uint32_t i = 0; i < region.ring_start[region.ring_count]; ++i) {
        const LatticePoint at = lattice.place({region.x[i], region.y[i]});
        if (depth_in(made.connectivity.elements[e].triangle, at) < -slack) return false;
      }
    }
    // The area of a slender body is itself known only to the rounding of its coordinates.
    return std::fabs(sum - body.moments.area) <= 1e-11 * body.moments.area + 1e-14 * squared_radius;
  }

  static void hand_over(const Cover& made, CoverSink& sink) noexcept {
    for (const Point& star : made.stars) sink.add_patch(star.x, star.y);
    for (std::size_t e = 0; e < made.connectivity.elements.size(); ++e) {
      sink.add_element(made.connectivity.elements[e].patch.data(), made.regions.of(e));
    }
    const Boundary& boundary = made.boundary;
    for (std::size_t loop = 0; loop + 1 < boundary.loop_start.size(); ++loop) {
      for (std::uint32_t i = boundary.loop_start[loop]; i < boundary.loop_start[loop + 1]; ++i) {
        const BoundaryVertex& vertex = boundary.vertices[i];
        sink.add_boundary_vertex(vertex.at.x, vertex.at.y, vertex.element, vertex.side);
      }
      sink.close_boundary_loop();
    }
    for (const Steadied& one : made.steadied) {
      sink.steady_patch(one.patch, one.to.data(), one.weights.data(), one.inertia_area);
    }
  }

  double size_;   ///< m
  Point vertex_;  ///< m
  double angle_;  ///< rad
  Slivers treatment_;
  double share_;
};

constexpr Component components[] = {
    cover_builder<Hexagonal>("hexagonal",
                             "A regular lattice of hexagonal patches over a body of any shape, cut by its "
                             "outline and discontinuities.",
                             parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("hexagonal", "0.1.0", "the talus authors", components);
