#pragma once

#include "contact/contact_stage.hpp"
#include "model/model.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace talus {

struct CriticalStep {
  double dt;            ///< s
  std::string limiter;  ///< the body and what limits it, in words
};

/// Upper bound of the stable step of central differences: the smallest vote of all moving bodies, each over
/// its strain modes, its whole boundary in contact, and its penalty supports together. Tangential springs and
/// dashpots are included. Infinite if nothing vibrates.
///
/// A contact between moving bodies a and b is split by (q_a − q_b)² ≤ (1 + √(m_a/m_b)) q_a² + (1 +
/// √(m_b/m_a)) q_b², so the votes of single bodies bound the coupled system; with a fixed body the factor
/// is 1.
CriticalStep critical_step(const Scene& scene, const StageSettings& settings, const Model& model,
                           const ContactStage& contacts);

/// What the treatment of slivers does to the stable step of a body without its contacts.
struct SliverEffect {
  std::uint32_t body;
  std::size_t tied, heavier;  ///< patches merged into their neighbours, patches with inertia added
  double dt, untreated_dt;    ///< s
};
std::vector<SliverEffect> sliver_effects(const Scene& scene, const Model& model);

}  // namespace talus
