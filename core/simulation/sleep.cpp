#include "simulation/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace talus {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Share of the time that bodies have to be at rest: so long a fast one is not looked at again, and so often
/// islands are sought.
constexpr double look_share = 0.125;
constexpr std::size_t watch_chunk = 256;  ///< bodies

double squared_speed(const Model& model, const Body& body, Vec2 velocity, const Matrix2& rate) {
  double largest = 0;
  for (std::uint32_t c = body.corner_begin; c < body.corner_end; ++c) {
    const double x = model.reference_x[c], y = model.reference_y[c];
    const double vx = velocity.x + rate.xx * x + rate.xy * y, vy = velocity.y + rate.yx * x + rate.yy * y;
    largest = std::max(largest, vx * vx + vy * vy);
  }
  return largest;
}

Matrix2 rate_of(const Body& body, const BodyMotion& motion) {
  return body.kinematics == Kinematics::rigid ? spin_rate(motion) : motion.rate;
}

}  // namespace

Sleep::Sleep(const SleepSettings& settings, const Model& model, const StageSettings& stage)
    : settings_(settings),
      quiet_since_(model.bodies.size(), 0.0),
      island_(model.bodies.size(), 0),
      parent_(model.bodies.size()) {
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.moves(b) || model.covered(b)) quiet_since_[b] = never;
  }
  exempt(stage);
}

/// What changes with time acts on bodies that are awake.
void Sleep::exempt(const StageSettings& stage) {
  awake_until_.assign(quiet_since_.size(), 0.0);
  const auto until = [&](std::uint32_t body, double time) {
    awake_until_[body] = std::max(awake_until_[body], time);
  };
  for (std::uint32_t b = 0; b < stage.supports.size(); ++b) {
    if (stage.supports[b].drives()) until(b, never);
  }
  for (const PointLoad& load : stage.loads) {
    if (varies_in_time(load.force)) until(load.body, never);
  }
  for (const SurfaceLoad& load : stage.surface_loads) {
    if (varies_in_time(load.traction) || load.pressure.varies_in_time()) until(load.body, never);
  }
  for (const PrescribedSurface& prescribed : stage.prescribed) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (prescribed.holds(axis)) until(prescribed.body, prescribed.past[axis].since + prescribed.ramp);
      const bool varies = prescribed.displacement[axis] && prescribed.displacement[axis]->varies_in_time();
      const bool moves = prescribed.velocity[axis] && !prescribed.velocity[axis]->zero();
      if (varies || moves) until(prescribed.body, never);
    }
  }
}

void Sleep::begin_stage(const StageSettings& stage, double time, Parts parts) {
  std::vector<std::uint32_t> all;
  for (const Island& island : islands_) all.push_back(island.number);
  wake(all, time, parts);
  exempt(stage);
  calm_since_ = time;
}

void Sleep::watch(double time, Vec2 gravity, Workers& workers, Parts parts) {
  if (gravity.x != gravity_.x || gravity.y != gravity_.y) {
    std::vector<std::uint32_t> all;
    for (const Island& island : islands_) all.push_back(island.number);
    wake(all, time, parts);
    gravity_ = gravity;
    calm_since_ = time;
  }
  const double limit = settings_.speed * settings_.speed, pause = look_share * settings_.after;
  const auto fast = [&](const Body& body) {
    bool any = false;
    parts.model.visit_boundary(body, [&](std::uint32_t c) {
      const BoundaryCorner& corner = parts.motion.corners[c];
      any = any || !(corner.vx * corner.vx + corner.vy * corner.vy < limit);
    });
    return any;
  };
  workers.over(quiet_since_.size(), watch_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      if (time < quiet_since_[b] || island_[b] != 0) continue;
      if (fast(parts.model.bodies[b])) quiet_since_[b] = time + pause;
    }
  });
}

std::uint32_t Sleep::root(std::uint32_t body) {
  while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
  return body;
}

