#include "simulation/simulation.hpp"

#include "files/hash.hpp"
#include "model/distinct_points.hpp"
#include "model/fragments.hpp"
#include "parallel/subnormals.hpp"
#include "scene/quantity.hpp"
#include "simulation/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace talus {
namespace {

Motion with_stress(Motion motion, const std::array<double, 3>& stress) {
  motion.stress_xx = stress[0];
  motion.stress_yy = stress[1];
  motion.stress_xy = stress[2];
  return motion;
}

}  // namespace

Simulation::Simulation(Scene scene, const RunSettings& settings)
    : state_(std::make_unique<State>(std::move(scene), settings)) {
  state_->refuse_uncountable_steps();
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

const Scene& Simulation::scene() const {
  return state_->as_given ? *state_->as_given : state_->scene;
}

bool Simulation::settle(const Pause& pause) {
  const NoSubnormals in_steps;
  State& s = *state_;
  if (!s.scene.settle || s.settle_over || s.started) return true;
  if (!s.settling) {
    s.settling = true;
    s.begin(s.scene.settle->duration);
  }
  while (s.time < s.scene.settle->duration && !s.settled()) {
    s.step(s.scene.settle->duration);
    if (pause && pause()) return false;
  }
  if (s.scene.settle->until && !s.settled()) {
    s.summary.warnings.push_back(fmt::format(
        "settling ended with its duration, {:.6g} s, at an unbalanced share of {:.3g}, not below {:.3g} as "
        "/settle/until asks: what is out of balance is let go from rest at t = 0",
        s.scene.settle->duration, s.unbalanced_share, *s.scene.settle->until));
  }
  s.warn_of_settlement();
  s.warn_of_unbalanced_settling();
  s.settling = false;
  s.settle_over = true;
  s.summary.largest_penetration = 0;  // of the run, not of the stage before
  s.motion.stop();
  s.relaxation.forget();
  s.time = 0;
  s.ledger.reset();
  return true;
}

bool Simulation::advance(const Pause& pause) {
  const NoSubnormals in_steps;
  State& s = *state_;
  const double interval = s.scene.output.history, end = s.scene.time.end;
  const auto output_time = [&](std::uint64_t number) {
    const double time = static_cast<double>(number) * interval;
    return time < end * (1 - 1e-12) ? time : end;
  };
  if (!s.started) {
    s.started = true;
    s.set_initial_velocities();
    if (s.scene.settle) {
      s.summary.dt = 0;  // of the run, not of the stage before
    }
    s.since_start.begin(s.model, s.motion);
    s.begin(output_time(1));
    s.warn_of_large_step();
    s.warn_of_initial_overlap();
    s.check_balance();
    return true;
  }
  if (s.time >= end) return false;
  const double target = output_time(s.output + 1);
  while (s.time < target) {
    s.watched = pause && pause();
    s.step(output_time(s.output + 2));
    if (s.watched && s.time < target) return true;
  }
  s.watched = false;
  ++s.output;
  s.since_start.follow(s.model, s.motion);
  s.check_balance();
  return true;
}

bool Simulation::look_now() {
  state_->since_start.follow(state_->model, state_->motion);
  return state_->to_be_seen;
}

double Simulation::time() const {
  return state_->time;
}
double Simulation::critical_dt() const {
  return state_->votes.anyhow().dt;
}
double Simulation::last_dt() const {
  return state_->dt_behind;
}
CriticalStep Simulation::present_bound() const {
  return state_->with_numbers_outside(state_->critical);
}
CriticalStep Simulation::bound_of_stage(std::size_t stage) {
  State& s = *state_;
  const StageSettings& settings = s.scene.stages[stage].settings;
  s.contacts.set_interfaces(settings.interface_values);
  const StepVote votes(s.scene, settings, s.model, s.contacts);
  s.contacts.set_interfaces(s.stage.interface_values);
  return s.with_numbers_outside(
      votes.among(s.contacts.lightest_neighbours(), s.contacts.heaviest_neighbours()));
}
double Simulation::body_width(std::size_t body) const {
  return state_->model.bodies[state_->numbering.inside(body)].width;
}
double Simulation::automatic_dt() const {
  return automatic_step(state_->votes.anyhow(), state_->scene.time.safety);
}
std::string Simulation::automatic_limiter() const {
  return limiter_of_automatic(state_->scene, state_->votes.anyhow());
}
const EnergyLedger& Simulation::ledger() const {
  return state_->ledger.ledger();
}
RunSummary Simulation::summary() const {
  const State& s = *state_;
  RunSummary summary = s.summary;
  summary.dt_limiter = s.limiter();
  summary.pair_searches = s.contacts.searches();
  summary.profile = s.profile;
  if (s.sleep) summary.sleep = s.sleep->report(s.time);
  summary.largest_residual_share = std::max(summary.largest_residual_share, s.ledger.residual_share());
  if (summary.largest_penetration > 0) {
    summary.largest_penetration_pair = fmt::format("'{}' and '{}'", s.scene.bodies[s.deepest_pair.first].name,
                                                   s.scene.bodies[s.deepest_pair.second].name);
  }
  return summary;
}
std::size_t Simulation::body_count() const {
  return state_->model.bodies.size();
}

bool Simulation::started() const {
  return state_->started;
}

/// A step was watched to be looked at between two output times.
bool Simulation::history_due() const {
  return state_->started && !state_->watched;
}

bool Simulation::frame_due() const {
  if (!state_->scene.output.frames || !history_due()) return false;
  const auto every =
      static_cast<std::uint64_t>(std::llround(*state_->scene.output.frames / state_->scene.output.history));
  return state_->output % every == 0 || state_->time >= state_->scene.time.end;
}

std::size_t Simulation::block_count() const {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < state_->model.bodies.size(); ++i) count += state_->model.moves(i) ? 1 : 0;
  return count;
}

