#pragma once

#include <talus/library.hpp>

// What the test libraries share: a contact law that does nothing, and a descriptor that is right in every
// respect but the one its file is about.

class SilentLaw : public talus::ContactModel {
 public:
  explicit SilentLaw(const double* /*values*/) {}
  std::uint32_t doubles_per_contact() const noexcept override { return 0; }
  void evaluate(const talus::ContactBatch&, const talus::ContactLoads&) const noexcept override {}
  talus::ContactStiffness stiffness(const double*, double) const noexcept override { return {}; }
};

template <class Law>
constexpr talus::Component law(const char* name) {
  return {talus::ComponentKind::contact_model,
          name,
          "A law for tests.",
          nullptr,
          0,
          nullptr,
          0,
          talus::create_component<talus::ContactModel, Law>,
          talus::destroy_component<talus::ContactModel>};
}

constexpr talus::Library descriptor(const talus::Component* components, std::uint32_t count) {
  talus::Library library;
  library.name = "test library";
  library.version = "1.0";
  library.author = "the tests of talus";
  library.components = components;
  library.component_count = count;
  return library;
}
