#include "compare/comparison.hpp"
#include "compare/left_out.hpp"

#include "files/input_error.hpp"
#include "output/history.hpp"
#include "parallel/tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <future>
#include <mutex>

namespace talus {

namespace {

/// Positions of all vertices, body by body, loop by loop.
std::vector<Vec2> vertices_of(const Simulation& simulation) {
  std::vector<Vec2> positions;
  const Scene& scene = simulation.scene();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    each_loop(scene.bodies[i], [&](const Loop& loop) {
      for (const Vec2 vertex : loop.vertices)
        positions.push_back(simulation.point_motion(i, vertex).position);
    });
  }
  return positions;
}

std::optional<double> largest_distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  if (a.size() != b.size()) return std::nullopt;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::hypot(a[i].x - b[i].x, a[i].y - b[i].y));
  return largest;
}

/// The runs of a comparison, made by a few workers. The scene of the baseline settles first; all runs, that
/// of the baseline too, settle from the geometry it comes to, so that equal scenes have equal runs.
class SideBySide {
 public:
  SideBySide(const ComparisonOrder& order, Comparison& comparison)
      : order_(order),
        comparison_(comparison),
        settled_(order.scenes.size()),
        shares_(order.scenes.size(), 0.0) {}

  void run() {
    do_tasks(order_.scenes.size(), order_.threads, [this](std::size_t i) {
      if (i == 0) baseline_geometry_.set_value(settle_baseline());
      make_run(i);
    });
    for (std::size_t i = 0; i < order_.scenes.size(); ++i) {
      if (!settled_[0].empty())
        comparison_.runs[i].settled_difference = largest_distance(settled_[0], settled_[i]);
    }
    std::sort(comparison_.warnings.begin(), comparison_.warnings.end());
  }

 private:
  /// Nothing where there is none to hand on, or it comes to trouble, which its run will meet again and
  /// record.
  std::optional<Geometry> settle_baseline() {
    if (!order_.scenes[0].settle) return std::nullopt;
    try {
      Simulation simulation(order_.scenes[0], settings());
      if (simulation.settle([&] { return order_.interrupted != nullptr && *order_.interrupted; })) {
        const std::lock_guard lock(mutex_);
        for (const std::string& warning : simulation.summary().warnings)
          comparison_.warnings.push_back(fmt::format("the geometry that all start from: {}", warning));
        return simulation.geometry();
      }
    } catch (const std::exception&) {
    }
    return std::nullopt;
  }

  RunSettings settings() const {
    RunSettings settings;
    settings.neighbour_skin = order_.neighbour_skin;
    settings.largest_dt = comparison_.common_dt.value_or(0);
    return settings;
  }

  void make_run(std::size_t i) {
    RunOrder run;
    run.folder = order_.folder / folder_of_value(order_.variation.values[i]);
    run.overrides = order_.overrides;
    run.overrides.push_back({order_.variation.pointer, order_.variation.values[i]});
    run.scene_hash = order_.scene_hash;
    run.settings = settings();
    run.clock = CpuClock::thread;
    run.interrupted = order_.interrupted;
    run.before_settling = [&](Simulation& simulation) { start_like_baseline(i, simulation); };
    run.after_settling = [&](Simulation& simulation) { settled_[i] = vertices_of(simulation); };
    const double end = order_.scenes[i].time.end;
    run.progress = [&, i, end](double time) { tell_progress(i, time / end); };
    Simulation simulation(order_.scenes[i], run.settings);
    comparison_.runs[i].result = record_run(simulation, run);
    tell_progress(i, 1);
  }

  void start_like_baseline(std::size_t i, Simulation& simulation) {
    if (!order_.scenes[i].settle || !order_.scenes[0].settle) return;
    const std::optional<Geometry>& geometry = geometry_.get();
    const std::string why =
        geometry ? simulation.take_geometry(*geometry) : "there is no geometry to start from";
    if (why.empty() || i == 0) return;
    const std::lock_guard lock(mutex_);
    comparison_.warnings.push_back(
        fmt::format("'{}' settled by itself: {}", order_.variation.values[i], why));
  }

  void tell_progress(std::size_t i, double share) {
    const std::lock_guard lock(mutex_);
    shares_[i] = share;
    double sum = 0;
    for (const double each : shares_) sum += each;
    if (order_.progress) order_.progress(sum / static_cast<double>(shares_.size()));
  }

  const ComparisonOrder& order_;
  Comparison& comparison_;
  std::vector<std::vector<Vec2>> settled_;  ///< [run][vertex]
  std::vector<double> shares_;              ///< [run] of the simulated time
  std::promise<std::optional<Geometry>> baseline_geometry_;
  std::shared_future<std::optional<Geometry>> geometry_ = baseline_geometry_.get_future().share();
  std::mutex mutex_;
};

