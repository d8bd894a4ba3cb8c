#pragma once

#include "plugin/descriptor_in_file.hpp"
#include "plugin/simd_level.hpp"

#include <talus/library.hpp>

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A library that does not fit, in words: the file, what was found, what was wanted, what to do.
class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A component with the library it came from. Stays valid as long as the process: libraries are never
/// unloaded.
struct RegisteredComponent {
  const Component* component;
  const Library* library;
  std::filesystem::path file;
  std::filesystem::path opened{};  ///< that, or what it is built as for the instruction set in use
};

struct RefusedLibrary {
  std::filesystem::path file;
  std::string reason;  ///< without the name of the file
};

/// A library of the folders that is not loaded until somebody names what it brings.
struct OfferedLibrary {
  std::filesystem::path file;
  std::vector<ComponentName> brings;
};

/// The components that can be named by a scene.
class Registry {
 public:
  /// Takes all components of a checked library, or none: throws PluginError when a name is already taken.
  void add(const Library& library, const std::filesystem::path& file, const std::filesystem::path& opened);
  void add(const Library& library, const std::filesystem::path& file) { add(library, file, file); }

  const RegisteredComponent* find(ComponentKind kind, std::string_view name) const;
  std::vector<std::string> names(ComponentKind kind) const;  ///< sorted
  const std::deque<RegisteredComponent>& components() const { return components_; }
  std::vector<RefusedLibrary> refused;  ///< libraries of the search folders that did not fit
  std::vector<OfferedLibrary> offered;  ///< in the order of the folders

  /// Of a library that was built for several levels, the best up to this one is loaded.
  SimdLevel simd = best_simd_level();

 private:
  std::deque<RegisteredComponent> components_;  ///< scenes point into it while more come
};

/// Words for what is wrong with a descriptor, or nothing if it fits this program (magic, ABI, sizes, units,
/// tables).
std::optional<std::string> reason_to_refuse(const Library& library);

/// Loads one library by its absolute path and adds its components. Throws PluginError.
void load_library(Registry& registry, const std::filesystem::path& file);

/// Loads `lib*.so` of each folder in order and in sorted order within; a library that does not fit goes to
/// `registry.refused`. A component name found in an earlier folder wins silently only over the same file.
void load_folders(Registry& registry, std::span<const std::filesystem::path> folders);

/// The same folders, but a library whose file tells what it brings is loaded by demand() alone: what nobody
/// names runs no code and takes no memory.
void offer_folders(Registry& registry, std::span<const std::filesystem::path> folders);

/// A component, its library loaded if it was offered; of several that bring the name the first, as by
/// load_folders(). Null where there is none.
const RegisteredComponent* demand(Registry& registry, ComponentKind kind, const std::string& name);

/// Loads all that is still offered.
void load_offered(Registry& registry);

/// The prefix of the installation this program belongs to: the folder above that of the program itself.
std::filesystem::path installation_prefix();

/// --plugin-path entries, then TALUS_PLUGIN_PATH (colon-separated).
std::vector<std::filesystem::path> chosen_folders(std::span<const std::filesystem::path> from_command_line);
/// These, then lib/talus/plugins of the installation this program belongs to.
std::vector<std::filesystem::path> search_path(std::span<const std::filesystem::path> from_command_line);

/// Bytes for the reason of a refusal, its end included.
inline constexpr std::size_t room_for_words = 512;

/// What a plugin says of itself, fit for a terminal: in one line, without control characters; where it says
/// nothing, that.
std::string words_of_plugin(std::string_view said);

/// Doubles that a contact law may keep per contact, a material per element.
inline constexpr std::uint32_t most_state_doubles = 4096;

/// Owns an object made by a plugin, destroyed by the same plugin.
template <class Interface>
using Made = std::unique_ptr<Interface, void (*)(void*) noexcept>;

/// Makes a component. Throws PluginError with the words of its constructor when it fails.
template <class Interface>
Made<Interface> make(const RegisteredComponent& entry, std::span<const double> values) {
  char error[room_for_words] = "";
  void* object = entry.component->create(values.data(), error, sizeof error);
  if (object == nullptr) {
    throw PluginError(entry.file.string() + ": '" + entry.component->name +
                      "' could not be made: " + words_of_plugin(error));
  }
  return Made<Interface>(static_cast<Interface*>(object), entry.component->destroy);
}

}  // namespace talus
