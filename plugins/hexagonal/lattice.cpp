#include "lattice.hpp"

#include <algorithm>
#include <cmath>

namespace talus::hexagonal {
namespace {

const double row_height = std::sqrt(3.0) / 2;

std::int64_t nearest_line(std::int64_t coordinate) {
  return (coordinate + unit / 2) >> 30 << 30;
}

std::int64_t distance_from_line(std::int64_t coordinate) {
  return std::abs(coordinate - nearest_line(coordinate));
}

}  // namespace

Lattice::Lattice(double size, Point vertex, double angle)
    : size_(size), cosine_(std::cos(angle)), sine_(std::sin(angle)) {
  // A shift by whole cells changes nothing but the digits that are lost.
  const LatticePoint full = unshifted(vertex);
  shift_ = {full.a - std::floor(full.a), full.b - std::floor(full.b)};
}

LatticePoint Lattice::unshifted(Point point) const {
  const double along = (cosine_ * point.x + sine_ * point.y) / size_;
  const double across = (cosine_ * point.y - sine_ * point.x) / size_;
  const double b = across / row_height;
  return {along - b / 2, b};
}

LatticePoint Lattice::place(Point point) const {
  const LatticePoint full = unshifted(point);
  return {full.a - shift_.a, full.b - shift_.b};
}

Point Lattice::point(GridPoint place) const {
  const double a = static_cast<double>(place.a) / static_cast<double>(unit) + shift_.a;
  const double b = static_cast<double>(place.b) / static_cast<double>(unit) + shift_.b;
  const double along = size_ * (a + b / 2), across = size_ * (row_height * b);
  return {cosine_ * along - sine_ * across, sine_ * along + cosine_ * across};
}

GridPoint onto_lattice(GridPoint place, std::int64_t tolerance) {
  if (distance_from_line(place.a) <= tolerance) place.a = nearest_line(place.a);
  if (distance_from_line(place.b) <= tolerance) place.b = nearest_line(place.b);
  const std::int64_t sum = place.a + place.b;
  if (distance_from_line(sum) <= tolerance) {
    if (place.b == nearest_line(place.b)) {
      place.a = nearest_line(sum) - place.b;
    } else {
      place.b = nearest_line(sum) - place.a;
    }
  }
  return place;
}

GridPoint to_grid(LatticePoint place, std::int64_t tolerance) {
  const double scale = static_cast<double>(unit);
  return onto_lattice({std::llround(place.a * scale), std::llround(place.b * scale)}, tolerance);
}

double depth_in(const Triangle& triangle, LatticePoint place) {
  const double a = place.a - triangle.cell.i, b = place.b - triangle.cell.j;
  return triangle.upper ? std::min({1 - a, 1 - b, a + b - 1}) : std::min({a, b, 1 - a - b});
}

Triangle triangle_at(GridPoint place) {
  const Cell cell{cell_index(place.b), cell_index(place.a)};
  return {cell, place.a + place.b >= (std::int64_t{cell.i} + cell.j + 1) * unit};
}

std::int64_t distance_from_lines(GridPoint place) {
  return std::min(
      {distance_from_line(place.a), distance_from_line(place.b), distance_from_line(place.a + place.b)});
}

}  // namespace talus::hexagonal
