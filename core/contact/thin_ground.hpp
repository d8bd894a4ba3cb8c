#pragma once

#include "contact/contact_stage.hpp"

#include <cstdint>
#include <optional>

namespace talus {

/// Where a body of many elements is met deeper than contact can see.
struct ThinGround {
  std::uint32_t body, other;
  Vec2 place;    ///< m, behind the surface of `body`, without the scene's origin
  double depth;  ///< m, of the strip
};

/// The first strip whose far side another body has come upon, of an evaluation that was observed: what is in
/// there pushes no longer, as behind one of two joints that lie close together.
std::optional<ThinGround> find_thin_ground(const Model& model, const MotionState& motion,
                                           const ContactStage& contacts);

}  // namespace talus
