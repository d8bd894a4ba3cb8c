#pragma once

#include <talus/cover_builder.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace talus::conformance {

struct Point {
  double x, y;
};

using Line = std::vector<Point>;

/// A body as a builder is given it: about its centroid, with its discontinuities and its mesh.
class DrawnBody {
 public:
  explicit DrawnBody(std::vector<Line> rings, std::vector<Line> discontinuities = {});

  /// A square whose sides are divided into `parts`, with a mesh of two triangles per cell.
  static DrawnBody meshed_square(std::uint32_t parts);

  BodyShape shape() const;
  Point centroid() const { return centroid_; }  ///< in the coordinates it was drawn in
  double extent() const;

  std::vector<Line> rings, lines;  ///< about the centroid

 private:
  Point centroid_{};
  AreaMoments moments_{};
  std::vector<double> x_, y_, line_x_, line_y_, node_x_, node_y_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> ring_start_{0}, line_start_{0};
};

struct BoundaryVertex {
  Point at;
  std::uint32_t element, side;
};

struct Steadied {
  std::uint32_t patch;
  std::array<std::uint32_t, 3> to;
  std::array<double, 3> weights;
  double inertia_area;
};

/// What a builder makes of a body.
class RecordedCover final : public CoverSink {
 public:
  struct Element {
    std::array<std::uint32_t, 3> patch;
    std::vector<Line> rings;
  };

  std::uint32_t add_patch(double x, double y) noexcept override;
  std::uint32_t add_element(const std::uint32_t patches[3], const Region& region) noexcept override;
  void add_boundary_vertex(double x, double y, std::uint32_t element, std::uint32_t side) noexcept override;
  void close_boundary_loop() noexcept override;
  void steady_patch(std::uint32_t patch, const std::uint32_t to[3], const double weights[3],
                    double inertia_area) noexcept override;
  void scale_strain_mass(double scale) noexcept override { strain_mass_scale = scale; }
  void make_rigid() noexcept override { rigid = true; }
  void refuse(const char* why) noexcept override;

  /// Shape functions of an element's star triangle.
  std::array<double, 3> weights(std::uint32_t element, Point at) const;
  std::size_t parts() const;  ///< pieces of the body that share no patch

  std::vector<Point> stars;
  std::vector<Element> elements;
  std::vector<std::vector<BoundaryVertex>> loops;
  std::vector<Steadied> steadied;
  std::string refusal;
  bool rigid = false;
  double strain_mass_scale = 1;

 private:
  std::vector<BoundaryVertex> open_;
};

bool is_in(const std::vector<Line>& rings, Point at);
AreaMoments moments_of(const std::vector<Line>& rings);
double distance(Point p, Point q);
double distance_from_segment(Point p, Point start, Point end);

/// A regular polygon, counter-clockwise; the first corner lies at `angle`, rad.
Line regular_polygon(int corners, double radius, Point centre = {0, 0}, double angle = 0);
std::vector<Line> turned(std::vector<Line> lines, double angle);

}  // namespace talus::conformance
