#pragma once

#include <algorithm>
#include <cmath>

namespace talus::vertex_edge {

/// What the host keeps for each vertex on an edge: ten doubles.
struct SpringHistory {
  double key;      ///< 1 + number of the vertex, 0 for none
  double elastic;  ///< N/m, tangential spring force on the vertex along the edge, of the whole spring
  double stored;   ///< J/m, of the tangential spring, as counted (with the share)
  double intact;   ///< 1 while cohesion and tensile strength hold
  double applied;  ///< N/m, tangential force as counted, without damping
  double pulled;   ///< J/m, what its bond holds across a gap, as counted: lost when it breaks
  double side;     ///< number of the side that it stands on
  double viscous;  ///< N/m, what its tangential dashpot adds to `applied`
  double lent;     ///< m, CornerContact::lent
  double stretch;  ///< SpringParameters::stretch; 0 before it acts

  /// N/m, what is left of the spring force now. As the stretch gets shorter the force goes with it, or
  /// shearing, easing and shearing back would make energy.
  double carried(double now) const { return now < stretch ? elastic * (now / stretch) : elastic; }
};

inline constexpr unsigned spring_doubles = 10;

/// Per area where springs are, tan φ, shares of critical damping, Pa.
struct Interface {
  double normal_stiffness, tangential_stiffness, friction, normal_damping, tangential_damping, cohesion,
      tensile;
};

/// Springs and strength of one vertex contact.
struct SpringParameters {
  double normal, tangential;  ///< N/m per metre of thickness
  double friction;            ///< μ
  double cohesion, tensile;   ///< N/m, strength times tributary length; zero once the bond is broken
  double stretch;             ///< m, that the stiffness goes with; any but always the same if that is given
  double least;               ///< N/m, tension of a gap that is only rounding, which cohesion survives
};

struct SpringForce {
  double normal;      ///< N/m, positive in compression
  double tangential;  ///< N/m, on the vertex along the edge
  bool slips, breaks;
};

/// c l + N tan φ, less under tension, N/m.
inline double shear_strength(const SpringParameters& spring, double normal) {
  return std::max(0.0, spring.cohesion + spring.friction * normal);
}

/// Mohr–Coulomb with tension cut-off: no more than c l + N tan φ along the edge, no more than σ_t l across
/// it; a bond that slips is broken, but one without any strength along the edge only ties. `viscous` is what
/// a dashpot adds to the normal force. While the scene settles what has strength is held: along the edge also
/// across a gap, which without tensile strength nothing pulls at.
inline SpringForce spring_force(const SpringParameters& spring, double depth, double viscous,
                                double old_tangential, double slip, bool held) {
  SpringForce force{spring.normal * depth, old_tangential - spring.tangential * slip, false, false};
  if (force.normal < -std::max(spring.tensile, spring.least)) {
    if (!held || (spring.tensile == 0 && spring.cohesion == 0)) return {0, 0, false, true};
    if (spring.tensile == 0) force.normal = 0;
  }
  const double limit = shear_strength(spring, force.normal + viscous);
  const bool without_strength = spring.friction == 0 && spring.cohesion == 0;
  if (held && !without_strength) return force;
  if (std::abs(force.tangential) > limit) {
    force.slips = true;
    force.breaks = !without_strength;
    force.tangential =
        std::copysign(spring.friction * std::max(0.0, force.normal + viscous), force.tangential);
  }
  return force;
}

}  // namespace talus::vertex_edge
