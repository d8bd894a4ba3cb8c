#include "contact/thin_ground.hpp"
#include "geometry/place.hpp"
#include "geometry/polygon.hpp"
#include "scene/tables.hpp"
#include "simulation/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

// What stops a run, and what it warns of: each with the pair, the place, the time and what to change.

namespace talus {
namespace {

constexpr double warn_residual = 0.01;  ///< of the energy throughput
/// A contact this deep at t = 0, as a share of the smaller width, throws bodies apart that were not settled.
constexpr double initial_overlap = 1e-6;
/// Share of its width that a body moves while it settles only if it was drawn elsewhere than it rests.
constexpr double far_to_settle = 0.1;

}  // namespace

std::string Simulation::State::place(std::uint32_t body) const {
  const Vec2 centre = model.bodies[body].centre;
  const Vec2 u = motion.displacement(model.point(body, {}));
  return fmt::format("'{}' at {} m", scene.bodies[body].name, place_from(scene.origin, centre + u));
}

/// " of" the first body with a velocity that is no number, and where it is, or was drawn if that is none
/// either; empty: there is none.
std::string Simulation::State::without_number() const {
  const auto number = [](Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); };
  const auto rows = [&](const Matrix2& m) { return number({m.xx, m.xy}) && number({m.yx, m.yy}); };
  const auto all = [&](const std::vector<Vec2>& of, std::uint32_t body) {
    const CoverRanges& ranges = model.ranges(model.bodies[body]);
    return std::all_of(of.begin() + ranges.patch_begin, of.begin() + ranges.patch_end, number);
  };
  for (const std::uint32_t body : model.moving_bodies) {
    const BodyMotion& at = motion.bodies[body];
    const bool covered = model.covered(body);
    const bool moves = covered ? all(motion.patch_velocity, body)
                               : number(at.velocity) && rows(at.rate) && std::isfinite(at.spin);
    if (moves) continue;
    if (covered ? all(motion.patch_displacement, body) : number(at.u) && rows(at.h))
      return " of " + place(body);
    return fmt::format(" of '{}', drawn at {} m,", scene.bodies[body].name,
                       place_from(scene.origin, model.bodies[body].centre));
  }
  return {};
}

void Simulation::State::check_numbers() const {
  if (std::isfinite(speeds.largest)) return;
  throw NumericalTrouble(
      fmt::format("a velocity{} is no longer a number at t = {:.9g} s (step {:.3g} s, critical {:.3g} s); "
                  "take a smaller time step",
                  without_number(), time, plan.dt, critical.dt));
}

/// As a plan begins, so at output times, and not where a checkpoint happens to be due. What is turned inside
/// out passes through others unseen.
void Simulation::State::check_shapes() const {
  if (plan.done == 0 && strain_energy.inside_out) refuse_inside_out();
}

/// If anything is. Own patches may have yet to catch up with the move of the step.
void Simulation::State::refuse_inside_out() const {
  const auto refuse = [&](std::uint32_t body, const char* what) {
    throw NumericalTrouble(
        fmt::format("{} turned inside out at t = {:.9g} s: {}; its material is too soft for what acts on it, "
                    "or the step {:.3g} s "
                    "(critical {:.3g} s) too large: raise young_modulus, given in Pa, or take a smaller step",
                    place(body), time, what, plan.dt, critical.dt));
  };
  const auto inverted = [](const Matrix2& h) { return !((1 + h.xx) * (1 + h.yy) - h.xy * h.yx > 0); };
  for (const std::uint32_t body : model.moving_bodies) {
    if (!model.covered(body) && inverted(motion.bodies[body].h)) refuse(body, "its area became negative");
  }
  std::vector<Vec2> displacement = motion.patch_displacement;
  for (const std::uint32_t body : model.covered_bodies) {
    const CoverRanges& ranges = model.ranges(model.bodies[body]);
    for (std::uint32_t p = ranges.patch_begin; p < ranges.own_end; ++p) {
      displacement[p].x += motion.own_behind * motion.patch_velocity[p].x;
      displacement[p].y += motion.own_behind * motion.patch_velocity[p].y;
    }
  }
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const std::uint32_t body = model.element_body[e];
    if (model.covered(body) && inverted(gradient(model.elements[e], displacement)))
      refuse(body, "the area of an element became negative");
  }
}

