#include "files/input_error.hpp"
#include "simulation/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace talus {
namespace {

/// Up to the next output: centuries of computing, and still a whole number in a double.
constexpr double countable_steps = 1e15;

}  // namespace

CriticalStep Simulation::State::with_numbers_outside(CriticalStep bound) const {
  bound.body = numbering.outside(bound.body);
  bound.spring_body = numbering.outside(bound.spring_body);
  return bound;
}

double Simulation::State::nominal_dt() const {
  if (scene.time.dt) return *scene.time.dt;
  const double dt = automatic_step(critical, scene.time.safety);
  return settings.largest_dt > 0 ? std::min(dt, settings.largest_dt) : dt;
}

/// The step fits the neighbours that bodies have: it is cut short at once where it must be, and grows with
/// the next plan.
void Simulation::State::vote_again() {
  critical = votes.among(contacts.lightest_neighbours(), contacts.heaviest_neighbours());
  if (scene.time.dt) return;
  const bool too_long = plan.dt > nominal_dt() * (1 + rounding);
  if (too_long || plan.done == 0) make_plan(plan.target);
}

/// v_rel Δt ≤ 0.1 h.
double Simulation::State::allowed_dt() const {
  return speeds.relative > 0 ? speed_share * model.smallest_width / speeds.relative
                             : std::numeric_limits<double>::infinity();
}

/// What cannot be run is refused before anything is written.
void Simulation::State::refuse_uncountable_steps() const {
  const double dt = scene.time.dt ? *scene.time.dt : automatic_step(votes.anyhow(), scene.time.safety);
  const auto refuse = [&](double span, const char* what) {
    if (span / dt <= countable_steps) return;
    throw InputError(fmt::format(
        "{} of {:.3g} s makes {:.3g} steps {} at {:.6g} s, more than any run can do: expected at most {:.0e}",
        scene.time.dt ? "/time/dt" : "the automatic step", dt, span / dt, what, span, countable_steps));
  };
  if (scene.settle) refuse(scene.settle->duration, "to the end of /settle");
  refuse(std::min(scene.output.history, scene.time.end), "to the first output");
}

/// At each output time, so nothing is put into words here.
void Simulation::State::make_plan(double end) {
  if (!(end > time)) {  // nowhere left to go: the velocity at the end looks ahead by the step it came with
    plan = {time, time, plan.dt, 1, 0, time};
    return;
  }
  double dt = nominal_dt();
  if (!scene.time.dt) limit = Limit::critical;
  if (!scene.time.dt && allowed_dt() < dt) {
    dt = allowed_dt();
    limit = Limit::speed;
  }
  planned_with = critical;
  const double target = end;
  // A stage a rounding before the output begins with it: no step is as short as that.
  if (!settling && stages_begun < scene.stages.size() &&
      scene.stages[stages_begun].from < target * (1 - rounding))
    end = std::min(end, scene.stages[stages_begun].from);
  const double span = end - time;
  const double wanted = std::max(1.0, std::ceil(span / dt * (1 - rounding)));
  if (!(wanted <= countable_steps)) {
    const std::string words = fmt::format(
        "from t = {:.6g} s to the next output at {:.6g} s there are {:.3g} steps of {:.3g} s, "
        "more than any run can do: expected at most {:.0e}",
        time, end, wanted, dt, countable_steps);
    if (dt_behind == 0) throw InputError(words);
    throw NumericalTrouble(words);
  }
  const auto steps = static_cast<std::uint64_t>(wanted);
  was_beside_stage = std::exchange(beside_stage, stage_begins || end < target);
  plan = {time, end, span / static_cast<double>(steps), steps, 0, target};
  // Of fixed steps that which limits the largest: what is left over at the end may be short.
  if (scene.time.dt && plan.dt > summary.dt)
    limit = span < dt * (1 - rounding) && !(end < target) ? Limit::output : Limit::scene;
  summary.dt = std::max(summary.dt, plan.dt);
}

std::string Simulation::State::limiter() const {
  switch (limit) {
    case Limit::none:
      return "";
    case Limit::scene:
      return "time.dt of the scene";
    case Limit::output:
      return "time between outputs; time.dt of the scene is longer";
    case Limit::speed:
      return "speed: no two bodies may approach by more than a tenth of the smallest width in a step";
    case Limit::critical:
      break;
  }
  return limiter_of_automatic(scene, planned_with);
}

}  // namespace talus
