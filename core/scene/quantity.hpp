#pragma once

#include "scene/scene.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace talus {

/// Something a monitor can record of a body or of a point of it.
struct Quantity {
  enum class What : std::uint8_t {
    ux,
    uy,
    displacement,
    vx,
    vy,
    speed,
    rotation,
    x,
    y,
    stress_xx,
    stress_yy,
    stress_xy,
    contact_fx,
    contact_fy,
    contact_moment
  };
  enum class Of : std::uint8_t { motion, stress, contacts };

  What what;
  const char* name;  ///< as in "quantities" of a monitor
  const char* unit;  ///< as it is written
  const char* sentence;
  Of of = Of::motion;
};

std::span<const Quantity> quantities();

/// nullptr if there is none of that name.
const Quantity* find_quantity(std::string_view name);

/// Whether it records a quantity of contacts, of stress.
bool sees_contacts(const Monitor& monitor);
bool sees_stress(const Monitor& monitor);

}  // namespace talus