void Simulation::State::check_law() const {
  const LawFault& fault = contacts.fault();
  if (fault.found.empty()) return;
  if (plan.done == 0) refuse_inside_out();  // then it is not for the law to be mended
  const RegisteredComponent& law = *scene.contact.component;
  const std::string where =
      fault.of_pair ? fmt::format(" between {} and {}", place(fault.a), place(fault.b)) : "";
  throw NumericalTrouble(
      fmt::format("{}: contact law '{}' gave {}{} at t = {:.9g} s; wanted finite loads that are equal and "
                  "opposite and leave no "
                  "moment, written at the corners of the pairs it is given; mend the law or choose another",
                  law.file.string(), law.component->name, fault.found, where, time));
}

/// Elements of several materials may be in one sum: the names of all are as near as it goes.
/// A stress that is no number shows in the kinetic energy first: loads of contacts were looked at.
void Simulation::State::check_materials(double kinetic) const {
  const bool strains = std::isfinite(strain_energy.stored + strain_energy.dissipated);
  if (strains && std::isfinite(kinetic)) return;
  std::string names;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (model.material_element_start[m] == model.material_element_start[m + 1]) continue;
    const RegisteredComponent& component = *scene.materials[m].model.component;
    names += fmt::format("{}'{}' of {}", names.empty() ? "" : ", ", component.component->name,
                         component.file.string());
  }
  throw NumericalTrouble(
      fmt::format("the {} energy{} is no longer a number at t = {:.9g} s (step {:.3g} s, critical {:.3g} "
                  "s); take a smaller time step{}{}",
                  strains ? "kinetic" : "strain", without_number(), time, plan.dt, critical.dt,
                  names.empty() ? "" : ", or mend the material: ", names));
}

/// What comes first, where it is so.
std::string Simulation::State::above_critical() const {
  if (!(plan.dt > critical.dt)) return "";
  return fmt::format("; the step of {:.3g} s is {:.2g} of the critical {:.3g} s ({}): no run stands that",
                     plan.dt, plan.dt / critical.dt, critical.dt, limiter_of(scene, critical));
}

void Simulation::State::check_step() const {
  if (scene.time.dt && plan.dt > too_fast * allowed_dt()) {
    throw NumericalTrouble(fmt::format(
        "the step is too large for the speed at t = {:.9g} s: bodies approach at up to {:.6g} "
        "m/s, {:.3g} m in a "
        "step of {:.3g} s, more than {:.0f} % of the smallest width {:.3g} m; the step is {:.2g} "
        "of the critical {:.3g} "
        "s; take a smaller one, /time/dt below {:.3g} or \"auto\"",
        time, speeds.relative, speeds.relative * plan.dt, plan.dt, 100 * speed_share * too_fast,
        model.smallest_width, plan.dt / critical.dt, critical.dt, std::min(allowed_dt(), critical.dt)));
  }
  // The automatic step is bound by speeds that bodies had; what gains its speed within one has passed others
  // before anybody has looked.
  const double way = speeds.relative * dt_behind;
  if (!scene.time.dt && way > passed_share * model.smallest_width) {
    throw NumericalTrouble(fmt::format(
        "the automatic step is too large for what acts at t = {:.9g} s: within {:.3g} s bodies came to move "
        "at {:.6g} m/s against each other, {:.3g} m in a step, where the smallest width is {:.3g} m; look at "
        "loads, gravity and ground motion, or take /time/dt below {:.3g}",
        time, dt_behind, speeds.relative, way, model.smallest_width,
        dt_behind * std::sqrt(speed_share * model.smallest_width / way)));
  }
  const ContactTotals& totals = contact_totals;
  if (totals.penetration == 0) return;
  const Body &a = model.bodies[totals.deepest_a], &b = model.bodies[totals.deepest_b];
  const double width = std::min(a.width, b.width),
               visible = 0.9 * std::min(model.ranges(a).contact_depth, model.ranges(b).contact_depth);
  if (!(totals.penetration <= std::min(scene.limits.penetration * width, visible))) {
    if (visible < scene.limits.penetration * width) {
      throw NumericalTrouble(
          fmt::format("too deep an overlap at t = {:.9g} s: {} and {} overlap by {:.3g} m, more than the "
                      "{:.3g} m behind the "
                      "boundary of a body of many elements that contact can see; raise normal_stiffness of "
                      "their interface, "
                      "take a larger size of elements or a smaller time step, or part them at the start{}",
                      time, place(totals.deepest_a), place(totals.deepest_b), totals.penetration, visible,
                      above_critical()));
    }
    throw NumericalTrouble(
        fmt::format("too deep an overlap at t = {:.9g} s: {} and {} overlap by {:.3g} m, more than {:.3g} % "
                    "of the smaller width "
                    "{:.3g} m; raise normal_stiffness of their interface, take a smaller time step, or part "
                    "them at the start{}",
                    time, place(totals.deepest_a), place(totals.deepest_b), totals.penetration,
                    100 * scene.limits.penetration, width, above_critical()));
  }
}

