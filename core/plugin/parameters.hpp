#pragma once

#include <talus/parameter.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace talus {

/// Where a component declares the parameter of this key.
inline std::optional<std::size_t> index_of(std::span<const Parameter> parameters, std::string_view key) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (key == parameters[i].key) return i;
  }
  return std::nullopt;
}

}  // namespace talus
