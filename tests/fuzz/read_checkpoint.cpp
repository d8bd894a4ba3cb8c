#include "targets.hpp"

#include "archive/archive.hpp"
#include "checkpoint/checkpoint.hpp"
#include "files/hash.hpp"
#include "files/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace talus::fuzz {

namespace {

void take(std::string_view bytes) {
  try {
    Archive archive(talus::read_checkpoint_text(bytes, "checkpoint.talus").state);
  } catch (const InputError&) {
  }
}

/// Bytes as members of all kinds, in turn.
void take_out(std::string_view bytes) {
  Archive archive(bytes);
  try {
    while (!archive.at_end()) {
      std::uint8_t kind = 0;
      archive(kind);
      double number = 0;
      std::string text;
      std::vector<double> numbers(3);
      std::vector<std::string> texts;
      std::vector<std::vector<std::uint32_t>> lists;
      switch (kind % 6) {
        case 0:
          archive(number);
          break;
        case 1:
          archive(text);
          break;
        case 2:
          archive(numbers);
          break;
        case 3:
          archive(texts);
          break;
        case 4:
          archive(lists);
          break;
        default:
          archive.of_known_size(numbers);
      }
    }
  } catch (const InputError&) {
  }
}

/// As if this program had written it: states of others are refused at once.
std::string with_this_writer(std::string_view header_on) {
  const std::size_t end = header_on.find("\",");
  if (!header_on.starts_with("{\"written_by\":\"") || end == std::string_view::npos)
    return std::string(header_on);
  return fmt::format("{{\"written_by\":\"{}{}", checkpoint_writer(), header_on.substr(end));
}

}  // namespace

/// As they are, where length and hash refuse nearly all; with both and the writer put right; and as a state.
void read_checkpoint(std::string_view bytes) {
  take(bytes);
  constexpr std::string_view first_line = "talus checkpoint 1\n";
  std::string_view rest = bytes;
  if (rest.starts_with(first_line)) {
    rest.remove_prefix(first_line.size());
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  }
  constexpr std::size_t hash_digits = 32;
  rest = rest.substr(0, rest.size() - std::min(rest.size(), hash_digits));
  const std::string own = with_this_writer(rest);
  std::string right(first_line);
  right += fmt::format("{}\n{}", own.size() + hash_digits, own);
  right += hash_of_bytes(right);
  take(right);
  take_out(rest.substr(std::min(rest.find('\n'), rest.size())));
}

}  // namespace talus::fuzz
