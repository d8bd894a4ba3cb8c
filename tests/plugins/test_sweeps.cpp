#include "conformance/swept_strip.hpp"
#include "plugins/driven_element.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <limits>
#include <vector>

using namespace talus;
using conformance::largest_difference;
using conformance::SweptStrip;

namespace {

/// The law of each level that this machine has, the plainest first.
std::vector<Made<Material>> at_each_level(double plane) {
  static std::deque<Registry> registries;  // materials point into them
  std::vector<Made<Material>> laws;
  for (int level = 0; level <= static_cast<int>(best_simd_level()); ++level) {
    Registry& registry = registries.emplace_back();
    registry.simd = static_cast<SimdLevel>(level);
    const std::filesystem::path folder = TALUS_PLUGINS;
    load_folders(registry, {&folder, 1});
    const RegisteredComponent* found = registry.find(ComponentKind::material, "linear_elastic");
    laws.push_back(make<Material>(*found, std::array{young, poisson, plane, 0.0}));
  }
  return laws;
}

}  // namespace

TEST_CASE("linear elasticity swept is linear elasticity evaluated, at every level and size",
          "[plugins][linear_elastic][sweep]") {
  // Rounding alone: some ten operations on F of about one, moduli of 1.2 E, six elements to a corner; strains
  // of 1e-4 have a rounding error of 1e-12 of their size, energies ten times that.
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  for (const double plane : {plane_strain, plane_stress}) {
    const std::vector<Made<Material>> laws = at_each_level(plane);
    REQUIRE(laws[0]->sweeps());
    for (const std::uint32_t cells : {1u, 3u, 7u, 8u, 9u, 21u, 128u}) {
      for (const bool wild : {false, true}) {
        CAPTURE(plane, cells, wild);
        const SweptStrip given(cells, 1e-4, wild);
        SweptStrip due = given;
        const double stored = due.one_by_one(*laws[0]);
        SweptStrip first = given, first_chain = given;
        const double first_stored = first.sweep(*laws[0]);
        const double first_stored_in_chain = first_chain.sweep_as_chain(*laws[0], true);
        const double force = 6 * young * SweptStrip::area;
        CHECK(largest_difference(first, due) <= rounding * force);
        CHECK(largest_difference(first_chain, due) <= rounding * force);
        CHECK(std::abs(first_stored - stored) <= 1e-10 * stored);
        CHECK(std::abs(first_stored_in_chain - stored) <= 1e-10 * stored);
        for (const auto& law : laws) {
          SweptStrip again = given, beside = given, apart = given;
          CHECK(again.sweep(*law) == first_stored);
          CHECK(beside.sweep_as_chain(*law, true) == first_stored_in_chain);
          CHECK(apart.sweep_as_chain(*law, false) == first_stored_in_chain);
          CHECK(largest_difference(again, first) == 0);
          CHECK(largest_difference(beside, first_chain) == 0);
          CHECK(largest_difference(apart, first_chain) == 0);
        }
      }
    }
  }
}

TEST_CASE("a turned strip without strain is left in peace", "[plugins][linear_elastic][sweep]") {
  for (const auto& law : at_each_level(plane_strain)) {
    SweptStrip strip(21, 0, false);
    const std::vector<double> before = strip.force_x;
    const double stored = strip.sweep(*law);
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      largest = std::max(largest, std::abs(strip.force_x[i] - before[i]));
    // Corners at 8 m by rounding, over edges of 0.3 m.
    CHECK(largest <= 100 * std::numeric_limits<double>::epsilon() * young);
    CHECK(stored <= 1e-27 * young);
  }
}

TEST_CASE("what has viscosity or a memory does not sweep", "[plugins][sweep]") {
  const auto damped = shipped_material("linear_elastic", std::array{young, poisson, 0.0, 1e-6});
  CHECK_FALSE(damped->sweeps());
}
