#pragma once

#include "scene/positions.hpp"

#include <string>

namespace talus {

struct SyntaxError {
  std::size_t offset;  ///< of the first byte that does not fit
  std::string message;
};

/// Start of the token (no number) that ends with byte number `taken`.
std::size_t token_start(const std::string& text, std::size_t taken);

/// The same for a number.
std::size_t number_start(const std::string& text, std::size_t taken);

/// Line and column of a byte offset.
Place place_of(const std::string& text, std::size_t offset);

/// The same for offsets that mostly rise, each from where the last one was: a text with a mistake in every
/// line would else be counted through from its start for each.
class PlaceCounter {
 public:
  explicit PlaceCounter(const std::string& text) : text_(text) {}
  Place at(std::size_t offset);

 private:
  const std::string& text_;
  std::size_t offset_ = 0;
  Place place_{1, 1};
};

/// Turns the parser's words about byte number `byte` (from 1) into those of a user.
SyntaxError explain_syntax_error(const std::string& text, std::size_t byte, const std::string& words);

}  // namespace talus
