#pragma once

#include "conformance/driven_law.hpp"
#include "plugin/registry.hpp"

#include <string>
#include <vector>

namespace talus::bench {

using namespace conformance;

/// The registry of the laws that ship, and the names of all contact laws in it.
Registry& registry();
std::vector<std::string> laws();
/// Whether a law reads a friction angle, and those that do.
bool has_friction(const std::string& law);
std::vector<std::string> frictional_laws();
/// Those whose pressure on a flat contact is the stiffness times the depth. Not so `feng_volume`, and
/// `potential_symmetric` only for square pieces.
std::vector<std::string> linear_laws();

/// Drives a law that ships, by its name.
class LawBench : public DrivenLaw {
 public:
  explicit LawBench(const std::string& law, const Values& interface = lively_interface(),
                    const Values& parameters = {})
      : DrivenLaw(*registry().find(ComponentKind::contact_model, law), interface, parameters) {}
};

}  // namespace talus::bench
