#pragma once

#include <talus/library.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// What a file holds under the name of a descriptor, read without loading it: no code of it runs.
struct DescriptorInFile {
  bool is_library =
      false;  ///< a shared library of this kind of machine; what else it is, the loader will say
  bool has_symbol = false;
  Library bytes{};  ///< its numbers; pointers are those of the file and lead nowhere
};

/// Reads the descriptor `symbol` of an ELF file; of one that is shorter than ours, the rest is zero. Throws
/// std::system_error when the file cannot be read.
DescriptorInFile descriptor_in_file(const std::filesystem::path& file, std::string_view symbol);

/// What a scene calls a component.
struct ComponentName {
  ComponentKind kind;
  std::string name;

  bool operator==(const ComponentName&) const = default;
};

/// The names of the components of a library, read without loading it. Nothing where its file does not tell
/// them, or where its numbers do not fit this program: loading it will tell. Throws std::system_error when
/// the file cannot be read.
std::optional<std::vector<ComponentName>> components_in_file(const std::filesystem::path& file,
                                                             std::string_view symbol);

}  // namespace talus
