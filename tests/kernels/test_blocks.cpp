#include "kernels/level.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

using namespace talus::kernels;
using talus::best_simd_level;
using talus::BodyForce;
using talus::BodyMotion;
using talus::CornerLoad;
using talus::SimdLevel;

namespace {

/// Blocks at random, deformable and rigid ones, of which some are not free.
struct SomeBlocks {
  std::vector<Block> blocks;
  std::vector<BodyForce> forces;
  std::vector<BodyMotion> motion;

  explicit SomeBlocks(std::size_t count) : blocks(count), forces(count), motion(count) {
    std::mt19937 source(5);
    const auto random = [&] { return static_cast<double>(source()) / 2147483648.0 - 1; };
    for (std::size_t b = 0; b < count; ++b) {
      Block& block = blocks[b];
      block.mass = 2 + random();
      block.moment_xx = 3 + random(), block.moment_xy = random(), block.moment_yy = 3 + random();
      block.inverse_xx = 3 + random(), block.inverse_xy = random(), block.inverse_yy = 3 + random();
      block.rigid = b % 3 == 1;
      block.free = b % 7 != 2;
      forces[b] = {{random(), random()}, {random(), random(), random(), random()}};
      motion[b] = {{random(), random()},
                   {random(), random(), random(), random()},
                   {random(), random()},
                   {random(), random(), random(), random()},
                   random()};
    }
  }

  /// In calls that end at each of `ends`; `kept`: velocities at t_n are.
  BlockSums accelerate(SimdLevel level, const BlockUpdate& update, const std::vector<std::size_t>& ends,
                       bool kept) {
    std::vector<BodyMotion> middle(blocks.size());
    BlockSums sums;
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
      block_kernels(level).accelerate(blocks.data(), forces.data(), update, motion.data(),
                                      kept ? middle.data() : nullptr, begin, end, sums);
      begin = end;
    }
    return sums;
  }
};

template <class Value>
bool same_bits(const Value& p, const Value& q) {
  return std::memcmp(&p, &q, sizeof p) == 0;
}

}  // namespace

TEST_CASE("what blocks do and add up to shows neither in how many calls nor what is kept", "[kernels]") {
  constexpr std::size_t count = 61;
  for (const bool even : {true, false}) {
    for (const bool damped : {false, true}) {
      const BlockUpdate update{damped ? 0.98 : 1.0, 0.01, 0.3, -9.81, 0.5, even, true, damped};
      SomeBlocks due(count);
      const BlockSums sums = due.accelerate(SimdLevel::scalar, update, {count}, false);
      CHECK(sums.all_kinetic() != 0);
      for (int level = 0; level <= static_cast<int>(best_simd_level()); ++level) {
        for (const bool kept : {false, true}) {
          for (const std::vector<std::size_t>& ends :
               {std::vector<std::size_t>{count}, {1, 2, 20, 21, count}}) {
            CAPTURE(even, damped, level, kept, ends.size());
            SomeBlocks found(count);
            const BlockSums here = found.accelerate(static_cast<SimdLevel>(level), update, ends, kept);
            CHECK(same_bits(here, sums));
            for (std::size_t b = 0; b < count; ++b) REQUIRE(same_bits(found.motion[b], due.motion[b]));
          }
        }
      }
    }
  }
}

namespace {

/// Loads of up to 13 contacts on bodies of all numbers of corners. Every seventh body is still.
struct SomeLoads {
  std::vector<double> x, y;
  std::vector<CornerLoad> corner, sum;
  std::vector<BodyLoads> bodies;
  std::vector<std::uint32_t> first_load;
  std::vector<char> still;

  explicit SomeLoads(bool begun, bool goes_on) {
    std::mt19937 source(7);
    const auto random = [&] { return static_cast<double>(source()) / 2147483648.0 - 1; };
    constexpr std::uint32_t counts[] = {4, 3, 0, 4, 5, 20};
    for (std::uint32_t b = 0; b < 6 * 14; ++b) {
      const std::uint32_t count = counts[b % 6], contacts = b / 6;
      const auto corner_begin = static_cast<std::uint32_t>(x.size()),
                 first_sum = static_cast<std::uint32_t>(sum.size());
      still.push_back(b % 7 == 3 ? 1 : 0);
      for (std::uint32_t i = 0; i < count; ++i) x.push_back(random()), y.push_back(random());
      const auto first = static_cast<std::uint32_t>(first_load.size());
      for (std::uint32_t c = 0; c < contacts; ++c) {
        first_load.push_back(static_cast<std::uint32_t>(corner.size()));
        for (std::uint32_t i = 0; i < count; ++i) corner.push_back({random(), random()});
      }
      bodies.push_back(
          {b, first, first_sum, corner_begin, static_cast<std::uint16_t>(count), begun, goes_on});
      for (std::uint32_t i = 0; i < std::max(count, 4U); ++i) sum.push_back({random(), random()});
    }
    bodies.push_back({0, static_cast<std::uint32_t>(first_load.size()), 0, 0, 0, false, false});
    // A row of four may be read from any corner on.
    for (std::vector<double>* values : {&x, &y}) values->insert(values->end(), 4, 0.0);
    corner.insert(corner.end(), 4, {0, 0});
  }

  std::vector<BodyForce> add(SimdLevel level) {
    std::vector<BodyForce> forces(still.size(), {{1, 2}, {3, 4, 5, 6}});
    const GatheredLoads loads{bodies.data(), first_load.data(), corner.data(), sum.data(), still.data()};
    block_kernels(level).add_loads(loads, x.data(), y.data(), forces.data(), 0, forces.size());
    return forces;
  }
};

}  // namespace

TEST_CASE("loads are gathered by all bodies of one piece that move, with the same bits", "[kernels]") {
  for (const bool begun : {false, true}) {
    for (const bool goes_on : {false, true}) {
      SomeLoads due(begun, goes_on);
      const std::vector<CornerLoad> before = due.sum;
      const std::vector<BodyForce> forces = due.add(SimdLevel::scalar);
      for (std::size_t b = 0; b < forces.size(); ++b) {
        CAPTURE(begun, goes_on, b);
        const BodyLoads& body = due.bodies[b];
        const bool takes_part = body.corner_count > 0 && due.still[b] == 0;
        double sum = 1, moment = 3;
        for (std::uint32_t i = 0; i < body.corner_count && takes_part; ++i) {
          double load = begun ? before[body.sum + i].x : 0;
          for (std::uint32_t at = body.begin; at < due.bodies[b + 1].begin; ++at)
            load += due.corner[due.first_load[at] + i].x;
          sum += load;
          moment += load * due.x[body.corner_begin + i];
          if (goes_on) CHECK(due.sum[body.sum + i].x == load);
        }
        const bool added = takes_part && !goes_on;
        // Rounding of less than three hundred numbers up to 1.
        CHECK(forces[b].force.x == Approx(added ? sum : 1).margin(1e-12));
        CHECK(forces[b].moment.xx == Approx(added ? moment : 3).margin(1e-12));
      }
      for (int level = 1; level <= static_cast<int>(best_simd_level()); ++level) {
        CAPTURE(begun, goes_on, level);
        SomeLoads found(begun, goes_on);
        const std::vector<BodyForce> here = found.add(static_cast<SimdLevel>(level));
        for (std::size_t b = 0; b < here.size(); ++b) REQUIRE(same_bits(here[b], forces[b]));
        for (std::size_t i = 0; i < due.sum.size(); ++i) REQUIRE(same_bits(found.sum[i], due.sum[i]));
      }
    }
  }
}
