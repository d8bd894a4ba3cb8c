#pragma once

#include "scene/read.hpp"

#include <functional>
#include <string>
#include <vector>

namespace talus {

/// Collects all mistakes of a scene; where they stand is sought at the end.
class Mistakes {
 public:
  void add(std::string pointer, std::string message);         ///< at the value
  void add_at_key(std::string pointer, std::string message);  ///< at the key of the value
  void add_to_command(std::string command, std::string pointer, std::string message);  ///< at a --set

  std::size_t count() const { return found_.size() + untold_; }
  /// Whether there are so many that it is one, and not worth the time to look for what each may have meant.
  bool many() const { return count() >= many_; }

  struct Found {
    std::string pointer, message, command;
    bool at_key;
  };
  const std::vector<Found>& found() const { return found_; }

  /// Moves mistakes to other pointers. Those that then say the same of the same pointer are told once.
  void move(const std::function<std::string(const std::string& pointer)>& to);

  /// In the order of the file, then those of the overrides. A mistake in a value that an override wrote
  /// points at the override. `parsed` are those that the parser placed already. Of very many the first ones,
  /// and one that says how many more.
  SceneError placed(const std::string& text, const std::string& file, const std::vector<Override>& overrides,
                    std::vector<Mistake> parsed) const;

 private:
  void keep(Found found);

  static constexpr std::size_t many_ = 1000;
  std::vector<Found> found_;
  std::size_t untold_ = 0;  ///< not kept, since there are too many
};

/// "--set /time/dt=1e-4"
std::string command_of(const Override& override_);

}  // namespace talus