/// The automatic step of each scene. The smallest is the common one, unless the scene states another.
void vote_dt(const ComparisonOrder& order, Comparison& comparison) {
  double smallest = 0;
  for (std::size_t i = 0; i < order.scenes.size(); ++i) {
    const Simulation simulation(order.scenes[i], RunSettings{});
    const std::optional<double>& given = order.scenes[i].time.dt;
    const double own = order.variation.of_time() && given ? *given : simulation.automatic_dt();
    comparison.runs[i].own_dt = own;
    comparison.runs[i].critical_dt = simulation.critical_dt();
    smallest = i == 0 ? own : std::min(smallest, own);
  }
  if (!order.variation.of_time()) comparison.common_dt = order.scenes[0].time.dt.value_or(smallest);
}

/// Column "<monitor>.<quantity> [unit]" of a tolerance, whatever the unit.
bool is_column_of(const std::string& column, const Tolerance& tolerance) {
  return column.starts_with(tolerance.monitor + "." + tolerance.quantity + " [");
}

void add_deviations(const ComparisonOrder& order, Comparison& comparison, std::size_t run,
                    const Series& other, bool from_reference) {
  const Series& history = comparison.runs[run].result.history;
  const Between between = from_reference ? Between::line : Between::unknown;
  for (std::size_t column = 0; column < history.names.size(); ++column) {
    const auto other_column = other.column(history.names[column]);
    if (!other_column) continue;
    const auto found = deviation(history, column, other, *other_column, between);
    if (!found) continue;
    ColumnDeviation& entry = comparison.deviations.emplace_back(
        ColumnDeviation{history.names[column], run, from_reference, *found, {}});
    for (const double moment : order.moments) {
      entry.at_moments.push_back(deviation_at(history, column, other, *other_column, between, moment));
    }
  }
}

}  // namespace

void check_order(const ComparisonOrder& order) {
  if (order.scenes.size() < 2 && !order.reference) {
    throw InputError("a comparison needs two values to --vary, or one and a --reference");
  }
  const std::vector<std::string> columns = monitor_columns(order.scenes[0]);
  if (columns.empty()) throw InputError("the scene has no monitors, so there is nothing to compare");
  const double end = order.scenes[0].time.end;
  for (const double moment : order.moments) {
    if (!(moment >= 0 && moment <= end))
      throw InputError(
          fmt::format("--at {}: the runs go from 0 to {} s, so there is nothing to tell", moment, end));
  }
  const auto shares_some = [&](const std::vector<std::string>& names) {
    return std::ranges::any_of(columns,
                               [&](const std::string& each) { return std::ranges::count(names, each) != 0; });
  };
  for (std::size_t run = 1; run < order.scenes.size(); ++run) {
    const std::vector<std::string> own = monitor_columns(order.scenes[run]);
    if (own.empty())
      throw InputError(fmt::format("with '{}' the scene has no monitors, so there is nothing to compare",
                                   order.variation.values[run]));
    if (!shares_some(own))
      throw InputError(fmt::format("'{}' and '{}' have no column in common to be compared by: '{}' and '{}'",
                                   order.variation.values[0], order.variation.values[run],
                                   fmt::join(columns, "', '"), fmt::join(own, "', '")));
  }
  if (!order.reference) return;
  const std::vector<std::string>& names = order.reference->series.names;
  if (shares_some(names)) return;
  throw InputError(fmt::format("{}: none of its columns is one of the scene's: it has '{}', the scene '{}'",
                               order.reference->file, fmt::join(names, "', '"), fmt::join(columns, "', '")));
}

bool Comparison::tolerances_held() const {
  for (const ComparedTolerance& each : tolerances) {
    for (const ToleranceCheck& found : each.checks) {
      if (found.verdict != ToleranceVerdict::held) return false;
    }
  }
  return true;
}

