#include "scene/syntax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace talus {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '+' || c == '-' || c == '.';
}

/// Quotes within a string are preceded by an odd number of backslashes; the opening one cannot be, since no
/// backslash stands right before a string.
std::size_t string_start(const std::string& text, std::size_t closing) {
  std::size_t at = closing;
  while (at > 0) {
    --at;
    if (text[at] != '"') continue;
    std::size_t slashes = 0;
    while (slashes < at && text[at - 1 - slashes] == '\\') ++slashes;
    if (slashes % 2 == 0) return at;
  }
  return 0;
}

/// The parser's words between `from` and the next ';'.
std::string_view between(std::string_view words, std::string_view from) {
  const std::size_t start = words.find(from);
  if (start == std::string_view::npos) return {};
  words.remove_prefix(start + from.size());
  return words.substr(0, words.find(';'));
}

std::string wanted(std::string_view expected) {
  if (expected == "string literal") return "a key in double quotes";
  if (expected == "'}'") return "',' or '}'";
  if (expected == "']'") return "',' or ']'";
  if (expected == "end of input") return "nothing more after the scene's last brace";
  if (expected.find("literal") != std::string_view::npos) return "a value";
  return std::string(expected);
}

/// The last byte before `offset` that is no blank.
char before(const std::string& text, std::size_t offset) {
  const std::size_t at = offset == 0 ? std::string::npos : text.find_last_not_of(" \t\r\n", offset - 1);
  return at == std::string::npos ? '\0' : text[at];
}

/// 02800: the parser takes the zero for a number and stops at what follows.
bool begins_with_needless_zero(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  return word.size() > 1 && word[0] == '0' && std::isdigit(static_cast<unsigned char>(word[1])) != 0;
}

SyntaxError unexpected_token(const std::string& text, std::size_t byte, std::string_view words) {
  const std::string expected = wanted(between(words, "; expected "));
  if (between(words, "unexpected ") == "end of input") {
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    const std::size_t end = last == std::string::npos ? 0 : last + 1;
    return {end, fmt::format("the file ends where {} should follow", expected)};
  }
  const std::size_t start = token_start(text, byte);
  const std::string found = text.substr(start, std::min<std::size_t>(byte - start, 40));
  if ((found == "}" || found == "]") && before(text, start) == ',') {
    return {start, fmt::format("the comma before '{}' is one too many", found)};
  }
  if (found.empty()) return {start, fmt::format("found nothing where {} should stand", expected)};
  if (begins_with_needless_zero(found)) {
    return {start,
            fmt::format("'{}' is no JSON value: no number begins with a zero before other digits", found)};
  }
  return {start, fmt::format("found {} where {} should stand", found[0] == '"' ? found : "'" + found + "'",
                             expected)};
}

}  // namespace

std::size_t token_start(const std::string& text, std::size_t taken) {
  if (taken == 0) return 0;
  std::size_t last = taken - 1;
  if (text[last] == '"') return string_start(text, last);
  if (!is_word(text[last])) return last;
  while (last > 0 && is_word(text[last - 1])) --last;
  return last;
}

std::size_t number_start(const std::string& text, std::size_t taken) {
  // The parser has looked one byte past the number, unless the text ended there.
  return token_start(text, taken > 1 && !is_word(text[taken - 1]) ? taken - 1 : taken);
}

Place PlaceCounter::at(std::size_t offset) {
  offset = std::min(offset, text_.size());
  if (offset < offset_) {
    offset_ = 0;
    place_ = {1, 1};
  }
  if (offset_ == 0 && offset >= 3 && text_.starts_with("\xEF\xBB\xBF")) offset_ = 3;  // byte order mark
  for (; offset_ < offset; ++offset_) {
    const auto byte = static_cast<unsigned char>(text_[offset_]);
    if (byte == '\n') {
      ++place_.line;
      place_.column = 1;
    } else if ((byte & 0xC0u) != 0x80u) {  // bytes 10xxxxxx continue a character of UTF-8
      ++place_.column;
    }
  }
  return place_;
}

Place place_of(const std::string& text, std::size_t offset) {
  return PlaceCounter(text).at(offset);
}

SyntaxError explain_syntax_error(const std::string& text, std::size_t byte, const std::string& words) {
  byte = std::min(byte, text.size());
  const std::size_t at = byte == 0 ? 0 : byte - 1;
  if (words.find("number overflow") != std::string::npos) {
    const std::size_t start = token_start(text, byte);
    return {start, fmt::format("{} is out of range: the largest number is 1.8e308",
                               text.substr(start, std::min<std::size_t>(byte - start, 40)))};
  }
  if (words.find("unexpected ") != std::string::npos) return unexpected_token(text, byte, words);
  if (words.find("invalid literal") != std::string::npos ||
      words.find("invalid number") != std::string::npos) {
    std::size_t start = at, end = at;
    while (start > 0 && is_word(text[start - 1])) --start;
    while (end < text.size() && is_word(text[end])) ++end;
    // One whole character, even where it takes several bytes.
    if (end == start) ++end;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) ++end;
    const std::string found = text.substr(start, std::min<std::size_t>(end - start, 40));
    return {start,
            fmt::format("'{}' is no JSON value: allowed are finite numbers, text in double quotes, true, "
                        "false, null, [lists] and {{objects}}",
                        found)};
  }
  if (words.find("missing closing '*/'") != std::string::npos)
    return {text.rfind("/*", at), "the comment is not closed by */"};
  if (words.find("U+000A") != std::string::npos) return {at, "the text is not closed by a quote on its line"};
  std::string_view reason = between(words, " - ");
  if (reason.empty()) reason = words;
  return {at, std::string(reason)};
}

}  // namespace talus
