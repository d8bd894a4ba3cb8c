#pragma once

#include "simulation/simulation.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace talus {

/// The contacts of a body together, per metre of thickness.
struct ContactSum {
  Vec2 force;         ///< N/m
  double moment = 0;  ///< N, about the point that is looked at, counter-clockwise
};

/// Of those of a step, `about` without the scene's origin. What a body does to itself cancels.
ContactSum contact_sum(std::span<const Contact> contacts, std::uint32_t body, Vec2 about);

/// A body or a point of it at t_n.
struct Sampled {
  Motion motion;
  Vec2 origin;           ///< m, the scene's
  ContactSum contact{};  ///< where a quantity is of contacts
};

/// Something a monitor can record of a body or of a point of it.
struct Quantity {
  const char* name;  ///< as in "quantities" of a monitor
  const char* unit;  ///< as it is written
  double (*value)(const Sampled& sampled);
  const char* sentence;
  enum class Of { motion, stress, contacts } of = Of::motion;
};

std::span<const Quantity> quantities();

/// nullptr if there is none of that name.
const Quantity* find_quantity(std::string_view name);

/// Whether it records a quantity of contacts, of stress.
bool sees_contacts(const Monitor& monitor);
bool sees_stress(const Monitor& monitor);

}  // namespace talus
