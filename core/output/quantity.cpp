#include "output/quantity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace talus {

namespace {

constexpr std::array table{
    Quantity{"ux", "m", [](const Sampled& s) { return s.motion.displacement.x; },
             "displacement along x since t = 0"},
    Quantity{"uy", "m", [](const Sampled& s) { return s.motion.displacement.y; },
             "displacement along y since t = 0"},
    Quantity{"displacement", "m",
             [](const Sampled& s) { return std::hypot(s.motion.displacement.x, s.motion.displacement.y); },
             "length of the displacement since t = 0"},
    Quantity{"vx", "m/s", [](const Sampled& s) { return s.motion.velocity.x; }, "velocity along x"},
    Quantity{"vy", "m/s", [](const Sampled& s) { return s.motion.velocity.y; }, "velocity along y"},
    Quantity{"speed", "m/s",
             [](const Sampled& s) { return std::hypot(s.motion.velocity.x, s.motion.velocity.y); },
             "length of the velocity"},
    Quantity{"rotation", "deg", [](const Sampled& s) { return s.motion.rotation * (180 / std::numbers::pi); },
             "rotation since t = 0, counter-clockwise: mean over the body, whatever `point`"},
    Quantity{"x", "m", [](const Sampled& s) { return s.origin.x + s.motion.position.x; },
             "position, with the scene's origin"},
    Quantity{"y", "m", [](const Sampled& s) { return s.origin.y + s.motion.position.y; },
             "position, with the scene's origin"},
    Quantity{
        "stress_xx", "Pa", [](const Sampled& s) { return s.motion.stress_xx; },
        "Cauchy stress: mean over the body as it was drawn, or of the element at `point`; 0 for rigid bodies",
        Quantity::Of::stress},
    Quantity{
        "stress_yy", "Pa", [](const Sampled& s) { return s.motion.stress_yy; },
        "Cauchy stress: mean over the body as it was drawn, or of the element at `point`; 0 for rigid bodies",
        Quantity::Of::stress},
    Quantity{
        "stress_xy", "Pa", [](const Sampled& s) { return s.motion.stress_xy; },
        "Cauchy stress: mean over the body as it was drawn, or of the element at `point`; 0 for rigid bodies",
        Quantity::Of::stress},
    Quantity{"contact_fx", "N/m", [](const Sampled& s) { return s.contact.force.x; },
             "force along x of all contacts on the body, e.g. the thrust on a fixed wall",
             Quantity::Of::contacts},
    Quantity{"contact_fy", "N/m", [](const Sampled& s) { return s.contact.force.y; },
             "force along y of all contacts on the body", Quantity::Of::contacts},
    Quantity{"contact_moment", "N", [](const Sampled& s) { return s.contact.moment; },
             "their moment about `point`, or about the centre of mass, counter-clockwise",
             Quantity::Of::contacts},
};

bool sees(const Monitor& monitor, Quantity::Of what) {
  return std::any_of(monitor.quantities.begin(), monitor.quantities.end(),
                     [what](const std::string& name) { return find_quantity(name)->of == what; });
}

}  // namespace

ContactSum contact_sum(std::span<const Contact> contacts, std::uint32_t body, Vec2 about) {
  ContactSum sum;
  for (const Contact& contact : contacts) {
    const double sign = (contact.body_b == body ? 1 : 0) - (contact.body_a == body ? 1 : 0);
    if (sign == 0) continue;
    const Vec2 &p = contact.normal_force, &t = contact.tangential_force;
    const Vec2 force{sign * (p.x + t.x), sign * (p.y + t.y)};
    sum.force = {sum.force.x + force.x, sum.force.y + force.y};
    sum.moment += sign * contact.moment + cross(minus(contact.point, about), force);
  }
  return sum;
}

std::span<const Quantity> quantities() {
  return table;
}

const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : table) {
    if (name == quantity.name) return &quantity;
  }
  return nullptr;
}

bool sees_contacts(const Monitor& monitor) {
  return sees(monitor, Quantity::Of::contacts);
}

bool sees_stress(const Monitor& monitor) {
  return sees(monitor, Quantity::Of::stress);
}

}  // namespace talus
