#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What is fuzzed: a function each that takes any bytes. It returns where they were read or refused in words,
/// and throws anything else, or crashes, where talus is wrong.
namespace talus::fuzz {

void read_scene(std::string_view bytes);
void read_mesh(std::string_view bytes);
void read_drawing(std::string_view bytes);
void read_tables(std::string_view bytes);
void read_checkpoint(std::string_view bytes);
void read_frame(std::string_view bytes);
void overlap_polygons(std::string_view bytes);

struct Target {
  const char* name;  ///< also of its folder in corpus/
  void (*run)(std::string_view bytes);
};

inline constexpr Target targets[] = {
    {"scene", read_scene},           {"mesh", read_mesh},
    {"drawing", read_drawing},       {"tables", read_tables},
    {"checkpoint", read_checkpoint}, {"frame", read_frame},
    {"overlap", overlap_polygons},
};

/// What must hold whatever the bytes are.
inline void demand(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace talus::fuzz
