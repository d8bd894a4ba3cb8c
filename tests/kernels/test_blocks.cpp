#include "kernels/level.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <random>
#include <vector>

using namespace talus::kernels;
using talus::best_simd_level;
using talus::BodyForce;
using talus::BodyMotion;
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
      block.inertia = 2 + random();
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
