#pragma once

#include <talus/contact_model.hpp>
#include <talus/cover_builder.hpp>
#include <talus/instructions.hpp>
#include <talus/material.hpp>
#include <talus/parameter.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>

namespace talus {

inline constexpr std::uint32_t library_magic = 0x554C4154u;  // "TALU" in memory order

/// Bumped when a layout, a meaning or a default changes: an old plugin is then refused, never misread.
inline constexpr std::uint32_t abi_number = 19;

inline constexpr const char* unit_system = "SI: m kg s, radian, per metre of thickness";

enum class ComponentKind : std::uint32_t { contact_model, material, cover_builder };

/// What a component claims beyond what is due of all of its kind, as a sum. `talus check-plugin` holds it to
/// its claims; what it does not claim is reported as such.
namespace trait {
/// Contact law: without friction and damping its forces are −∂stored/∂q of the bodies' places. Material: its
/// stress is ∂energy/∂F, without viscosity.
inline constexpr std::uint32_t has_potential = 1;
/// Contact law: bodies may pull at each other even where cohesion and tensile strength are zero.
inline constexpr std::uint32_t pulls = 2;
/// Contact law: springs and dashpots across a contact are spread evenly along it, so that a flat one that
/// rocks meets a third of what they would be at its two ends. Those along it are spread, too, or act as one
/// where the pressure has its resultant. Steps can be longer for it.
inline constexpr std::uint32_t spread_springs = 4;
}  // namespace trait

struct Component {
  ComponentKind kind;
  const char* name;      ///< what a scene writes as "model"
  const char* sentence;  ///< what it is, one sentence
  const Parameter* parameters;
  std::uint32_t parameter_count;
  const Parameter* interface_parameters;  ///< contact models: what it reads of an interface
  std::uint32_t interface_parameter_count;

  /// Makes the object from `parameter_count` values. On failure returns nullptr with the reason in `error`
  /// (zero-terminated, at most error_size bytes). Never throws.
  void* (*create)(const double* values, char* error, std::size_t error_size) noexcept;
  void (*destroy)(void* object) noexcept;

  std::uint32_t traits = 0;  ///< sum of what it claims, see `trait`
};

/// The one thing a plugin exports: `extern "C" const talus::Library talus_library`, constant-initialised, so
/// that it can be read from the file before any code of the plugin runs. The first three members never move.
struct Library {
  std::uint32_t magic = library_magic;
  std::uint32_t abi = abi_number;
  std::uint32_t library_size = sizeof(Library);
  std::uint32_t component_size = sizeof(Component);
  std::uint32_t parameter_size = sizeof(Parameter);
  std::uint32_t contact_batch_size = sizeof(ContactBatch);
  std::uint32_t contact_loads_size = sizeof(ContactLoads);
  std::uint32_t body_pair_size = sizeof(BodyPair);
  std::uint32_t material_batch_size = sizeof(MaterialBatch);
  std::uint32_t body_shape_size = sizeof(BodyShape);
  std::uint32_t boundaries_size = sizeof(Boundaries);
  std::uint32_t boundary_corner_size = sizeof(BoundaryCorner);
  std::uint64_t instructions = instructions_in_use();  ///< bits of InstructionSet that its code may use
  const char* units = unit_system;
  const char* name = nullptr;
  const char* version = nullptr;
  const char* author = nullptr;
  const Component* components = nullptr;
  std::uint32_t component_count = 0;
};

/// Makes a `Model` behind its abstract class; what its constructor throws becomes the refusal's words. The
/// object crosses the door as a pointer to the abstract `Interface`.
template <class Interface, class Model>
void* create_component(const double* values, char* error, std::size_t error_size) noexcept {
  try {
    return static_cast<Interface*>(new Model(values));
  } catch (const std::exception& problem) {
    std::snprintf(error, error_size, "%s", problem.what());
  } catch (...) {
    std::snprintf(error, error_size, "the constructor threw something that is no std::exception");
  }
  return nullptr;
}

template <class Interface>
void destroy_component(void* object) noexcept {
  delete static_cast<Interface*>(object);
}

/// A table of parameters, or none.
struct ParameterTable {
  constexpr ParameterTable() = default;
  template <std::size_t count>
  constexpr ParameterTable(const Parameter (&table)[count]) : first(table), size(count) {}

  const Parameter* first = nullptr;
  std::uint32_t size = 0;
};

template <class Interface, class Model>
constexpr Component component(ComponentKind kind, const char* name, const char* sentence,
                              ParameterTable parameters, ParameterTable interface_parameters,
                              std::uint32_t traits) {
  return {kind,
          name,
          sentence,
          parameters.first,
          parameters.size,
          interface_parameters.first,
          interface_parameters.size,
          create_component<Interface, Model>,
          destroy_component<Interface>,
          traits};
}

/// Entries of a library's list of components; `Model` is made from its parameter values, `Model(const
/// double*)`. `traits` is a sum of constants of `trait`.
template <class Model>
constexpr Component contact_model(const char* name, const char* sentence, ParameterTable parameters,
                                  ParameterTable interface_parameters, std::uint32_t traits = 0) {
  return component<ContactModel, Model>(ComponentKind::contact_model, name, sentence, parameters,
                                        interface_parameters, traits);
}

template <class Model>
constexpr Component material(const char* name, const char* sentence, ParameterTable parameters,
                             std::uint32_t traits = 0) {
  return component<Material, Model>(ComponentKind::material, name, sentence, parameters, {}, traits);
}

template <class Model>
constexpr Component cover_builder(const char* name, const char* sentence, ParameterTable parameters) {
  return component<CoverBuilder, Model>(ComponentKind::cover_builder, name, sentence, parameters, {}, 0);
}

template <std::size_t count>
constexpr Library library(const char* name, const char* version, const char* author,
                          const Component (&components)[count]) {
  Library result;
  result.name = name;
  result.version = version;
  result.author = author;
  result.components = components;
  result.component_count = count;
  return result;
}

}  // namespace talus

/// Before the definition of `talus_library`: TALUS_EXPORT const talus::Library talus_library =
/// talus::library(…);
#define TALUS_EXPORT extern "C" constinit __attribute__((visibility("default")))
