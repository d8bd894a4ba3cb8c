#pragma once

#include "scene/read.hpp"

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace talus::verification {

/// Where cases take their scenes from. Several may read at the same time.
class Bench {
 public:
  /// `scenes` is the folder of the shipped scenes. The registry must outlive what is read.
  Bench(Registry& registry, std::filesystem::path scenes) : registry_(registry), scenes_(std::move(scenes)) {}

  /// A shipped scene by its name, with overrides. Throws what read_scene throws.
  Scene shipped(const std::string& name, const std::vector<Override>& overrides = {}) const;
  Scene from_text(const std::string& text, const std::vector<Override>& overrides = {}) const;

 private:
  Registry& registry_;
  std::filesystem::path scenes_;
  mutable std::mutex reading_;
};

/// "[[0, 0], [1, 0], …]", with all digits.
std::string polygon_text(const std::vector<Vec2>& corners);

/// "rock", linearly elastic with E = 1e10 Pa, ν = 0.25 and 2300 kg/m³, the material of most cases.
inline constexpr const char* rock_text =
    R"("rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25})";

/// A folder for what a scene names by path, gone with the object. Throws std::system_error.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Writes a file and returns its absolute path.
  std::string write(const std::string& name, const std::string& contents) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace talus::verification
