#include "model/laid_cover.hpp"
#include "model/triangle_chain.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

using namespace talus;

namespace {

using Triangle = std::array<std::uint32_t, 3>;

LaidCover cover_of(const std::vector<Triangle>& triangles) {
  LaidCover cover;
  for (const Triangle& triangle : triangles) cover.elements.push_back({triangle, {}, {}});
  return cover;
}

/// Cells of a grid, each cut along one diagonal or the other.
std::vector<Triangle> grid(std::uint32_t rows, std::uint32_t columns, bool at_random) {
  std::mt19937 random(5);
  std::vector<Triangle> triangles;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
      const bool up = !at_random || random() % 2 == 0;
      triangles.push_back(up ? Triangle{a, b, d} : Triangle{a, b, c});
      triangles.push_back(up ? Triangle{a, d, c} : Triangle{b, d, c});
    }
  }
  if (at_random) std::shuffle(triangles.begin(), triangles.end(), random);
  return triangles;
}

std::vector<ChainLink> chain_of_all(const LaidCover& cover) {
  std::vector<std::uint32_t> all(cover.elements.size());
  std::iota(all.begin(), all.end(), 0u);
  return chain_triangles(cover, all);
}

/// Whether each link with a triangle names it by its patch and the two before, and each triangle comes once.
void check(const LaidCover& cover, const std::vector<ChainLink>& chain) {
  std::vector<int> seen(cover.elements.size(), 0);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (chain[i].element == ChainLink::no_element) continue;
    REQUIRE(i >= 2);
    ++seen[chain[i].element];
    Triangle named{chain[i - 2].patch, chain[i - 1].patch, chain[i].patch},
        wanted = cover.elements[chain[i].element].patches;
    std::sort(named.begin(), named.end());
    std::sort(wanted.begin(), wanted.end());
    REQUIRE(named == wanted);
  }
  CHECK(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
}

}  // namespace

TEST_CASE("a chain names every triangle once, by three patches in a row", "[model][partition]") {
  for (const bool at_random : {false, true}) {
    const LaidCover cover = cover_of(grid(20, 30, at_random));
    check(cover, chain_of_all(cover));
  }
}

TEST_CASE("most triangles of a chain need one link", "[model][partition]") {
  const auto links_of_one = [](bool at_random) {
    const LaidCover cover = cover_of(grid(90, 90, at_random));
    return static_cast<double>(chain_of_all(cover).size()) / static_cast<double>(cover.elements.size());
  };
  CHECK(links_of_one(false) < 1.03);
  CHECK(links_of_one(true) < 1.3);
}

TEST_CASE("triangles that touch nowhere, or many at one side, have chains too", "[model][partition]") {
  const LaidCover apart = cover_of({{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  CHECK(chain_of_all(apart).size() == 9);
  check(apart, chain_of_all(apart));
  const LaidCover fins = cover_of({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 5}, {0, 1, 6}});
  check(fins, chain_of_all(fins));
  CHECK(chain_of_all(cover_of({})).empty());
}

TEST_CASE("a chain is made of the given elements alone", "[model][partition]") {
  const LaidCover cover = cover_of(grid(4, 4, false));
  const std::vector<std::uint32_t> some{3, 4, 5, 11, 30};
  std::vector<std::uint32_t> named;
  for (const ChainLink& link : chain_triangles(cover, some)) {
    if (link.element != ChainLink::no_element) named.push_back(link.element);
  }
  std::sort(named.begin(), named.end());
  CHECK(named == some);
}
