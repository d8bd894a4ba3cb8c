#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace talus {

/// Of UTF-8 in bytes, by the first of them; 0 where that begins none.
inline std::size_t length_of_letter(unsigned char lead) {
  return lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
}

/// Well-formed UTF-8 without control characters: a name goes into JSON and onto a terminal.
inline bool printable(std::string_view name) {
  for (std::size_t i = 0; i < name.size();) {
    const auto lead = static_cast<unsigned char>(name[i]);
    const std::size_t length = length_of_letter(lead);
    if (lead < 0x20 || lead == 0x7F || lead > 0xF4 || length == 0 || i + length > name.size()) return false;
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(name[i + k]);
      // The second byte also rules out overlong forms, surrogates and what lies beyond Unicode.
      const unsigned low = k > 1 ? 0x80 : lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
      const unsigned high = k > 1 ? 0xBF : lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
      if (next < low || next > high) return false;
    }
    i += length;
  }
  return true;
}

/// The first bytes of UTF-8, at most so many, not ending within a character.
inline std::string_view beginning_of(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return text;
  while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0u) == 0x80u) --longest;
  return text.substr(0, longest);
}

/// Without the beginning of a letter of UTF-8 that was cut off at the end.
inline std::string_view without_cut_letter(std::string_view text) {
  for (std::size_t back = 1; back <= 3 && back <= text.size(); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if ((byte & 0xC0u) == 0x80u) continue;
    return length_of_letter(byte) > back ? text.substr(0, text.size() - back) : text;
  }
  return text;
}

/// A word of a file as it may be shown.
inline std::string shown(std::string_view word) {
  const std::string_view start = beginning_of(word, 40);
  return printable(start) ? fmt::format("'{}'", start) : "something that is no text";
}

/// Without the blanks around it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace talus