void Sleep::choose(double time, Parts parts) {
  next_look_ = time + look_share * settings_.after;
  chosen_.clear();
  before_.clear();
  const double since = time - settings_.after;
  const auto rests = [&](std::size_t b) {
    return quiet_since_[b] <= since && awake_until_[b] <= since && island_[b] == 0;
  };
  bool any = false;
  for (std::size_t b = 0; b < quiet_since_.size() && !any; ++b) any = rests(b);
  if (!any || calm_since_ > since) return;

  std::iota(parent_.begin(), parent_.end(), 0);
  for (const BodyPair& pair : parts.contacts.pairs()) {
    if (pair.contact_count == 0 || !parts.model.moves(pair.a) || !parts.model.moves(pair.b)) continue;
    const std::uint32_t a = root(pair.a), b = root(pair.b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<char> restless(parent_.size(), 0);  // [root]
  for (std::uint32_t b = 0; b < parent_.size(); ++b) {
    if (!rests(b)) restless[root(b)] = 1;
  }
  for (std::uint32_t b = 0; b < parent_.size(); ++b) {
    if (restless[root(b)] != 0) continue;
    chosen_.push_back(b);
    before_.push_back(parts.motion.bodies[b]);
  }
}

Sleep::Taken Sleep::put_to_sleep(double time, const StepConditions& conditions, Parts parts) {
  if (chosen_.empty()) return {};
  const std::vector<Pace> pace = paces((conditions.dt_behind + conditions.dt_ahead) / 2, parts);
  Taken taken;
  std::vector<std::uint32_t> entry(parent_.size(), 0);  // [root] 1 + that of islands_
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const std::uint32_t of = root(chosen_[i]);
    const auto [speed, acceleration] = pace[of];
    if (!(speed < settings_.speed && acceleration <= settings_.acceleration)) continue;
    if (entry[of] == 0) {
      islands_.push_back({++last_number_, time, speed, acceleration});
      entry[of] = static_cast<std::uint32_t>(islands_.size());
      ++past_.islands;
    }
    lay_down(i, islands_[entry[of] - 1], conditions, parts, taken);
  }
  if (islands_.empty() || islands_.back().since != time) return taken;
  past_.kinetic_energy += taken.kinetic;
  take_contact_energy(time, parts);
  add_up();
  tell(parts);
  return taken;
}

std::vector<Sleep::Pace> Sleep::paces(double dt, Parts parts) {
  std::vector<Pace> pace(parent_.size());
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const Body& body = parts.model.bodies[chosen_[i]];
    const BodyMotion &before = before_[i], &after = parts.motion.bodies[chosen_[i]];
    const Matrix2 p = rate_of(body, before), q = rate_of(body, after);
    const double fastest = std::sqrt(squared_speed(parts.model, body, after.velocity, q));
    const double change = std::sqrt(squared_speed(parts.model, body, after.velocity - before.velocity,
                                                  {q.xx - p.xx, q.xy - p.xy, q.yx - p.yx, q.yy - p.yy}));
    Pace& island = pace[root(chosen_[i])];
    island.speed = std::max(island.speed, fastest);
    island.acceleration = std::max(island.acceleration, change / dt);
  }
  return pace;
}

void Sleep::lay_down(std::size_t chosen, Island& island, const StepConditions& conditions, Parts parts,
                     Taken& taken) {
  const std::uint32_t b = chosen_[chosen];
  const Body& body = parts.model.bodies[b];
  const BodyMotion& before = before_[chosen];
  BodyMotion& now = parts.motion.bodies[b];
  BodyMotion middle = now;
  middle.velocity = (before.velocity + now.velocity) / 2;
  middle.spin = (before.spin + now.spin) / 2;
  middle.rate = {(before.rate.xx + now.rate.xx) / 2, (before.rate.xy + now.rate.xy) / 2,
                 (before.rate.yx + now.rate.yx) / 2, (before.rate.yy + now.rate.yy) / 2};
  taken.kinetic += kinetic_energy(body, before, now);
  taken.damping_loss_ahead += conditions.damping * kinetic_energy(body, middle, now) * conditions.dt_ahead;
  island.strain_energy += parts.deformation.stored_in(parts.model, b);
  ++island.bodies;
  island_[b] = island.number;
  now.velocity = {};
  now.rate = {};
  now.spin = 0;
  parts.motion.leave_velocity(b, {});
  for (std::uint32_t c = body.corner_begin; c < body.corner_end; ++c)
    parts.motion.corners[c].vx = parts.motion.corners[c].vy = 0;
}

