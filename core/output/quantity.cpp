#include "output/quantity.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace talus {

namespace {

constexpr std::array table{
    Quantity{"ux", "m", [](const Motion& motion, Vec2) { return motion.displacement.x; },
             "displacement along x since t = 0"},
    Quantity{"uy", "m", [](const Motion& motion, Vec2) { return motion.displacement.y; },
             "displacement along y since t = 0"},
    Quantity{
        "displacement", "m",
        [](const Motion& motion, Vec2) { return std::hypot(motion.displacement.x, motion.displacement.y); },
        "length of the displacement since t = 0"},
    Quantity{"vx", "m/s", [](const Motion& motion, Vec2) { return motion.velocity.x; }, "velocity along x"},
    Quantity{"vy", "m/s", [](const Motion& motion, Vec2) { return motion.velocity.y; }, "velocity along y"},
    Quantity{"speed", "m/s",
             [](const Motion& motion, Vec2) { return std::hypot(motion.velocity.x, motion.velocity.y); },
             "length of the velocity"},
    Quantity{"rotation", "deg",
             [](const Motion& motion, Vec2) { return motion.rotation * (180 / std::numbers::pi); },
             "rotation since t = 0, counter-clockwise"},
    Quantity{"x", "m", [](const Motion& motion, Vec2 origin) { return origin.x + motion.position.x; },
             "position, with the scene's origin"},
    Quantity{"y", "m", [](const Motion& motion, Vec2 origin) { return origin.y + motion.position.y; },
             "position, with the scene's origin"},
    Quantity{"stress_xx", "Pa", [](const Motion& motion, Vec2) { return motion.stress_xx; },
             "Cauchy stress: mean over the body, or of the element at `point`; 0 for rigid bodies"},
    Quantity{"stress_yy", "Pa", [](const Motion& motion, Vec2) { return motion.stress_yy; },
             "Cauchy stress: mean over the body, or of the element at `point`; 0 for rigid bodies"},
    Quantity{"stress_xy", "Pa", [](const Motion& motion, Vec2) { return motion.stress_xy; },
             "Cauchy stress: mean over the body, or of the element at `point`; 0 for rigid bodies"},
};

}  // namespace

std::span<const Quantity> quantities() {
  return table;
}

const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : table) {
    if (name == quantity.name) return &quantity;
  }
  return nullptr;
}

}  // namespace talus