std::string Simulation::state_hash() const {
  std::vector<double> state;
  for (std::size_t i = 0; i < state_->motion.bodies.size(); ++i) {
    const std::uint32_t index = state_->numbering.inside(i);
    if (state_->model.covered(index)) continue;
    const BodyMotion& body = state_->motion.bodies[index];
    state.insert(state.end(),
                 {body.u.x, body.u.y, body.h.xx, body.h.xy, body.h.yx, body.h.yy, body.velocity.x,
                  body.velocity.y, body.rate.xx, body.rate.xy, body.rate.yx, body.rate.yy, body.spin});
  }
  for (std::size_t p = 0; p < state_->motion.patch_displacement.size(); ++p) {
    const Vec2 d = state_->motion.patch_displacement[p], v = state_->motion.patch_velocity[p];
    state.insert(state.end(), {d.x, d.y, v.x, v.y});
  }
  const std::span<const BodyPair> pairs = state_->contacts.pairs();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const BodyPair& pair = pairs[i];
    if (pair.contact_count == 0) continue;
    state.insert(state.end(), {static_cast<double>(pair.a), static_cast<double>(pair.b)});
    const auto history = state_->contacts.history_of(i);
    state.insert(state.end(), history.begin(), history.end());
  }
  return hash_of_bytes({reinterpret_cast<const char*>(state.data()), state.size() * sizeof(double)});
}

Motion Simulation::body_motion(std::size_t body) const {
  const State& s = *state_;
  const std::uint32_t index = s.numbering.inside(body);
  return with_stress(s.motion_of(index), s.deformation.cauchy(s.model, s.motion, index));
}

Motion Simulation::point_motion(std::size_t body, Vec2 point_at_start) const {
  const State& s = *state_;
  const std::uint32_t index = s.numbering.inside(body), element = s.element_at(index, point_at_start);
  return with_stress(s.motion_of(index, element, point_at_start), s.stress_of(index, element));
}

Motion Simulation::monitor_motion(std::size_t number) const {
  const State& s = *state_;
  const Monitor& monitor = s.scene.monitors[number];
  const bool stressed = sees_stress(monitor);
  if (!monitor.point) {
    const Motion motion = s.motion_of(monitor.body);
    return stressed ? with_stress(motion, s.deformation.cauchy(s.model, s.motion, monitor.body)) : motion;
  }
  const std::uint32_t element = s.monitored_elements[number];
  const Motion motion = s.motion_of(monitor.body, element, *monitor.point);
  return stressed ? with_stress(motion, s.stress_of(monitor.body, element)) : motion;
}