/// What contacts hold is never less than nothing; that a law says so hides what it makes.
void Simulation::State::check_stored() const {
  const double stored = contact_totals.stored;
  if (!(stored < 0 && ledger.share(stored) > 1e-6)) return;  // else that is rounding
  const RegisteredComponent& law = *scene.contact.component;
  throw NumericalTrouble(fmt::format(
      "{}: contact law '{}' gave a stored energy of {:.3g} J/m in all at t = {:.9g} s; wanted 0 or more; "
      "mend the law or choose another",
      law.file.string(), law.component->name, stored, time));
}

void Simulation::State::check_balance() {
  check_stored();
  const double share = ledger.residual_share();
  if (share > summary.largest_residual_share) {
    if (share > warn_residual && summary.largest_residual_share <= warn_residual) {
      summary.warnings.push_back(fmt::format(
          "the energy balance misses {:.3g} % of the throughput at t = {:.6g} s", 100 * share, time));
    }
    summary.largest_residual_share = share;
  }
  if (share <= scene.limits.energy_residual) return;
  const std::string deepest =
      contact_totals.penetration > 0
          ? fmt::format("; deepest contact {:.3g} m between {} and {}", contact_totals.penetration,
                        place(contact_totals.deepest_a), place(contact_totals.deepest_b))
          : "";
  const Component* law = scene.contact.component == nullptr ? nullptr : scene.contact.component->component;
  const bool no_potential = law != nullptr && (law->traits & trait::has_potential) == 0,
             small_step = plan.dt < hardly_the_step * critical.dt;
  const std::string cause =
      no_potential            ? fmt::format("'{}', which has no potential, makes or loses it", law->name)
      : plan.dt < critical.dt ? "`talus check-plugin` tells whether law and materials book what they take"
                              : "";
  const std::string otherwise =
      cause.empty() ? "" : fmt::format("; {}{}", small_step ? "" : "where that changes nothing, ", cause);
  // The work of dashpots is booked to the first order in the step where contacts move along bodies.
  const bool dashpots =
      ledger.ledger().contact_damping_loss > scene.limits.energy_residual * ledger.ledger().throughput;
  const char* const advice = small_step       ? "hardly the step"
                             : law == nullptr ? "take a smaller one"
                             : dashpots       ? "take a smaller one in /time/dt, or less normal_damping"
                                              : "take a smaller one, or damp the contacts";
  throw NumericalTrouble(
      fmt::format("the energy balance is lost at t = {:.9g} s: residual {:.3g} J/m is {:.2g} % of the "
                  "throughput {:.3g} J/m, the limit is {:.2g} %{}; the step is {:.3g} s, {:.2g} of the "
                  "critical {:.3g} s ({}): {}{}",
                  time, ledger.ledger().residual, 100 * share, ledger.ledger().throughput,
                  100 * scene.limits.energy_residual, deepest, plan.dt, plan.dt / critical.dt, critical.dt,
                  limiter_of(scene, critical), advice, otherwise));
}

