#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace talus {

/// A finite number as people write it, .5 and +2 and 3. too, which JSON does not know.
inline std::optional<double> plain_number(std::string_view written) {
  if (written.starts_with('+') && !written.starts_with("+-")) written.remove_prefix(1);
  double number = 0;
  const char* const end = written.data() + written.size();
  const auto [read_to, error] = std::from_chars(written.data(), end, number);
  const bool good = error == std::errc() && read_to == end && std::isfinite(number);
  return good ? std::optional(number) : std::nullopt;
}

}  // namespace talus
