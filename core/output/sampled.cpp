#include "output/sampled.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace talus {

ContactSum contact_sum(std::span<const Contact> contacts, std::uint32_t body, Vec2 about) {
  ContactSum sum;
  for (const Contact& contact : contacts) {
    const double sign = (contact.body_b == body ? 1 : 0) - (contact.body_a == body ? 1 : 0);
    if (sign == 0) continue;
    const Vec2 &p = contact.normal_force, &t = contact.tangential_force;
    const Vec2 force = sign * (p + t);
    sum.force += force;
    sum.moment += sign * contact.moment + cross(contact.point - about, force);
  }
  return sum;
}

double value_of(Quantity::What what, const Sampled& s) {
  switch (what) {
    case Quantity::What::ux:
      return s.motion.displacement.x;
    case Quantity::What::uy:
      return s.motion.displacement.y;
    case Quantity::What::displacement:
      return std::hypot(s.motion.displacement.x, s.motion.displacement.y);
    case Quantity::What::vx:
      return s.motion.velocity.x;
    case Quantity::What::vy:
      return s.motion.velocity.y;
    case Quantity::What::speed:
      return std::hypot(s.motion.velocity.x, s.motion.velocity.y);
    case Quantity::What::rotation:
      return s.motion.rotation * (180 / std::numbers::pi);
    case Quantity::What::x:
      return s.origin.x + s.motion.position.x;
    case Quantity::What::y:
      return s.origin.y + s.motion.position.y;
    case Quantity::What::stress_xx:
      return s.motion.stress_xx;
    case Quantity::What::stress_yy:
      return s.motion.stress_yy;
    case Quantity::What::stress_xy:
      return s.motion.stress_xy;
    case Quantity::What::contact_fx:
      return s.contact.force.x;
    case Quantity::What::contact_fy:
      return s.contact.force.y;
    case Quantity::What::contact_moment:
      return s.contact.moment;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace talus
