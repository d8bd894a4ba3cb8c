#include "preview/preview.hpp"

#include "machine/stopwatch.hpp"
#include "output/frame.hpp"
#include "output/history.hpp"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace talus {
namespace {

void measure_edges(const Scene& scene, Preview& preview) {
  preview.smallest_edge = std::numeric_limits<double>::infinity();
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
    each_loop(scene.bodies[body], [&](const Loop& loop) {
      for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
        const Vec2 from = loop.vertices[i], to = loop.vertices[(i + 1) % loop.vertices.size()];
        const double length = std::hypot(to.x - from.x, to.y - from.y);
        if (!(length < preview.smallest_edge)) continue;
        preview.smallest_edge = length;
        preview.smallest_edge_body = body;
      }
    });
  }
}

/// The thinnest body fixes the step of all.
void look_for_slivers(const Simulation& simulation, Preview& preview) {
  constexpr double sliver = 1e-3;  ///< of the width of the body in the middle
  const Scene& scene = simulation.scene();
  std::vector<std::pair<double, std::size_t>> widths;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    if (!scene.bodies[body].fixed) widths.emplace_back(simulation.body_width(body), body);
  }
  std::sort(widths.begin(), widths.end());
  const double least = widths.empty() ? 0 : sliver * widths[widths.size() / 2].first;
  const auto count =
      std::count_if(widths.begin(), widths.end(), [&](const auto& of) { return of.first < least; });
  if (count == 0) return;
  preview.warnings.push_back(fmt::format(
      "{} of {} bodies that move {} thinner than a thousandth of most, '{}' the thinnest with {:.3g} m, "
      "and make steps short: of generated blocks those below /blocks/*/smallest_share join a neighbour",
      count, widths.size(), count == 1 ? "is" : "are", scene.bodies[widths[0].second].name, widths[0].first));
}

/// Row sums resist turning more than the body does, by the square of an element over its size.
void look_for_inertia(const Simulation& simulation, Preview& preview) {
  constexpr double worth_a_word = 1.05;
  const Scene& scene = simulation.scene();
  std::size_t count = 0, worst = 0;
  double most = worth_a_word;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    const double share = scene.bodies[body].fixed ? 1 : simulation.inertia_share(body);
    if (share > worth_a_word) ++count;
    if (share > most) most = share, worst = body;
  }
  if (count == 0) return;
  preview.warnings.push_back(
      fmt::format("{} on elements too coarse to turn as {} should: '{}' has {:.3g} times its moment of "
                  "inertia; take smaller elements where it spins, rolls or topples",
                  count == 1 ? "a body is" : fmt::format("{} bodies are", count), count == 1 ? "it" : "they",
                  scene.bodies[worst].name, most));
}

void look_at_start(const Simulation& simulation, Preview& preview) {
  preview.pairs = simulation.pair_count();
  for (const Contact& contact : simulation.contacts()) {
    ++preview.contacts;
    if (!(contact.penetration > preview.overlap)) continue;
    preview.overlap = contact.penetration;
    preview.overlap_a = contact.body_a;
    preview.overlap_b = contact.body_b;
  }
}

/// The first step is left out: it is the one that makes room for all others.
void try_steps(Simulation& simulation, double seconds, Preview& preview) {
  std::optional<Stopwatch> watch;
  std::uint64_t first = 0;
  const auto enough = [&] {
    if (watch) return watch->elapsed().wall > seconds;
    watch.emplace(CpuClock::process);
    first = simulation.summary().steps;
    return false;
  };
  try {
    while (!(watch && enough()) && simulation.advance(enough)) {
    }
  } catch (const NumericalTrouble&) {  // without the settle stage that the scene may count on
  }
  preview.trial_seconds = watch ? watch->elapsed().wall : 0;
  preview.trial_steps = simulation.summary().steps - first;
}

std::uint64_t row_bytes(double time, const std::vector<double>& values) {
  std::uint64_t bytes = fmt::formatted_size("{}", time) + 1;
  for (const double value : values) bytes += fmt::formatted_size(",{}", value);
  return bytes;
}

