#pragma once

#include "plugin/registry.hpp"

#include <filesystem>
#include <string>

namespace talus::test {

inline std::filesystem::path library(const std::string& stem) {
  return std::filesystem::path(TALUS_TEST_LIBRARIES) / ("lib" + stem + ".so");
}

/// Words of the refusal, or "" when the library was taken.
inline std::string refusal_of(Registry& registry, const std::filesystem::path& file) {
  try {
    load_library(registry, file);
  } catch (const PluginError& refusal) {
    return refusal.what();
  }
  return "";
}

/// A component that fits, to be spoilt in one respect.
inline Component fitting_component(const char* name = "fitting") {
  Component component{};
  component.kind = ComponentKind::contact_model;
  component.name = name;
  component.sentence = "A component for tests.";
  component.create = [](const double*, char*, std::size_t) noexcept -> void* { return nullptr; };
  component.destroy = [](void*) noexcept {};
  return component;
}

inline Library fitting_library(const Component* components, std::uint32_t count) {
  Library library;
  library.name = "test library";
  library.version = "1.0";
  library.author = "the tests of talus";
  library.components = components;
  library.component_count = count;
  return library;
}

/// Words for what is wrong with one component, or "".
inline std::string reason_for(const Component& component) {
  return reason_to_refuse(fitting_library(&component, 1)).value_or("");
}

}  // namespace talus::test
