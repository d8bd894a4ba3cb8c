#pragma once

#include "contact/contact_stage.hpp"
#include "model/model.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace talus {

/// Surface classes that a body can meet, and by what factor its springs count for the motion of what it
/// meets.
struct Meetings {
  std::vector<char> surfaces;
  double stiffness_factor = 1, damping_factor = 1;
};

/// Springs and dashpots a side of a body may meet, lumped at each of its ends: per metre of thickness, N/m
/// and N s/m.
struct SideSprings {
  double normal = 0, tangential = 0, support = 0;
  double normal_damping = 0, tangential_damping = 0;
};

/// Largest squared angular frequency of a body with all its springs, 1/s², and largest damping rate, 1/s.
struct BodyVote {
  double lambda = 0, gamma = 0;
  double elastic_lambda = 0;  ///< of its strain modes alone
  double spring_lambda = 0;   ///< of its springs alone
};

/// [side of the body, from Body::side_begin]
using SpringsOfSides = std::vector<SideSprings>;

/// A body that moves as a whole: 6 or 3 unknowns, solved outright.
BodyVote vote_as_a_whole(const Scene& scene, const Model& model, std::uint32_t body,
                         const SpringsOfSides& springs);

/// A body of many elements, by Lanczos iteration with the residual added: never below the true value but for
/// rounding. `treated`: with what was done about slivers.
BodyVote vote_of_patches(const Scene& scene, const Model& model, std::uint32_t body,
                         const SpringsOfSides& springs, bool treated = true);

}  // namespace talus
