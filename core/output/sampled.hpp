#pragma once

#include "scene/quantity.hpp"
#include "simulation/simulation.hpp"

#include <cstdint>
#include <span>

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

/// In the unit of the quantity.
double value_of(Quantity::What what, const Sampled& sampled);

}  // namespace talus
