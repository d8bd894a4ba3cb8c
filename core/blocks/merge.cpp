#include "blocks/faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace talus {
namespace {

using Number = std::uint32_t;

/// Length of the common boundary with each neighbour, m.
using Neighbours = std::map<Number, double>;

struct Side {
  Vec2 from, to;  ///< in an order of their own, the same seen from both faces
  Number face;
  double length() const { return std::hypot(to.x - from.x, to.y - from.y); }
  auto key() const { return std::tie(from.x, from.y, to.x, to.y); }
};

std::vector<Side> sides_of(const std::vector<Block>& faces) {
  std::vector<Side> sides;
  for (Number face = 0; face < faces.size(); ++face) {
    for (const Ring& ring : faces[face].loops) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        if (std::tie(b.x, b.y) < std::tie(a.x, a.y)) std::swap(a, b);
        sides.push_back({a, b, face});
      }
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.key() < b.key() || (a.key() == b.key() && a.face < b.face);
  });
  return sides;
}

/// Groups of faces that become one block each.
class Groups {
 public:
  Groups(const std::vector<Block>& faces, double smallest, double thinnest)
      : smallest_(smallest), thinnest_(thinnest), neighbours_(faces.size()), members_(faces.size()) {
    for (Number face = 0; face < faces.size(); ++face) {
      area_.push_back(faces[face].area);
      perimeter_.push_back(0);
      members_[face] = {face};
    }
    const std::vector<Side> sides = sides_of(faces);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      perimeter_[sides[i].face] += sides[i].length();
      if (i == 0 || sides[i].key() != sides[i - 1].key()) continue;
      neighbours_[sides[i].face][sides[i - 1].face] += sides[i].length();
      neighbours_[sides[i - 1].face][sides[i].face] += sides[i].length();
    }
  }

  std::vector<std::vector<Number>> merged() && {
    std::set<std::pair<double, Number>> small;
    for (Number face = 0; face < area_.size(); ++face) {
      if (is_small(face)) small.emplace(area_[face], face);
    }
    while (!small.empty()) {
      const Number face = small.begin()->second;
      small.erase(small.begin());
      if (neighbours_[face].empty()) {
        members_[face].clear();
        continue;
      }
      const Number into = best_neighbour(face);
      small.erase({area_[into], into});
      merge(face, into);
      if (is_small(into)) small.emplace(area_[into], into);
    }
    std::erase_if(members_, [](const std::vector<Number>& group) { return group.empty(); });
    return std::move(members_);
  }

 private:
  bool is_small(Number face) const {
    return area_[face] < all_but_rounding * smallest_ ||
           2 * area_[face] < all_but_rounding * thinnest_ * perimeter_[face];
  }

  Number best_neighbour(Number face) const {
    double longest = 0, largest = 0;
    for (const auto& [other, length] : neighbours_[face]) longest = std::max(longest, length);
    for (const auto& [other, length] : neighbours_[face]) {
      if (length >= all_but_rounding * longest) largest = std::max(largest, area_[other]);
    }
    for (const auto& [other, length] : neighbours_[face]) {
      if (length >= all_but_rounding * longest && area_[other] >= all_but_rounding * largest) return other;
    }
    return neighbours_[face].begin()->first;
  }

  void merge(Number face, Number into) {
    area_[into] += area_[face];
    perimeter_[into] += perimeter_[face] - 2 * neighbours_[face][into];
    members_[into].insert(members_[into].end(), members_[face].begin(), members_[face].end());
    members_[face].clear();
    for (const auto& [other, length] : neighbours_[face]) {
      neighbours_[other].erase(face);
      if (other == into) continue;
      neighbours_[other][into] += length;
      neighbours_[into][other] += length;
    }
    neighbours_[face].clear();
  }

  double smallest_, thinnest_;
  std::vector<double> area_, perimeter_;
  std::vector<Neighbours> neighbours_;
  std::vector<std::vector<Number>> members_;
};

}  // namespace

std::vector<Block> merge_small_faces(std::vector<Block> faces, double smallest, double thinnest,
                                     const Geos& geos) {
  std::vector<Block> blocks;
  for (const std::vector<Number>& group : Groups(faces, smallest, thinnest).merged()) {
    if (group.size() == 1) {
      blocks.push_back(std::move(faces[group[0]]));
      continue;
    }
    std::vector<const Loops*> parts;
    double due = 0, found = 0;
    for (const Number face : group) {
      parts.push_back(&faces[face].loops);
      due += faces[face].area;
    }
    for (Loops& loops : geos.joined(parts)) {
      orient(blocks.emplace_back(Block{std::move(loops), {}, 0, {}}));
      found += blocks.back().area;
    }
    if (std::abs(found - due) > 1e-6 * due)
      throw std::runtime_error(
          fmt::format("{:.3g} m² are lost where small faces join their neighbours", due - found));
  }
  return blocks;
}

}  // namespace talus
