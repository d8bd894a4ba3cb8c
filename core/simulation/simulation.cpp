#include "simulation/simulation.hpp"

#include "output/hash.hpp"
#include "simulation/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {
Simulation::Simulation(const Scene& scene, const RunSettings& settings)
    : state_(std::make_unique<State>(scene, settings)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

const Scene& Simulation::scene() const {
  return state_->scene;
}

void Simulation::take_geometry(const Geometry& geometry) {
  const double* from = geometry.unknowns.data();
  for (std::size_t i = 0; i < state_->motion.bodies.size(); ++i, from += 6) {
    BodyMotion& body = state_->motion.bodies[i];
    body.u = {from[0], from[1]};
    body.h = {from[2], from[3], from[4], from[5]};
    if (state_->model.bodies[i].kinematics == Kinematics::rigid) body.h = rotation_of(body.h);
  }
}

Geometry Simulation::geometry() const {
  Geometry geometry;
  for (const BodyMotion& body : state_->motion.bodies) {
    for (const double value : {body.u.x, body.u.y, body.h.xx, body.h.xy, body.h.yx, body.h.yy}) {
      geometry.unknowns.push_back(value);
    }
  }
  return geometry;
}

void Simulation::settle(const std::atomic<bool>* interrupted) {
  State& s = *state_;
  if (!s.scene.settle) return;
  s.settling = true;
  s.begin(s.scene.settle->duration);
  while (s.time < s.scene.settle->duration) {
    s.step(s.scene.settle->duration);
    if (interrupted != nullptr && *interrupted) break;
  }
  s.settling = false;
  for (BodyMotion& body : s.motion.bodies) body.velocity = {}, body.rate = {}, body.spin = 0;
  s.time = 0;
  s.ledger.reset();
}

bool Simulation::advance(const std::atomic<bool>* interrupted) {
  State& s = *state_;
  const double interval = s.scene.output.history, end = s.scene.time.end;
  const auto output_time = [&](std::uint64_t number) {
    const double time = static_cast<double>(number) * interval;
    return time < end * (1 - 1e-12) ? time : end;
  };
  if (!s.started) {
    s.started = true;
    s.set_initial_velocities();
    s.start = s.motion.bodies;
    for (std::size_t i = 0; i < s.last_turn.size(); ++i) s.last_turn[i] = s.motion.bodies[i].h;
    s.begin(output_time(1));
    s.warn_of_large_step();
    s.warn_of_initial_overlap();
    s.check_balance();
    return true;
  }
  if (s.time >= end) return false;
  const double target = output_time(s.output + 1);
  while (s.time < target) {
    s.step(output_time(s.output + 2));
    if (interrupted != nullptr && *interrupted) break;
  }
  if (s.time == target) ++s.output;
  s.bring_rotation_up_to_date();
  s.check_balance();
  return true;
}

double Simulation::time() const {
  return state_->time;
}
double Simulation::critical_dt() const {
  return state_->critical.dt;
}
const EnergyLedger& Simulation::ledger() const {
  return state_->ledger.ledger();
}
RunSummary Simulation::summary() const {
  const State& s = *state_;
  RunSummary summary = s.summary;
  summary.pair_searches = s.contacts.searches();
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

bool Simulation::history_due() const {
  return true;
}

bool Simulation::frame_due() const {
  if (!state_->scene.output.frames) return false;
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
  for (const BodyMotion& body : state_->motion.bodies) {
    state.insert(state.end(),
                 {body.u.x, body.u.y, body.h.xx, body.h.xy, body.h.yx, body.h.yy, body.velocity.x,
                  body.velocity.y, body.rate.xx, body.rate.xy, body.rate.yx, body.rate.yy, body.spin});
  }
  const std::uint32_t doubles =
      state_->contacts.law() != nullptr ? state_->contacts.law()->doubles_per_contact() : 0;
  for (const BodyPair& pair : state_->contacts.pairs()) {
    if (pair.contact_count == 0) continue;
    state.insert(state.end(), {static_cast<double>(pair.a), static_cast<double>(pair.b)});
    const auto history = state_->contacts.history().subspan(std::size_t{pair.slot_start} * doubles,
                                                            std::size_t{pair.contact_count} * doubles);
    state.insert(state.end(), history.begin(), history.end());
  }
  return hash_of_bytes({reinterpret_cast<const char*>(state.data()), state.size() * sizeof(double)});
}

Motion Simulation::body_motion(std::size_t body) const {
  return point_motion(body, state_->model.bodies[body].centre);
}

Motion Simulation::point_motion(std::size_t body, Vec2 point_at_start) const {
  const State& s = *state_;
  const Vec2 centre = s.model.bodies[body].centre;
  const Vec2 reference{point_at_start.x - centre.x, point_at_start.y - centre.y};
  const Vec2 now = displacement(s.motion.bodies[body], reference);
  const Vec2 start = displacement(s.start[body], reference);
  const std::array<double, 3> stress = s.deformation.cauchy(body);
  return {{point_at_start.x + now.x, point_at_start.y + now.y},
          {now.x - start.x, now.y - start.y},
          velocity(s.at_time[body], reference),
          s.rotation[body],
          stress[0],
          stress[1],
          stress[2]};
}

std::vector<std::vector<Vec2>> Simulation::outline(std::size_t body) const {
  const State& s = *state_;
  const Vec2 centre = s.model.bodies[body].centre;
  std::vector<std::vector<Vec2>> loops;
  const auto append = [&](const Loop& loop) {
    std::vector<Vec2>& moved = loops.emplace_back();
    for (const Vec2& vertex : loop.vertices) {
      const Vec2 u = displacement(s.motion.bodies[body], {vertex.x - centre.x, vertex.y - centre.y});
      moved.push_back({vertex.x + u.x, vertex.y + u.y});
    }
  };
  append(s.scene.bodies[body].outer);
  for (const Loop& hole : s.scene.bodies[body].holes) append(hole);
  return loops;
}

std::vector<Contact> Simulation::contacts() const {
  std::vector<Contact> result;
  const State& s = *state_;
  for (const BodyPair& pair : s.contacts.pairs()) {
    const Vec2 frame = s.model.bodies[pair.a].centre;
    for (std::uint32_t i = 0; i < pair.contact_count; ++i) {
      const ContactReport& r = s.contacts.reports()[pair.slot_start + i];
      result.push_back({pair.a,
                        pair.b,
                        {frame.x + r.x, frame.y + r.y},
                        {r.px, r.py},
                        {r.tx, r.ty},
                        r.penetration,
                        r.slipping != 0});
    }
  }
  return result;
}

}  // namespace talus
