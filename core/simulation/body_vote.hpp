#pragma once

#include "contact/contact_stage.hpp"
#include "model/model.hpp"
#include "scene/scene.hpp"
#include "simulation/patch_mass.hpp"

#include <vector>

namespace talus {

/// Surface classes that a body can meet, and by what factors its springs and dashpots count where what it
/// meets moves, too.
struct Meetings {
  std::vector<char> surfaces;
  double stiffness_factor = 1, damping_factor = 1;
  double dashpot_mass = 0;  ///< kg per metre of thickness, that dashpots go by
};

/// Springs and dashpots a side of a body may meet, half of them for each of its ends: per metre of thickness,
/// N/m and N s/m. Springs are those of something fixed, dashpots of what the body may meet.
struct SideSprings {
  double normal = 0, tangential = 0;  ///< of contacts
  double normal_damping = 0, tangential_damping = 0;
  bool spread = false;                      ///< see trait::spread_springs; else they stand at the ends
  double support = 0, support_damping = 0;  ///< at the ends, in any direction
};

/// What springs meet of the motion of the ends of a side, with mean m and difference d: twice k, half of
/// them, store ½ · 2k (mean · m² + change · d²).
struct Reach {
  double mean, change;
};
inline constexpr Reach at_ends{1, 1.0 / 4};
inline constexpr Reach spread_evenly{1, 1.0 / 12};
/// A dashpot is as √L, so a contact of a part L of the side has a larger share of it. Of all parts, the one
/// of 0.48 at an end meets most: 0.166 of d² beside m².
inline constexpr Reach spread_dashpot{1, 1.0 / 6};
/// Along the side one spring acts where the pressure has its resultant: e = 1/2 − L/3 off the middle at most,
/// for pressure that is linear over the part L. L (m + e d)² is at most this for all L, and √L (m + e d)².
/// Of the pairs that will do, a and a/(36 (a − 1)) for springs, this gives bricks and triangles long steps.
inline constexpr Reach at_resultant{1.3, 13.0 / 108}, dashpot_at_resultant{1.2, 0.198};

/// Largest squared angular frequency of a body with all its springs, 1/s², and largest damping rate, 1/s.
struct BodyVote {
  double lambda = 0, gamma = 0;
  double gamma_alone = 0;     ///< without dashpots of contacts
  double elastic_lambda = 0;  ///< of its strain modes alone
  double spring_lambda = 0;   ///< of its springs alone, among fixed things
};

/// [side of boundary_of() the body]
using SpringsOfSides = std::vector<SideSprings>;

/// A body that moves as a whole: 6 or 3 unknowns, solved outright, less those that its support gives. Its
/// contacts count `factor` times.
BodyVote vote_as_a_whole(const Scene& scene, const Model& model, std::uint32_t body,
                         const SpringsOfSides& springs, const Support& support, double factor);

/// A body of many elements, by Lanczos iteration with the residual added: never below the true value but for
/// rounding. `mass`: of the model.
BodyVote vote_of_patches(const Scene& scene, const Model& model, const PatchMass& mass, std::uint32_t body,
                         const SpringsOfSides& springs, double factor);

}  // namespace talus