void evaluate(const ComparisonOrder& order, Comparison& comparison) {
  for (std::size_t run = 0; run < comparison.runs.size(); ++run) {
    if (run > 0) add_deviations(order, comparison, run, comparison.runs[0].result.history, false);
    if (order.reference) add_deviations(order, comparison, run, order.reference->series, true);
  }
  warn_of_what_is_left_out(order, comparison);
  const auto cut_short = [&](std::size_t run, const Tolerance& tolerance) {
    const double end = order.scenes[0].time.end;
    const auto ends_early = [&](const Series& series) {
      return series.time.empty() || !(series.time.back() >= end - time_tolerance(series.time));
    };
    const auto covers_part = [&](const Series& series) {
      return ends_early(series) || series.time.front() > time_tolerance(series.time);
    };
    const auto unfinished = [&](const ComparedRun& each) {
      return each.result.end != RunEnd::finished || ends_early(each.result.history);
    };
    return unfinished(comparison.runs[run]) ||
           (tolerance.against_reference ? covers_part(order.reference->series)
                                        : unfinished(comparison.runs[0]));
  };
  for (const Tolerance& tolerance : order.scenes[0].tolerances) {
    if (tolerance.against_reference && !order.reference) {
      comparison.warnings.push_back(
          fmt::format("the tolerance of {}.{} against a reference was not checked: give --reference",
                      tolerance.monitor, tolerance.quantity));
      continue;
    }
    for (std::size_t run = tolerance.against_reference ? 0 : 1; run < comparison.runs.size(); ++run) {
      ComparedTolerance& entry = comparison.tolerances.emplace_back(ComparedTolerance{tolerance, run, {}});
      std::optional<Deviation> found;
      for (const ColumnDeviation& each : comparison.deviations) {
        if (each.run == run && each.from_reference == tolerance.against_reference &&
            is_column_of(each.column, tolerance))
          found = each.deviation;
      }
      entry.checks = check(tolerance, found, cut_short(run, tolerance));
      if (!found) {
        comparison.warnings.push_back(
            fmt::format("the tolerance of {}.{} was not checked for '{}': nothing to compare with",
                        tolerance.monitor, tolerance.quantity, comparison.runs[run].value));
      }
    }
  }
}

namespace {

/// Of a run at steps of `dt` at most, which meet every output time.
double steps_at(const Scene& scene, double dt) {
  const auto of_span = [&](double span) { return span > 0 ? std::ceil(span / dt * (1 - 1e-9)) : 0.0; };
  const double interval = std::min(scene.output.history, scene.time.end),
               whole = std::floor(scene.time.end / interval * (1 + 1e-12)),
               rest = scene.time.end - whole * interval;
  return whole * of_span(interval) + (rest > 1e-9 * interval ? of_span(rest) : 0.0);
}

/// Whether a stage bound the step more than the vote at the start, also where the scene states it.
bool was_bound_more(const ComparedRun& run) {
  return run.result.summary.critical_dt < 0.99 * run.critical_dt;
}

/// Where nothing but the vote at the start bound the step, it bounds that of each run by itself, too.
void count_own_steps(const ComparisonOrder& order, Comparison& comparison) {
  const bool some_critical =
      std::ranges::any_of(comparison.runs, [](const ComparedRun& run) { return std::isfinite(run.own_dt); });
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    ComparedRun& run = comparison.runs[i];
    if (run.result.end != RunEnd::finished) continue;
    const auto made = static_cast<double>(run.result.summary.steps);
    if (!comparison.common_dt || !some_critical) {
      run.own_steps = made;
      continue;
    }
    const Scene& scene = order.scenes[i];
    const double due = steps_at(scene, *comparison.common_dt);
    const bool as_planned = std::abs(made - due) <= 0.01 * due;
    if (as_planned && !was_bound_more(run)) {
      run.own_steps = steps_at(scene, run.own_dt);
      continue;
    }
    if (as_planned) {
      comparison.warnings.push_back(
          fmt::format("a stage bound the step of '{}' by itself to {:.3g} of that at its start, so what it "
                      "costs at its own step is not told",
                      run.value, run.result.summary.critical_dt / run.critical_dt));
      continue;
    }
    comparison.warnings.push_back(fmt::format(
        "'{}' took {} steps, where the largest step for all makes {:.0f}: speed, contacts or a "
        "stage bound its own more from some time on, so what it costs at its own step is not told",
        run.value, run.result.summary.steps, due));
  }
}

}  // namespace

Comparison planned(const ComparisonOrder& order) {
  check_order(order);
  Comparison comparison;
  comparison.runs.resize(order.scenes.size());
  for (std::size_t i = 0; i < order.scenes.size(); ++i) comparison.runs[i].value = order.variation.values[i];
  vote_dt(order, comparison);
  return comparison;
}

void compare(const ComparisonOrder& order, Comparison& comparison) {
  SideBySide(order, comparison).run();
  count_own_steps(order, comparison);
  if (order.variation.pointer.starts_with("/settle/") && order.scenes[0].settle) {
    comparison.warnings.push_back(fmt::format(
        "all runs settle from what '{}' settled to, so that one with another /settle starts from there, not "
        "from the scene as drawn; where that matters run each by itself",
        order.variation.values[0]));
  }
  evaluate(order, comparison);
}

}  // namespace talus