std::vector<BodyPart> Simulation::parts(std::size_t body) const {
  const State& s = *state_;
  const std::uint32_t index = s.numbering.inside(body);
  const Body& b = s.model.bodies[index];
  std::vector<BodyPart> parts;
  if (!s.model.covered(index)) {
    BodyPart& whole = parts.emplace_back(BodyPart{{}, s.deformation.cauchy(s.model, s.motion, index)});
    each_loop(s.scene.bodies[index], [&](const Loop& loop) {
      std::vector<PartPoint>& points = whole.loops.emplace_back();
      for (const Vec2 vertex : loop.vertices) {
        points.push_back(s.point({index, vertex - b.centre, {}}, vertex));
      }
    });
    return parts;
  }
  parts.reserve(b.element_end - b.element_begin);
  for (std::uint32_t i = b.element_begin; i < b.element_end; ++i) {
    const std::uint32_t element = s.model.body_element[i];
    BodyPart& part =
        parts.emplace_back(BodyPart{{}, s.deformation.cauchy_of_element(s.model, s.motion, element)});
    for (const Ring& ring : s.model.element_region[element]) {
      std::vector<PartPoint>& points = part.loops.emplace_back();
      points.reserve(ring.size());
      for (const Vec2 at : ring) {
        points.push_back(s.point({index, at, s.model.carrier(s.model.elements[element], at)}, b.centre + at));
      }
    }
  }
  return parts;
}

std::vector<std::uint32_t> Simulation::distinct_points(std::size_t body) const {
  const std::uint32_t index = state_->numbering.inside(body);
  if (!state_->model.covered(index)) return {};
  return talus::distinct_points(state_->model, index);
}

std::vector<std::uint32_t> Simulation::fragments(std::size_t body) const {
  const std::uint32_t index = state_->numbering.inside(body);
  if (!state_->model.covered(index)) return {0};
  return fragments_of(state_->model, index);
}

double Simulation::inertia_share(std::size_t body) const {
  const State& s = *state_;
  const std::uint32_t inside = s.numbering.inside(static_cast<std::uint32_t>(body));
  if (!s.model.covered(inside)) return 1;
  const Body& laid = s.model.bodies[inside];
  const CoverRanges& ranges = s.model.ranges(laid);
  std::vector<Vec2> spin;
  for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p)
    spin.push_back({-s.model.patch_star[p].y, s.model.patch_star[p].x});
  return s.mass.product(s.model, inside, spin, spin) / laid.inertia();
}

std::vector<SliverEffect> Simulation::slivers() const {
  std::vector<SliverEffect> effects = sliver_effects(state_->scene, state_->model);
  for (SliverEffect& effect : effects) effect.body = state_->numbering.outside(effect.body);
  std::sort(effects.begin(), effects.end(),
            [](const SliverEffect& a, const SliverEffect& b) { return a.body < b.body; });
  return effects;
}

std::size_t Simulation::patch_count() const {
  const State& s = *state_;
  std::size_t count = s.model.patch_star.size();
  for (const Body& body : s.model.bodies) count += body.kinematics == Kinematics::affine ? 3 : 0;
  return count;
}

std::size_t Simulation::element_count() const {
  return state_->model.element_body.size();
}

std::size_t Simulation::pair_count() const {
  return state_->contacts.pairs().size();
}

std::size_t Simulation::touching_pair_count() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      state_->contacts.pairs(), [](const BodyPair& pair) { return pair.contact_count > 0; }));
}

DeepestOverlap Simulation::deepest_overlap() const {
  const ContactTotals& totals = state_->contact_totals;
  const std::uint32_t a = state_->numbering.outside(totals.deepest_a),
                      b = state_->numbering.outside(totals.deepest_b);
  return {std::min(a, b), std::max(a, b), totals.penetration};
}

std::vector<Contact> Simulation::contacts() const {
  std::vector<Contact> result;
  const State& s = *state_;
  for (std::size_t i = 0; i < s.contacts.pairs().size(); ++i) {
    const BodyPair& pair = s.contacts.pairs()[i];
    const Vec2 frame = s.model.bodies[pair.a].centre;
    const std::uint32_t a = s.numbering.outside(pair.a), b = s.numbering.outside(pair.b);
    const double sign = a <= b ? 1 : -1;
    for (const ContactReport& r : s.contacts.reports_of(i)) {
      result.push_back({std::min(a, b),
                        std::max(a, b),
                        {frame.x + r.x, frame.y + r.y},
                        {sign * r.px, sign * r.py},
                        {sign * r.tx, sign * r.ty},
                        r.penetration,
                        r.slipping != 0,
                        sign * r.moment});
    }
  }
  if (!s.numbering.outer.empty()) {
    std::stable_sort(result.begin(), result.end(), [](const Contact& p, const Contact& q) {
      return std::pair{p.body_a, p.body_b} < std::pair{q.body_a, q.body_b};
    });
  }
  return result;
}

}  // namespace talus
