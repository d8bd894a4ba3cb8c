#include "contact/thin_ground.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr double far = 0.9;  ///< of the depth of a strip

Vec2 corner_at(const MotionState& motion, std::uint32_t corner, Vec2 offset) {
  return {motion.corners[corner].x + offset.x, motion.corners[corner].y + offset.y};
}

bool is_within(const Model& model, const MotionState& motion, std::uint32_t piece, Vec2 offset, Vec2 point) {
  const std::uint32_t begin = model.piece_start[piece], end = model.piece_start[piece + 1];
  Vec2 from = corner_at(motion, end - 1, offset);
  for (std::uint32_t c = begin; c < end; ++c) {
    const Vec2 to = corner_at(motion, c, offset);
    if (cross(to - from, point - from) < 0) return false;
    from = to;
  }
  return true;
}

/// Seen at three points of its side.
std::optional<ThinGround> ground_of(const Model& model, const MotionState& motion, double penetration,
                                    std::uint32_t piece, Vec2 offset, std::uint32_t other,
                                    Vec2 other_offset) {
  if (model.is_strip[piece] == 0) return {};
  const double depth = model.strips[model.piece_strip[piece]].depth;
  if (penetration < far * depth) return {};
  const std::uint32_t first = model.piece_start[piece];
  const Vec2 start = corner_at(motion, first, offset), side = corner_at(motion, first + 1, offset) - start;
  const double length = std::sqrt(dot(side, side));
  if (!(length > 0)) return {};
  const Vec2 behind{-side.y / length * far * depth, side.x / length * far * depth};
  for (const double share : {0.25, 0.5, 0.75}) {
    const Vec2 point = start + share * side + behind;
    if (is_within(model, motion, other, other_offset, point))
      return ThinGround{model.piece_body[piece], model.piece_body[other], point, depth};
  }
  return {};
}

}  // namespace

std::optional<ThinGround> find_thin_ground(const Model& model, const MotionState& motion,
                                           const ContactStage& contacts) {
  for (std::size_t i = 0; i < contacts.pairs().size(); ++i) {
    const BodyPair& pair = contacts.pairs()[i];
    if (!model.covered(pair.a) && !model.covered(pair.b)) continue;
    double penetration = 0;
    for (const ContactReport& report : contacts.reports_of(i))
      penetration = std::max(penetration, report.penetration);
    if (penetration == 0) continue;
    const Vec2 frame = model.bodies[pair.a].centre, offset{pair.offset_x, pair.offset_y};
    const PiecePairs all = contacts.piece_pairs();
    for (const auto [a, b, load_start] : all.of(pair)) {
      std::optional<ThinGround> found = ground_of(model, motion, penetration, a, {}, b, offset);
      if (!found) found = ground_of(model, motion, penetration, b, offset, a, {});
      if (!found) continue;
      found->place += frame;
      return found;
    }
  }
  return {};
}

}  // namespace talus
