#pragma once

#include "model/laid_cover.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace talus {

/// A regular lattice of triangles found in a cover: cells of two sides `along` and `up`, each cut by the
/// diagonal between the ends of both into a lower and an upper triangle.
struct LatticePlaces {
  Vec2 along, up;  ///< m

  struct Place {
    std::int32_t row, column;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  std::vector<Place> patch;  ///< nearest vertex of the lattice

  enum class Kind : std::uint8_t { lower, upper, other };
  struct ElementPlace {
    Place cell;
    Kind kind;                           ///< other: cut, or no triangle of the lattice
    std::array<std::uint32_t, 3> patch;  ///< first the corner at the right angle of the cell's axes
  };
  std::vector<ElementPlace> element;
};

/// Empty where less than half of the elements are whole triangles of one lattice.
std::optional<LatticePlaces> find_lattice(const LaidCover& cover);

}  // namespace talus
