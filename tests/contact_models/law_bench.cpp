#include "contact_models/law_bench.hpp"

#include <stdexcept>

namespace talus::bench {

Registry& registry() {
  static Registry all = [] {
    Registry made;
    const std::filesystem::path folder = TALUS_PLUGINS;
    load_folders(made, {&folder, 1});
    if (!made.refused.empty()) throw std::runtime_error(made.refused[0].reason);
    return made;
  }();
  return all;
}

std::vector<std::string> laws() {
  return registry().names(ComponentKind::contact_model);
}

bool has_friction(const std::string& law) {
  const Component& component = *registry().find(ComponentKind::contact_model, law)->component;
  for (std::uint32_t i = 0; i < component.interface_parameter_count; ++i) {
    if (std::string(component.interface_parameters[i].key) == "friction_angle") return true;
  }
  return false;
}

std::vector<std::string> frictional_laws() {
  std::vector<std::string> some = laws();
  std::erase_if(some, [](const std::string& law) { return !has_friction(law); });
  return some;
}

std::vector<std::string> linear_laws() {
  std::vector<std::string> some = laws();
  std::erase(some, "feng_volume");
  std::erase(some, "potential_symmetric");
  return some;
}

}  // namespace talus::bench
