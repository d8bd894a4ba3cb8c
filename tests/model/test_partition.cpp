#include "model/model.hpp"
#include "model/space_filling.hpp"
#include "simulation/working_scene.hpp"

#include <talus/material.hpp>

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

using namespace talus;

namespace {

WorkingScene lattice(double size, const std::string& more = "", const std::string& rest = "") {
  WorkingScene text;
  text.bodies = fmt::format(
      R"({{"name": "a", "material": "rock", "polygon": [[0, 0], [10, 0], [10, 4], [0, 5]],
          "cover": {{"model": "hexagonal", "size": {}, "angle": 11}}{}}})",
      size, more);
  text.rest = rest;
  return text;
}

const char* const crack = R"(, "discontinuities": [{"points": [[2, 1], [5, 2.2]]}])";

std::vector<std::uint32_t> owner_count(const Model& model) {
  std::vector<std::uint32_t> count(model.patch_star.size(), 0);
  for (const PatchRun& run : model.partition.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) ++count[run.patch + i];
  }
  return count;
}

/// Of a chunk that is a chain.
std::vector<std::uint32_t> links_with_triangle(const Partition& partition, const ElementChunk& chunk) {
  std::vector<std::uint32_t> links;
  for (std::uint32_t i = chunk.link; i < chunk.link + chunk.links; ++i) {
    if (partition.area[i] != 0) links.push_back(i);
  }
  return links;
}

}  // namespace

TEST_CASE("every element is in one chunk and every patch own in one subdomain, or common",
          "[model][partition]") {
  for (const std::string& scene : {lattice(0.06).bodies, lattice(0.3, crack).bodies}) {
    WorkingScene text;
    text.bodies = scene;
    const Model model = build_model(text.read());
    const Body& body = model.bodies[0];
    const CoverRanges& ranges = model.ranges(body);
    const Partition& partition = model.partition;
    std::vector<std::uint32_t> seen(model.elements.size(), 0);
    for (std::uint32_t s = ranges.subdomain_begin; s < ranges.subdomain_end; ++s) {
      const Subdomain& subdomain = partition.subdomains[s];
      // [place] the patch of the model that has it now.
      std::vector<std::uint32_t> patch_of(subdomain.patch_count, no_patch);
      const auto enter = [&](std::uint32_t place, std::uint32_t patch) {
        REQUIRE(patch_of.at(place) == no_patch);
        patch_of[place] = patch;
      };
      std::uint32_t run = subdomain.run_begin, slot = subdomain.slot_begin, run_left = run, slot_left = slot;
      for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
        const ElementChunk& chunk = partition.chunks[c];
        for (; run < chunk.run_needed; ++run) {
          const PatchRun& r = partition.runs[run];
          for (std::uint32_t i = 0; i < r.count; ++i) enter(r.local + i, r.patch + i);
        }
        for (; slot < chunk.slot_needed; ++slot)
          enter(partition.slot_local[slot], partition.slot_patch[slot]);
        const std::vector<std::uint32_t> links = links_with_triangle(partition, chunk);
        for (std::uint32_t i = 0; chunk.cells == 0 && i < chunk.links + TriangleChain::links_before; ++i)
          REQUIRE(patch_of[partition.corner[chunk.link - TriangleChain::links_before + i]] != no_patch);
        REQUIRE(links.size() == (chunk.cells == 0 ? chunk.count : 0));
        for (std::uint32_t i = 0; i < chunk.count; ++i) {
          ++seen[chunk.element + i];
          const Element& element = model.elements[model.first_element(body) + chunk.element + i];
          std::array<std::uint32_t, 3> corner{};
          if (chunk.cells == 0) {
            for (std::uint32_t k = 0; k < 3; ++k) corner[k] = partition.corner[links[i] + k - 2];
          } else if (i < chunk.cells) {
            corner = {chunk.bottom + i, chunk.bottom + i + 1, chunk.top + i};
          } else {
            const std::uint32_t cell = i - chunk.cells;
            corner = {chunk.top + cell + 1, chunk.top + cell, chunk.bottom + cell + 1};
          }
          for (std::size_t k = 0; k < 3; ++k) REQUIRE(patch_of[corner[k]] == element.patch[k]);
        }
        for (; run_left < chunk.run_done; ++run_left) {
          const PatchRun& r = partition.runs[run_left];
          std::fill_n(patch_of.begin() + r.local, r.count, no_patch);
        }
        for (; slot_left < chunk.slot_done; ++slot_left) patch_of[partition.slot_local[slot_left]] = no_patch;
      }
      CHECK(run_left == subdomain.run_end);
      CHECK(slot_left == subdomain.slot_end);
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](std::uint32_t count) { return count == 1; }));
    const std::vector<std::uint32_t> owners = owner_count(model);
    for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p)
      REQUIRE(owners[p] == (p < ranges.own_end ? 1 : 0));
  }
}

