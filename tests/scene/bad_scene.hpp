#pragma once

#include "scene/sample.hpp"

#include <string>
#include <vector>

namespace talus::sample {

/// The good scene with one thing wrong, and what must be said about it.
struct BadScene {
  const char* requirement;
  const char* old_text;  ///< of the good scene
  const char* new_text;
  const char* pointer;
  std::size_t line, column;
  std::vector<const char*> words;
};

/// Checks place, pointer and words of a mistake found in `text`.
void check(const Mistake& mistake, const BadScene& bad, const std::string& text);

/// A part of a scene that holds one mistake, the text that stands where it is placed, and what must be said.
struct BadPart {
  const char* requirement;
  const char* part;
  const char* pointer;
  const char* at;
  std::vector<const char*> words;
};

/// Checks that `text`, which holds the part, has this mistake alone.
void check_alone(const BadPart& bad, const std::string& text);

}  // namespace talus::sample
