#pragma once

#include <talus/library.hpp>

#include <optional>
#include <span>
#include <string_view>

namespace talus {

/// Where a table holds the key.
inline std::optional<std::size_t> position_of(std::span<const Parameter> parameters, std::string_view key) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].key == key) return i;
  }
  return std::nullopt;
}

}  // namespace talus
