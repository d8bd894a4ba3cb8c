#include "model/lattice_places.hpp"

#include <cmath>

namespace talus {
namespace {

constexpr double alike = 1e-9;  ///< of a side, that triangles may differ by

struct Triangle {
  std::array<std::uint32_t, 3> patch;
  Vec2 second, third;  ///< from the first corner
};

Triangle triangle_of(const LaidCover& cover, std::size_t element, std::size_t first) {
  const auto& patches = cover.elements[element].patches;
  const std::array<std::uint32_t, 3> patch{patches[first], patches[(first + 1) % 3],
                                           patches[(first + 2) % 3]};
  const Vec2 origin = cover.patches[patch[0]];
  return {patch, cover.patches[patch[1]] - origin, cover.patches[patch[2]] - origin};
}

bool is_whole(const LaidCover& cover, std::size_t element) {
  const Triangle t = triangle_of(cover, element, 0);
  const double area = cross(t.second, t.third) / 2;
  return std::abs(cover.elements[element].moments.area - area) <= alike * area;
}

bool is_close(Vec2 p, Vec2 q, double reach) {
  return std::abs(p.x - q.x) <= reach && std::abs(p.y - q.y) <= reach;
}

/// The corners in the order of the lattice: +1 of a lower triangle, −1 of an upper one, 0 of neither.
int fit(const LaidCover& cover, std::size_t element, Vec2 along, Vec2 up, Triangle& found) {
  const double reach = alike * size_of(along);
  for (std::size_t first = 0; first < 3; ++first) {
    found = triangle_of(cover, element, first);
    if (is_close(found.second, along, reach) && is_close(found.third, up, reach)) return 1;
    if (is_close(found.second, {-along.x, -along.y}, reach) && is_close(found.third, {-up.x, -up.y}, reach))
      return -1;
  }
  return 0;
}

}  // namespace

std::optional<LatticePlaces> find_lattice(const LaidCover& cover) {
  const std::size_t count = cover.elements.size();
  std::size_t sample = count / 2;
  while (sample < count && !is_whole(cover, sample)) ++sample;
  if (sample == count) return {};
  const Triangle model = triangle_of(cover, sample, 0);

  LatticePlaces places;
  places.element.resize(count);
  Vec2 along, up;
  std::size_t whole = 0;
  Triangle triangle;
  for (std::size_t e = 0; e < count; ++e) {
    LatticePlaces::ElementPlace& place = places.element[e];
    place.kind = LatticePlaces::Kind::other;
    const int sign = is_whole(cover, e) ? fit(cover, e, model.second, model.third, triangle) : 0;
    if (sign == 0) continue;
    place.kind = sign > 0 ? LatticePlaces::Kind::lower : LatticePlaces::Kind::upper;
    place.patch = triangle.patch;
    along += sign * triangle.second;
    up += sign * triangle.third;
    ++whole;
  }
  if (2 * whole < count) return {};
  const auto share = 1 / static_cast<double>(whole);  // the mean has fewer rounding errors than any one
  places.along = share * along;
  places.up = share * up;

  const Vec2 origin = cover.patches[model.patch[0]];
  const double cell = cross(places.along, places.up);
  const auto place_of = [&](Vec2 at) {
    const Vec2 from = at - origin;
    return LatticePlaces::Place{static_cast<std::int32_t>(std::lround(cross(places.along, from) / cell)),
                                static_cast<std::int32_t>(std::lround(cross(from, places.up) / cell))};
  };
  places.patch.reserve(cover.patches.size());
  for (const Vec2 at : cover.patches) places.patch.push_back(place_of(at));
  for (std::size_t e = 0; e < count; ++e) {
    LatticePlaces::ElementPlace& place = places.element[e];
    if (place.kind == LatticePlaces::Kind::other) place.patch = cover.elements[e].patches;
    place.cell = places.patch[place.patch[0]];
    if (place.kind == LatticePlaces::Kind::upper) --place.cell.row, --place.cell.column;
  }
  return places;
}

}  // namespace talus
