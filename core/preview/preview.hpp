#pragma once

#include "simulation/simulation.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace talus {

/// An interface's normal stiffness against that of a body it belongs to, E/h.
struct StiffnessShare {
  std::size_t row;     ///< of /interfaces
  std::uint32_t body;  ///< a moving one that deforms
  double stiffness;    ///< Pa/m
  double young;        ///< Pa, E
  double width;        ///< m, h: smallest width of the body, or size of its elements where that is less
  double stilling;  ///< s, a damping_time that stills what flutters with friction; 0: none, or damped already

  double share() const { return stiffness * width / young; }
};

/// What a run of a scene would be.
struct Preview {
  double smallest_edge = 0;  ///< m, of the outlines
  std::uint32_t smallest_edge_body = 0;
  std::size_t pairs = 0, contacts = 0;  ///< candidate pairs and contacts at t = 0, before any settling
  double overlap = 0;                   ///< m, the deepest contact among these
  std::uint32_t overlap_a = 0, overlap_b = 0;
  double dt = 0;                     ///< s, of the first step
  std::string dt_limiter;            ///< in words
  std::vector<CriticalStep> stages;  ///< the bound of the step in each of them, if bodies met as at t = 0
  double steps = 0, settle_steps = 0;
  std::uint64_t trial_steps = 0;
  double trial_seconds = 0;      ///< what these steps took, here and with one thread
  double estimated_seconds = 0;  ///< for all steps and files, from these
  std::size_t memory = 0;        ///< bytes that this program came to hold
  std::uint64_t rows = 0, frames = 0,
                bytes = 0;  ///< of the files of results, bytes by the state after the trial
  std::optional<StiffnessShare> softest, stiffest;
  std::optional<StiffnessShare> fluttering;  ///< the stiffest that may flutter with friction
  std::vector<std::string> warnings;         ///< of the simulation, and what a reviewer would raise
};

/// Looks at the scene at t = 0, without settling, and takes steps for `trial_seconds`. The simulation is used
/// up.
Preview preview(Simulation& simulation, double trial_seconds);

/// What a reviewer would raise about a scene that can be run with steps of `dt`, s.
std::vector<std::string> review(const Scene& scene, double dt);

/// Asks about values of materials and interfaces that look as if they were given in other units.
void question_units(const Scene& scene, std::vector<std::string>& raised);

/// Asks about bonds that hold against slip and not against opening.
void question_bonds(const Scene& scene, std::vector<std::string>& raised);

/// Softest and stiffest of the interfaces between surfaces that can meet, by E/h, and the stiffest of those
/// with friction on a body that nothing damps; none where no body deforms or the law reads no
/// normal_stiffness.
void compare_stiffness(const Simulation& simulation, Preview& preview);

}  // namespace talus
