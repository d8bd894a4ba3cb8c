#pragma once

#include "simulation/simulation.hpp"

#include <optional>
#include <string>
#include <vector>

namespace talus {

/// What one step looked like.
struct DiagnosedStep {
  double time = 0, dt = 0;  ///< s
  double kinetic = 0;       ///< J/m
  double residual = 0;      ///< J/m that the ledger misses
  double share = 0;         ///< of the throughput
  double damped = 0;        ///< J/m, taken by dashpots of contacts
  double penetration = 0;   ///< m, of the deepest contact, if there is any
  double depth = 0;         ///< share of the smaller width of its bodies
  std::uint32_t body_a = 0, body_b = 0;
  Vec2 place;  ///< m, without the scene's origin
};

/// How a run went wrong, step by step from a state that was still good.
struct Diagnosis {
  std::vector<DiagnosedStep> steps;
  std::optional<std::size_t> first_bad;  ///< the first in which something can be seen of what ended the run
  std::string trouble;                   ///< what stopped it this time; "" if nothing did
  CriticalStep bound{};                  ///< of the stable step, at the end
  std::vector<std::string> advice;       ///< what to change, most promising first
};

/// Goes on from where a simulation is, looking at each step, until it is stopped or `most_steps` are done.
Diagnosis diagnose(Simulation& simulation, std::size_t most_steps);

/// In words and a table, for a reader.
std::string diagnosis_text(const Scene& scene, const Diagnosis& diagnosis);

}  // namespace talus
