#pragma once

#include "blocks/cut.hpp"

#include <vector>

namespace talus {

class Geos;

struct Bridged {
  std::vector<Vec2> points;  ///< where blocks met themselves
  std::vector<Chord> chords;
};

/// Blocks whose own boundaries meet at a point have no simple outline: rock that joints enclose on two sides
/// of a crossing, or that touches the boundary with a corner. There the sharper corner of what lies between
/// is cut off by 1 % of its shorter side and goes to the block around; of a block within a block by less.
/// Blocks that touch have the same vertices along their common boundary; of those within `near` m of such a
/// point, where lengthened lines cross once more, that alone stays. Throws std::runtime_error where there is
/// no corner to cut off, as between two openings.
Bridged bridge_pinches(std::vector<Block>& blocks, double near, const Geos& geos);

}  // namespace talus