void Sleep::take_contact_energy(double time, Parts parts) {
  for (std::size_t i = 0; i < parts.contacts.pairs().size(); ++i) {
    const BodyPair& pair = parts.contacts.pairs()[i];
    const std::uint32_t number = std::max(island_[pair.a], island_[pair.b]);
    // Islands that sleep already have theirs; the new ones come last.
    if (number == 0 || pair.contact_count == 0) continue;
    Island& island = *std::lower_bound(islands_.begin(), islands_.end(), number,
                                       [](const Island& p, std::uint32_t n) { return p.number < n; });
    if (island.since == time) island.contact_energy += parts.contacts.stored_in(i);
  }
}

void Sleep::wake(std::span<const std::uint32_t> numbers, double time, Parts parts) {
  if (numbers.empty()) return;
  const auto wakes = [&](std::uint32_t number) {
    return std::binary_search(numbers.begin(), numbers.end(), number);
  };
  std::erase_if(islands_, [&](const Island& island) {
    if (!wakes(island.number)) return false;
    enter(island, time, past_);
    ++past_.woken;
    return true;
  });
  for (std::size_t b = 0; b < island_.size(); ++b) {
    if (island_[b] == 0 || !wakes(island_[b])) continue;
    island_[b] = 0;
    quiet_since_[b] = time;
  }
  add_up();
  tell(parts);
}

/// If nothing had made the acceleration grow.
void Sleep::enter(const Island& island, double time, SleepReport& report) const {
  const double asleep = time - island.since;
  report.longest = std::max(report.longest, asleep);
  report.body_time += static_cast<double>(island.bodies) * asleep;
  report.speed = std::max(report.speed, island.speed);
  report.acceleration = std::max(report.acceleration, island.acceleration);
  report.velocity_bound = std::max(report.velocity_bound, island.speed + island.acceleration * asleep);
  report.displacement_bound =
      std::max(report.displacement_bound, (island.speed + island.acceleration * asleep / 2) * asleep);
}

SleepReport Sleep::report(double time) const {
  SleepReport report = past_;
  for (const Island& island : islands_) {
    enter(island, time, report);
    report.bodies_asleep += island.bodies;
  }
  return report;
}

void Sleep::add_up() {
  contact_energy_ = strain_energy_ = 0;
  for (const Island& island : islands_) {
    contact_energy_ += island.contact_energy;
    strain_energy_ += island.strain_energy;
  }
}

void Sleep::exchange(Archive& archive, Parts parts) {
  archive.of_known_size(quiet_since_);
  archive.of_known_size(awake_until_);
  archive.of_known_size(island_);
  archive(islands_);
  archive(last_number_);
  archive(next_look_);
  archive(calm_since_);
  archive(gravity_);
  archive(past_);
  if (!archive.reading()) return;
  add_up();
  tell(parts);
}

void Sleep::tell(Parts parts) {
  const std::span<const std::uint32_t> sleeping =
      islands_.empty() ? std::span<const std::uint32_t>{} : std::span<const std::uint32_t>(island_);
  parts.blocks.set_asleep(sleeping);
  parts.contacts.set_asleep(sleeping);
  parts.deformation.set_asleep(parts.model, sleeping);
}

}  // namespace talus
