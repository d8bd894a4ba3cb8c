#pragma once

#include "scene/scene.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus {

/// One mistake in a scene, where it stands and what would be right.
struct Mistake {
  std::string file;
  std::size_t line = 0, column = 0;  ///< from 1; 0 where a --set override is at fault
  std::string pointer;               ///< JSON pointer
  std::string message;               ///< what is wrong, the value, what is allowed, the nearest valid name

  std::string text() const;  ///< "file:line:column: pointer: message"
};

/// All mistakes of a scene at once. Of very many the first ones; the last entry then says how many more.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Mistake> mistakes, std::size_t more = 0);
  std::vector<Mistake> mistakes;
  std::size_t more;                   ///< that `mistakes` does not list
  std::vector<std::string> warnings;  ///< of a drawing, say, that a mistake may come from
};

/// "--set /pointer=value"; the value is JSON, or a bare word taken as a string.
struct Override {
  std::string pointer, value;
};

struct ReadOptions {
  std::vector<Override> overrides;
  bool allow_plugins =
      false;  ///< whether libraries that the scene names by path may be loaded into the registry
  double most_blocks = 1e6;  ///< of one generator; so many are some gigabytes as JSON and as bodies
};

/// Reads and validates a scene. Throws SceneError with every mistake; std::system_error when the file cannot
/// be read.
Scene read_scene(const std::filesystem::path& file, Registry& registry, const ReadOptions& options = {});

/// The same of a file whose text is at hand.
Scene read_scene(const std::filesystem::path& file, const std::string& text, Registry& registry,
                 const ReadOptions& options = {});

/// The same from text that no file holds; `name` stands for the file in messages.
Scene read_scene_text(const std::string& text, const std::string& name, Registry& registry,
                      const ReadOptions& options = {});

/// The scene as it is written, with the overrides, and with plain bodies in place of the generators in
/// "blocks". Comments before the first brace stay. Throws what read_scene throws.
std::string plain_scene_text(const std::string& text, const std::string& name, Registry& registry,
                             const ReadOptions& options = {});

}  // namespace talus