TEST_CASE("elements of a fine lattice are found alike, and come in rows", "[model][partition]") {
  const Model model = build_model(lattice(0.06).read());
  std::size_t regular = 0;
  for (const ElementChunk& chunk : model.partition.chunks) regular += chunk.cells > 0 ? chunk.count : 0;
  CHECK(static_cast<double>(regular) > 0.95 * static_cast<double>(model.elements.size()));
  CHECK(model.partition.subdomains.size() > 1);
  const Body& body = model.bodies[0];
  const CoverRanges& ranges = model.ranges(body);
  CHECK(ranges.own_end - ranges.patch_begin > (ranges.patch_end - ranges.patch_begin) / 2);
  for (const PatchRun& run : model.partition.runs) CHECK(run.mass > 0);
}

TEST_CASE("rows of a lattice take the places of rows that are done", "[model][partition]") {
  const Model model = build_model(lattice(0.02).read());
  std::size_t few = 0;
  for (const Subdomain& subdomain : model.partition.subdomains) {
    std::uint32_t patches = subdomain.slot_end - subdomain.slot_begin;
    for (std::uint32_t r = subdomain.run_begin; r < subdomain.run_end; ++r)
      patches += model.partition.runs[r].count;
    // At the boundary 16 rows wait for cut triangles, and so many may follow before those are due; 64 rows
    // make a subdomain.
    CHECK(subdomain.patch_count <= 40 * 136);
    few += 4 * subdomain.patch_count < patches ? 1 : 0;
  }
  CHECK(few > 0);
}

TEST_CASE("what boundary, slivers and point loads act on is common", "[model][partition]") {
  const std::string load = R"("loads": [{"body": "a", "point": [5, 2], "force": [1, 0]}],)";
  const Scene scene = lattice(0.1, "", load).read();
  const Model model = build_model(scene);
  const Body& body = model.bodies[0];
  const CoverRanges& ranges = model.ranges(body);
  const auto is_common = [&](const Carrier& carrier) {
    return std::all_of(carrier.patch.begin(), carrier.patch.end(),
                       [&](std::uint32_t patch) { return patch >= ranges.own_end; });
  };
  for (const BoundarySide& side : model.sides) {
    REQUIRE(is_common(side.start.carrier));
    REQUIRE(is_common(side.end.carrier));
  }
  REQUIRE_FALSE(model.steady.empty());
  for (const SteadyPatch& steady : model.steady) {
    REQUIRE(steady.patch >= ranges.own_end);
    REQUIRE(is_common(steady.to));
  }
  const MaterialPoint loaded = model.point(0, {5 - body.centre.x, 2 - body.centre.y});
  CHECK(is_common(loaded.carrier));
  const Model without = build_model(lattice(0.1).read());
  const MaterialPoint same = without.point(0, {5 - body.centre.x, 2 - body.centre.y});
  CHECK(same.carrier.patch[0] < without.ranges(without.bodies[0]).own_end);
}

TEST_CASE("a space-filling curve visits each cell once, always next to the one before",
          "[model][partition]") {
  constexpr int side = 32;
  std::vector<Vec2> points;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) points.push_back({static_cast<double>(i), static_cast<double>(j)});
  }
  // The corner cell of the finest grid lies at its far end, so cells of this one hold 2048² or so of those.
  const std::vector<std::uint64_t> along = along_curve(points);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return along[p] < along[q]; });
  CHECK(std::set<std::uint64_t>(along.begin(), along.end()).size() == points.size());
  double longest = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Vec2 p = points[order[i - 1]], q = points[order[i]];
    longest = std::max(longest, std::abs(p.x - q.x) + std::abs(p.y - q.y));
  }
  CHECK(longest == 1);
}
