#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace talus::overlap {

/// What the host keeps for each overlap: eight doubles, a line of the cache.
struct FrictionHistory {
  double elastic;         ///< N/m, tangential spring force on body b along s_c: −α_T V (Eq. 41)
  double applied;         ///< N/m, tangential force, by return mapping with that of the dashpot
  double stored;          ///< J/m, in the tangential spring
  double contact_length;  ///< m, L projected on s_c
  double x, y;            ///< m, where it is, in the frame of the pair: to know it again
  double slip;            ///< direction of the force while slipping (±1), 0 while sticking
  double strips;  ///< where one is a strip, name_of_strips(); else 0, or what the lanes remember of plain
                  ///< bodies (TouchingPair)
};

inline constexpr unsigned friction_doubles = 8, slip_in_history = 6;

/// Tells the strips of a pair of bodies apart by their first corners, in one number that is exact: bodies
/// have fewer than 2²⁶ corners each. Of a body without strips 0 will do.
inline double name_of_strips(std::uint32_t first_a, std::uint32_t first_b) {
  constexpr std::uint64_t most = 1u << 26;
  return 1.0 + static_cast<double>(first_a % most * most + first_b % most);
}

enum class FrictionRule { return_mapping, paper };

struct FrictionInput {
  double stiffness;       ///< N/m per metre of thickness, α_T L
  double limit;           ///< N/m, Σ μ_k N_k; infinite while friction is held stuck
  double contact_length;  ///< m
  double increment;  ///< m, slip of b against a since t_{n-1}: where friction acts, or with the paper's rule
                     ///< the mean along the arcs (Eq. 38 over L)
};

/// Elastic trial and return to the limit. When the contact shrinks the spring force shrinks with it, or
/// shearing, unloading and shearing back would create energy.
inline FrictionHistory return_mapping(const FrictionHistory& old, const FrictionInput& in) {
  FrictionHistory now = old;
  const double carried = in.contact_length < old.contact_length
                             ? old.elastic * (in.contact_length / old.contact_length)
                             : old.elastic;
  const double trial = carried - in.stiffness * in.increment;
  now.elastic = now.applied = std::clamp(trial, -in.limit, in.limit);
  now.slip = std::abs(trial) > in.limit ? std::copysign(1.0, trial) : 0.0;
  return now;
}

/// Table 1 to the letter: V := 0 at slip, stick again when the slip increment changes sign. sgn(V) of Eq. 43
/// is undefined once V is zero; the direction in which the contact slips takes its place.
inline FrictionHistory paper_rule(const FrictionHistory& old, const FrictionInput& in) {
  FrictionHistory now = old;
  if (old.slip != 0 && old.slip * in.increment <= 0) {
    now.elastic = 0;
    now.applied = old.slip * in.limit;
    return now;
  }
  const double trial = old.elastic - in.stiffness * in.increment;
  const bool slips = std::abs(trial) > in.limit;
  now.slip = slips ? std::copysign(1.0, trial) : 0.0;
  now.elastic = slips ? 0 : trial;
  now.applied = slips ? now.slip * in.limit : trial;
  return now;
}

inline FrictionHistory advance(FrictionRule rule, const FrictionHistory& old, const FrictionInput& in) {
  FrictionHistory now = rule == FrictionRule::paper ? paper_rule(old, in) : return_mapping(old, in);
  now.contact_length = in.contact_length;
  now.stored = in.stiffness > 0 ? now.elastic * now.elastic / (2 * in.stiffness) : 0;
  return now;
}

}  // namespace talus::overlap
