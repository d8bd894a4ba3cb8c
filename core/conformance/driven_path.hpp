#pragma once

#include "conformance/contact_setup.hpp"

#include <algorithm>
#include <cmath>

namespace talus::conformance {

/// Follows a path with the upper body and adds up what is put in and what is booked, J/m.
struct DrivenPath {
  DrivenLaw& law;
  double work = 0, lost_in_slip = 0, given_by_slip = 0, damped = 0, stored = 0, turned_over = 0, way = 0;
  double blurred = 0;  ///< J/m, what the trapezoids may be off where forces jump
  double dt;           ///< s
  Evaluation last;

  explicit DrivenPath(DrivenLaw& given, double step = 1e-4) : law(given), dt(step) {
    last = law.step(dt), stored = last.pairs[0].stored;
  }

  /// Further by d, in one step.
  void take(Vec2 d) {
    law.bodies[1].motion.velocity = d / dt;
    const Evaluation before = std::move(last);
    last = law.step(dt);
    const Vec2 from = before.on(1), to = last.on(1);
    const double part = -dot(from + to, d) / 2;
    work += part;
    blurred += std::abs(dot(to - from, d)) / 2;
    turned_over += std::abs(part);
    way += size_of(d);
    lost_in_slip += last.pairs[0].slip_loss;
    given_by_slip += std::max(0.0, -last.pairs[0].slip_loss);
    damped += dashpot_work(before.pairs[0], last.pairs[0]);
  }

  /// To u in straight steps.
  void go(Vec2 to, int steps = 400) {
    const Vec2 from = law.bodies[1].motion.u;
    for (int i = 0; i < steps; ++i) take((to - from) / steps);
  }

  double gain() const { return last.pairs[0].stored - stored; }
  double booked() const { return lost_in_slip + damped; }

 private:
  /// As the host books it: by the trapezoid rule, for at both ends of a step dashpots are moved by the same.
  static double dashpot_work(const PairReport& before, const PairReport& now) {
    double carried_on = 0;  // what they push with at the beginning times displacement since then
    if (before.contact_count > 0 && now.contact_count == 0) carried_on = before.damping_power;
    if (before.contact_count > 0 && now.contact_count > 0 && now.damping_force > 0)
      carried_on = before.damping_force * (now.damping_power / now.damping_force);
    return (now.damping_power + carried_on) / 2;
  }
};

}  // namespace talus::conformance
