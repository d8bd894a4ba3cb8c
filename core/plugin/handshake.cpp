#include "plugin/instructions.hpp"
#include "plugin/refusal.hpp"

#include "plugin/registry.hpp"
#include "text/printable.hpp"

#include <fmt/format.h>

#include <set>
#include <string_view>
#include <utility>

namespace talus {
namespace {

std::string rebuild() {
  return fmt::format("rebuild it against the headers of talus {} (ABI {})", TALUS_VERSION, abi_number);
}

std::optional<std::string> reason_in_sizes(const Library& library) {
  // Its own size comes first: a shorter descriptor has no further members to read.
  if (library.library_size != sizeof(Library)) {
    return fmt::format("found Library of {} bytes, wanted {}; {}", library.library_size, sizeof(Library),
                       rebuild());
  }
  struct Size {
    const char* type;
    std::uint32_t found;
    std::size_t wanted;
  };
  const Size sizes[] = {{"Component", library.component_size, sizeof(Component)},
                        {"Parameter", library.parameter_size, sizeof(Parameter)},
                        {"ContactBatch", library.contact_batch_size, sizeof(ContactBatch)},
                        {"ContactLoads", library.contact_loads_size, sizeof(ContactLoads)},
                        {"BodyPair", library.body_pair_size, sizeof(BodyPair)},
                        {"MaterialBatch", library.material_batch_size, sizeof(MaterialBatch)},
                        {"BodyShape", library.body_shape_size, sizeof(BodyShape)},
                        {"Boundaries", library.boundaries_size, sizeof(Boundaries)},
                        {"BoundaryCorner", library.boundary_corner_size, sizeof(BoundaryCorner)}};
  for (const Size& size : sizes) {
    if (size.found != size.wanted) {
      return fmt::format("found {} of {} bytes, wanted {}; {}", size.type, size.found, size.wanted,
                         rebuild());
    }
  }
  return std::nullopt;
}

std::optional<std::string> reason_in_identity(const Library& library) {
  if (library.units == nullptr || std::string_view(library.units) != unit_system) {
    return fmt::format("found the unit system '{}', wanted '{}'; convert the library to these units and {}",
                       library.units == nullptr ? "" : library.units, unit_system, rebuild());
  }
  const std::pair<const char*, const char*> members[] = {
      {"name", library.name}, {"version", library.version}, {"author", library.author}};
  for (const auto& [member, text] : members) {
    if (text == nullptr || *text == '\0') {
      return fmt::format("found no {} in its descriptor, wanted one; set talus_library.{} and rebuild it",
                         member, member);
    }
    if (!printable(text)) {
      return fmt::format(
          "found the {} to hold control characters or to be no UTF-8, wanted one line of UTF-8; correct "
          "talus_library.{} and rebuild it",
          member, member);
    }
  }
  if (library.component_count == 0 || library.components == nullptr) {
    return "found no components in its descriptor, wanted at least one; set talus_library.components and "
           "component_count and rebuild it";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> reason_in_numbers(const Library& library) {
  // Magic and ABI number stand in the first eight bytes of every version; nothing else can be trusted before.
  if (library.magic != library_magic) {
    return fmt::format(
        "found the magic number {:#010x} in talus_library, wanted {:#010x}; this is no talus plugin: take it "
        "out "
        "of the folders of plugins, or make its descriptor a talus::Library",
        library.magic, library_magic);
  }
  if (library.abi != abi_number) {
    return fmt::format("found ABI {}, wanted ABI {}; {}", library.abi, abi_number, rebuild());
  }
  if (auto reason = reason_in_sizes(library)) return reason;
  if (const std::string lacking = instructions_lacking(library.instructions); !lacking.empty()) {
    return fmt::format(
        "found code for instructions that this machine lacks ({}), wanted a library that runs here; rebuild "
        "it "
        "without -march=native or the like (talus_add_plugin(name SIMD ...) builds one for each kind of "
        "machine)",
        lacking);
  }
  return std::nullopt;
}

std::optional<std::string> reason_to_refuse(const Library& library) {
  if (auto reason = reason_in_numbers(library)) return reason;
  if (auto reason = reason_in_identity(library)) return reason;
  std::set<std::pair<ComponentKind, std::string_view>> names;
  for (std::uint32_t i = 0; i < library.component_count; ++i) {
    const Component& component = library.components[i];
    if (const auto reason = reason_to_refuse(component)) {
      const bool named = component.name != nullptr && *component.name != '\0';
      return fmt::format("component {}{}: {}", i, named ? fmt::format(" '{}'", component.name) : "", *reason);
    }
    if (!names.emplace(component.kind, component.name).second) {
      return fmt::format("found two {}s called '{}', wanted names that differ; rename one and rebuild it",
                         kind_in_words(component.kind), component.name);
    }
  }
  return std::nullopt;
}

}  // namespace talus
