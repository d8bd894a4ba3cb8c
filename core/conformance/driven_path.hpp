#pragma once

#include "conformance/contact_setup.hpp"

#include <cmath>

namespace talus::conformance {

/// Follows a path with the upper body and adds up what is put in and what is booked, J/m.
struct DrivenPath {
  DrivenLaw& law;
  double work = 0, booked = 0, stored = 0, turned_over = 0, way = 0;
  double blurred = 0;  ///< J/m, what the trapezoids may be off where forces jump
  double dt;           ///< s
  Evaluation last;

  explicit DrivenPath(DrivenLaw& given, double step = 1e-4) : law(given), dt(step) {
    last = law.step(dt), stored = last.pairs[0].stored;
  }

  /// To u in straight steps.
  void go(Vec2 to, int steps = 400) {
    HeldBody& body = law.bodies[1];
    const Vec2 from = body.motion.u;
    for (int i = 0; i < steps; ++i) {
      const Vec2 d{(to.x - from.x) / steps, (to.y - from.y) / steps};
      body.motion.velocity = {d.x / dt, d.y / dt};
      const Vec2 before = last.on(1);
      last = law.step(dt);
      const Vec2 now = last.on(1);
      const double part = -dot({before.x + now.x, before.y + now.y}, d) / 2;
      work += part;
      blurred += std::abs(dot({now.x - before.x, now.y - before.y}, d)) / 2;
      turned_over += std::abs(part);
      way += size_of(d);
      booked += last.pairs[0].slip_loss + last.pairs[0].damping_power;
    }
  }

  double gain() const { return last.pairs[0].stored - stored; }
};

}  // namespace talus::conformance
