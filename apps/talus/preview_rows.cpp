#include "preview_rows.hpp"

#include "progress.hpp"

#include <fmt/format.h>

namespace talus {

namespace {

constexpr double too_soft = 0.1, may_flutter = 1, may_walk = 5, needlessly_stiff = 10;  ///< E/h
constexpr double rounding = 1e-9;

std::string in_bytes(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.3g} kB", bytes / 1e3);
  return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

std::string in_seconds(double seconds) {
  return seconds < 60 ? fmt::format("{:.2g} s", seconds) : clock_text(seconds);
}

void print_start(const Scene& scene, const Preview& foreseen) {
  print_row("edges", fmt::format("the smallest is {:.4g} m, of '{}'", foreseen.smallest_edge,
                                 scene.bodies[foreseen.smallest_edge_body].name));
  std::string deepest;
  if (foreseen.overlap > 0) {
    deepest = fmt::format(", the deepest {:.3g} m between '{}' and '{}'", foreseen.overlap,
                          scene.bodies[foreseen.overlap_a].name, scene.bodies[foreseen.overlap_b].name);
  }
  print_row("at t = 0", fmt::format("{} candidate pairs, {} contacts{}{}", foreseen.pairs, foreseen.contacts,
                                    deepest, scene.settle ? ", not settled yet" : ""));
}

std::string share_text(const Scene& scene, const StiffnessShare& share) {
  return fmt::format("{:.3g} Pa/m of /interfaces/{} is {:.3g} E/h of '{}' (E {:.3g} Pa, h {:.3g} m)",
                     share.stiffness, share.row, share.share(), scene.bodies[share.body].name, share.young,
                     share.width);
}

void print_stiffness(const Scene& scene, const Preview& foreseen) {
  if (!foreseen.softest) return;
  const StiffnessShare &soft = *foreseen.softest, &stiff = *foreseen.stiffest;
  std::string words = share_text(scene, soft);
  if (soft.share() < too_soft * (1 - rounding)) {
    words += fmt::format(": soft, bodies sink into each other rather than deform; E/h is {:.3g} Pa/m",
                         soft.young / soft.width);
  }
  print_row("stiffness", words);
  if (stiff.share() > needlessly_stiff * (1 + rounding)) {
    print_row("", fmt::format("{}: stiff, which costs steps; 10 E/h is {:.3g} Pa/m", share_text(scene, stiff),
                              needlessly_stiff * stiff.young / stiff.width));
  }
}

void print_cost(const Scene& scene, const Preview& foreseen) {
  std::string steps = fmt::format("about {:.0f}{} of {:.6g} s", foreseen.steps,
                                  foreseen.stages.empty() ? "" : ", the first", foreseen.dt);
  if (scene.settle) steps += fmt::format(", and up to {:.0f} to settle", foreseen.settle_steps);
  print_row("steps", steps);
  if (!scene.time.dt && foreseen.dt_limiter.starts_with("speed"))
    print_row("limited by", foreseen.dt_limiter);
  print_row("run",
            foreseen.trial_steps == 0
                ? std::string("no estimate: the trial came to no step")
                : fmt::format("about {} on this machine, an estimate from {} steps in {:.2g} s with one "
                              "thread; {} of memory",
                              in_seconds(foreseen.estimated_seconds), foreseen.trial_steps,
                              foreseen.trial_seconds, in_bytes(static_cast<double>(foreseen.memory))));
}

}  // namespace

std::string words_of_flutter(const Scene& scene, const Preview& foreseen) {
  if (!foreseen.fluttering || !(foreseen.fluttering->share() > may_flutter * (1 + rounding))) return "";
  const StiffnessShare& stiff = *foreseen.fluttering;
  return fmt::format(
      "/interfaces/{} has friction and {:.3g} E/h of '{}', which has no damping_time: what slides may "
      "flutter, and be braked less than its friction{}; a damping_time of about {:.1g} s stills it",
      stiff.row, stiff.share(), scene.bodies[stiff.body].name,
      stiff.share() > may_walk ? ", and what sticks shudder and walk" : "", stiff.stilling);
}

void print_row(const std::string& label, const std::string& words) {
  fmt::print("  {:<10} {}\n", label, words);
}

void print_preview(const Scene& scene, const Preview& foreseen) {
  print_start(scene, foreseen);
  print_stiffness(scene, foreseen);
  if (const std::string words = words_of_flutter(scene, foreseen); !words.empty()) print_row("", words);
  print_cost(scene, foreseen);
  const std::string frames =
      scene.output.frames ? fmt::format("{} frames every {:.6g} s", foreseen.frames, *scene.output.frames)
                          : std::string("no frames");
  print_row("output", fmt::format("{} rows every {:.6g} s, {}: about {}", foreseen.rows, scene.output.history,
                                  frames, in_bytes(static_cast<double>(foreseen.bytes))));
}

}  // namespace talus
