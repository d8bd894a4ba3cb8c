#pragma once

#include "arguments.hpp"
#include "log.hpp"
#include "scene/read.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// --set, --plugin-path and --allow-plugins, which all commands that read a scene share.
void add_scene_options(Usage& usage);
void add_plugin_path(Usage& usage);
void add_allow_plugins(Usage& usage);

/// The registry of all libraries on the search path.
Registry load_registry(const Usage& usage, const boost::program_options::variables_map& given);

/// The same for a scene, which says what it needs: what it does not name is not loaded.
Registry offered_registry(const Usage& usage, const boost::program_options::variables_map& given);

/// --plugin-path; throws UsageError if there is no such folder.
std::vector<std::filesystem::path> plugin_folders_of(const Usage& usage,
                                                     const boost::program_options::variables_map& given);

/// The file by that name, or where there is none, the one of that name that was installed with the program:
/// so "scenes/incline.json" runs from any folder. Which it takes then goes to stderr.
std::filesystem::path here_or_shipped(const std::filesystem::path& named);

/// A scene that a command line names, read once: it may be a pipe, and it may be edited while the command
/// works.
struct SceneFile {
  std::filesystem::path file;
  std::string text;
};

/// That of SCENE, here or shipped. Throws std::system_error where it cannot be read.
SceneFile scene_file_of(const boost::program_options::variables_map& given);

/// Throws InputError where a result would take the place of a scene or of a file that the scene reads.
void refuse_to_replace_what_is_read(const Scene& scene, const std::filesystem::path& result);

/// The overrides of --set.
std::vector<Override> overrides_of(const Usage& usage, const boost::program_options::variables_map& given);

/// --out, or out/<name of the scene's file> and the suffix. Throws InputError where that lies in the folder
/// of a comparison or a study at work, which would take what is written there for its own.
std::filesystem::path output_folder(const boost::program_options::variables_map& given,
                                    const SceneFile& scene, const std::string& suffix = "");

/// How many threads the machine runs at once, at least 1.
int cores();

/// --threads; `fallback` if it is not given.
int threads_of(const Usage& usage, const boost::program_options::variables_map& given, int fallback);

/// Libraries that a scene names by path, as far as its text can be read at all.
std::vector<std::string> named_libraries(const std::string& scene_text);

/// Mistakes of a scene, one of which is that it names libraries which nobody allowed.
class LibrariesNotAllowed : public SceneError {
 public:
  explicit LibrariesNotAllowed(const SceneError& problem) : SceneError(problem) {}
};

/// Whether what a scene lacks is the permission to load the libraries that it names.
bool wants_permission(const SceneError& problem);

/// Validates the scene. Throws LibrariesNotAllowed where it needs --allow-plugins. Warns of libraries that
/// were refused when a mistake may come from them; where another brings what one was to bring, the scene
/// does.
Scene read_scene_of(const SceneFile& scene, Registry& registry, const std::vector<Override>& overrides,
                    bool allow_plugins, const Log& log = {});

}  // namespace talus
