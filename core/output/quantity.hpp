#pragma once

#include "simulation/simulation.hpp"

#include <span>
#include <string_view>

namespace talus {

/// Something a monitor can record of a body or of a point of it.
struct Quantity {
  const char* name;  ///< as in "quantities" of a monitor
  const char* unit;  ///< as it is written
  double (*value)(const Motion& motion, Vec2 origin);
  const char* sentence;
};

std::span<const Quantity> quantities();

/// nullptr if there is none of that name.
const Quantity* find_quantity(std::string_view name);

}  // namespace talus
