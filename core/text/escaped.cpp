#include "text/escaped.hpp"

#include "text/printable.hpp"

namespace talus {

namespace {

/// Pages are of UTF-8, and nobody reads one that is not.
bool is_utf8(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F) letter = ' ';
  }
  return printable(text);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  const bool whole = is_utf8(std::string(text));
  for (const char letter : text) {
    switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // XML has no place for control characters.
        const auto code = static_cast<unsigned char>(letter);
        const bool bare = code < 0x20 && letter != '\n' && letter != '\t';
        result += bare || (!whole && code >= 0x80) ? '?' : letter;
    }
  }
  return result;
}

}  // namespace talus