/// Rows, frames, and what they come to. Returns what writing a frame takes, s.
double measure_output(const Simulation& simulation, Preview& preview) {
  const Scene& scene = simulation.scene();
  const auto count = [&](double interval) {
    return 1 + static_cast<std::uint64_t>(std::ceil(scene.time.end / interval * (1 - 1e-12)));
  };
  preview.rows = count(scene.output.history);
  preview.frames = scene.output.frames ? count(*scene.output.frames) : 0;
  // A third of an interval has as many digits as most times.
  preview.bytes = preview.rows * (row_bytes(scene.output.history / 3, sample_monitors(simulation)) +
                                  row_bytes(scene.output.history / 3, energies(simulation.ledger())));
  if (preview.frames == 0) return 0;
  PointNumbers numbers = point_numbers(simulation);  // a run finds them once
  const Stopwatch watch(CpuClock::process);
  preview.bytes += preview.frames * FrameWriter::bytes_of(sample_frame(simulation), std::move(numbers));
  return watch.elapsed().wall;
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// Steps of all stages, and which of these a fixed step is too long for.
void foresee_stages(Simulation& simulation, Preview& preview) {
  const Scene& scene = simulation.scene();
  const double at_first = automatic_step(simulation.present_bound(), scene.time.safety);
  double dt = preview.dt, from = 0;
  const auto add_steps = [&](double until) {
    preview.steps += std::max(1.0, std::ceil((until - from) / dt));
    from = until;
  };
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const Stage& stage = scene.stages[i];
    add_steps(stage.from);
    const CriticalStep& bound = preview.stages.emplace_back(simulation.bound_of_stage(i));
    if (!scene.time.dt) {
      const double automatic = automatic_step(bound, scene.time.safety);
      dt = automatic == at_first ? preview.dt : std::min(automatic, scene.output.history);
    } else if (dt > bound.dt) {
      preview.warnings.push_back(
          fmt::format("from stage '{}' on the fixed step {:.3g} s is {:.2g} of the critical {:.3g} s ({}): "
                      "the run may blow up",
                      stage.name, dt, dt / bound.dt, bound.dt, limiter_of(scene, bound)));
    }
  }
  add_steps(scene.time.end);
}

}  // namespace

Preview preview(Simulation& simulation, double trial_seconds) {
  const Scene& scene = simulation.scene();
  Preview preview;
  measure_edges(scene, preview);
  compare_stiffness(simulation, preview);
  look_for_slivers(simulation, preview);
  look_for_inertia(simulation, preview);
  bool stops = false;
  try {
    simulation.advance();
  } catch (const NumericalTrouble& trouble) {
    stops = true;
    preview.warnings.push_back(fmt::format(
        "{}: {}", scene.settle ? "it stops at t = 0 if settling does not help" : "it stops at t = 0",
        trouble.what()));
  }
  look_at_start(simulation, preview);
  const RunSummary summary = simulation.summary();
  preview.dt = summary.dt;
  preview.dt_limiter = summary.dt_limiter;
  foresee_stages(simulation, preview);
  // Without rows of the history to meet on the way.
  const double unhindered =
      scene.time.dt.value_or(automatic_step(simulation.present_bound(), scene.time.safety));
  if (scene.settle) preview.settle_steps = std::max(1.0, std::ceil(scene.settle->duration / unhindered));
  preview.warnings.insert(preview.warnings.end(), scene.warnings.begin(), scene.warnings.end());
  preview.warnings.insert(preview.warnings.end(), summary.warnings.begin(), summary.warnings.end());
  const std::vector<std::string> raised = review(scene, unhindered);
  preview.warnings.insert(preview.warnings.end(), raised.begin(), raised.end());
  if (!stops) try_steps(simulation, trial_seconds, preview);
  simulation.look_now();
  const double frame_seconds = measure_output(simulation, preview);
  preview.estimated_seconds = static_cast<double>(preview.frames) * frame_seconds;
  if (preview.trial_steps > 0) {
    preview.estimated_seconds += (preview.steps + preview.settle_steps) * preview.trial_seconds /
                                 static_cast<double>(preview.trial_steps);
  }
  preview.memory = peak_memory();
  return preview;
}

}  // namespace talus
