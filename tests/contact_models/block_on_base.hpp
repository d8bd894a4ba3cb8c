#pragma once

#include "contact_models/law_bench.hpp"

#include <vector>

namespace talus::bench {

/// A block of 1 x 1 m on a wide base; as deep as wanted.
inline std::vector<HeldBody> block_on_base(double depth) {
  return {box(-2, -1, 2, 0), box(-0.5, -depth, 0.5, 1 - depth)};
}

/// Moves the block in one step.
inline Evaluation shifted(LawBench& bench, Vec2 by, double dt = 1e-4) {
  bench.bodies[1].motion.velocity = {by.x / dt, by.y / dt};
  return bench.step(dt);
}

}  // namespace talus::bench