void Simulation::State::warn_of_large_step() {
  if (!scene.time.dt) return;
  if (limit == Limit::output) {
    summary.warnings.push_back(
        fmt::format("time.dt of {:.3g} s is longer than the time between outputs: steps are of {:.3g} s",
                    *scene.time.dt, plan.dt));
  }
  // Bodies that are far from each other at the start may meet.
  const CriticalStep least = votes.anyhow();
  if (plan.dt > least.dt) {
    summary.warnings.push_back(
        fmt::format("the fixed step {:.3g} s is {:.2g} of the critical {:.3g} s ({}): the run may blow up",
                    plan.dt, plan.dt / least.dt, least.dt, limiter_of(scene, least)));
  } else if (plan.dt > table::safety_with_contact * critical.spring_dt) {
    summary.warnings.push_back(fmt::format(
        "the fixed step {:.3g} s is {:.2g} of the critical {:.3g} s of contacts and supports alone (body "
        "'{}'); above {} of it contacts gain or lose energy",
        plan.dt, plan.dt / critical.spring_dt, critical.spring_dt, scene.bodies[critical.spring_body].name,
        table::safety_with_contact));
  }
}

/// Where it has friction held stuck and all strength intact a scene is another, and the ledger of that is no
/// part of the run; yet what appears from nothing has put it elsewhere.
void Simulation::State::warn_of_unbalanced_settling() {
  const double share = ledger.residual_share();
  if (share <= scene.limits.energy_residual) return;
  summary.warnings.push_back(fmt::format(
      "while the scene settled the energy balance missed {:.2g} % of the throughput of {:.3g} J/m: "
      "where it came to rest may be wrong",
      100 * share, ledger.ledger().throughput));
}

void Simulation::State::warn_of_initial_overlap() {
  const ContactTotals& totals = contact_totals;
  if (scene.settle || totals.penetration == 0) return;
  const double width = std::min(model.bodies[totals.deepest_a].width, model.bodies[totals.deepest_b].width);
  if (totals.penetration <= initial_overlap * width) return;
  summary.warnings.push_back(fmt::format(
      "{} and {} overlap by {:.3g} m at the start and will be thrown apart; part them or add a settle stage",
      place(totals.deepest_a), place(totals.deepest_b), totals.penetration));
}

/// Displacements count from t = 0: nothing else tells of a block that was drawn in the air.
void Simulation::State::warn_of_settlement() {
  std::size_t count = 0;
  std::uint32_t farthest = 0;
  double most = 0;
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
    if (!model.moves(i)) continue;
    const double way = size_of(motion.displacement(model.point(i, {})));
    if (!(way > far_to_settle * smallest_width(scene.bodies[i].outer.vertices))) continue;
    ++count;
    if (way > most) most = way, farthest = i;
  }
  if (count == 0) return;
  summary.warnings.push_back(fmt::format(
      "while it settled {} moved by more than {} of {}, {}{} by {:.3g} m: displacements count from "
      "there; was it drawn off what it rests on, or does it fall?",
      count == 1 ? "a body" : fmt::format("{} bodies", count), far_to_settle,
      count == 1 ? "its width" : "their widths", count == 1 ? "" : "the most ", place(farthest), most));
}

/// At output times, once in a run: check_step() knows how deep contact sees half of a body's sides alone.
void Simulation::State::warn_of_thin_ground() {
  if (model.covered_bodies.empty() || told_of_thin_ground) return;
  const std::optional<ThinGround> found = find_thin_ground(model, motion, contacts);
  if (!found) return;
  told_of_thin_ground = true;
  const std::string by = found->other == found->body ? "another part of itself"
                                                     : fmt::format("'{}'", scene.bodies[found->other].name);
  summary.warnings.push_back(fmt::format(
      "'{}' is met deeper than contact sees it by {} at {} m, t = {:.6g} s: it is thin there, and its "
      "surface pushes to a depth of {:.3g} m; raise normal_stiffness of their interface, or make the thin "
      "part a body of its own",
      scene.bodies[found->body].name, by, place_from(scene.origin, found->place), time, found->depth));
}

}  // namespace talus
