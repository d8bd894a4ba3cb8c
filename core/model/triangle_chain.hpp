#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace talus {

struct LaidCover;

/// A patch in a chain, and the triangle that it makes with the two patches before it.
struct ChainLink {
  static constexpr std::uint32_t no_element = 0xFFFFFFFFu;

  std::uint32_t patch;
  std::uint32_t element = no_element;
};

/// These elements of a cover in an order in which most share two patches with the one before: each needs one
/// link where a strip of triangles goes on, two where it turns, for which the third last patch is named
/// again, and three where a strip ends and another begins.
std::vector<ChainLink> chain_triangles(const LaidCover& cover, std::span<const std::uint32_t> elements);

}  // namespace talus
