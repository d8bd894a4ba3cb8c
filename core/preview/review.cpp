#include "model/laid_cover.hpp"
#include "preview/preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr double few_rows = 1000;  ///< which cost nothing that anybody would notice

bool acts(const VectorFunction& function) {
  return !function[0].zero() || !function[1].zero();
}

bool moves_something(const StageSettings& settings) {
  return settings.gravity.x != 0 || settings.gravity.y != 0 || acts(settings.base_acceleration) ||
         !settings.loads.empty() || !settings.surface_loads.empty() || !settings.prescribed.empty() ||
         std::any_of(settings.supports.begin(), settings.supports.end(),
                     [](const Support& support) { return support.drives(); });
}

void review_motion(const Scene& scene, std::vector<std::string>& raised) {
  const auto& bodies = scene.bodies;
  if (std::all_of(bodies.begin(), bodies.end(), [](const SceneBody& body) { return body.fixed; })) {
    raised.emplace_back("nothing moves: every body is fixed");
    return;
  }
  const bool starts = std::any_of(bodies.begin(), bodies.end(), [](const SceneBody& body) {
    return body.velocity.x != 0 || body.velocity.y != 0 || body.angular_velocity != 0;
  });
  const bool later = std::any_of(scene.stages.begin(), scene.stages.end(),
                                 [](const Stage& stage) { return moves_something(stage.settings); });
  if (starts || later || moves_something(settings_of(scene))) return;
  raised.emplace_back(
      "nothing moves: there is no gravity, velocity, load, drive, prescribed surface or motion of the "
      "ground");
}

void review_gravity(const Scene& scene, std::vector<std::string>& raised) {
  if (scene.gravity.y > 0 && scene.gravity.y > std::abs(scene.gravity.x)) {
    raised.push_back(
        fmt::format("gravity points up: [{:.4g}, {:.4g}] m/s2", scene.gravity.x, scene.gravity.y));
  }
  if (scene.settle && !moves_something(settings_of(scene)))
    raised.emplace_back("nothing loads the scene while it settles: there is no gravity and no load");
}

/// A scene of many bodies that nothing holds: a drawing whose base was forgotten.
void review_hold(const Scene& scene, std::vector<std::string>& raised) {
  const StageSettings settings = settings_of(scene);
  const bool held = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                [](const SceneBody& body) { return body.fixed; }) ||
                    std::any_of(settings.supports.begin(), settings.supports.end(),
                                [](const Support& support) { return support.any(); }) ||
                    !settings.prescribed.empty() || !settings.absorbing.empty();
  if (held || scene.bodies.size() < 2 || (settings.gravity.x == 0 && settings.gravity.y == 0)) return;
  raised.emplace_back("all bodies fall together: none is fixed, supported or driven");
}

void review_output(const Scene& scene, double dt, std::vector<std::string>& raised) {
  const OutputSettings& output = scene.output;
  if (scene.monitors.empty())
    raised.emplace_back("there is no monitor: history.csv will hold the time alone");
  const bool many = scene.time.end / output.history > few_rows;
  if (many && std::isfinite(dt) && output.history < dt * (1 - 1e-9)) {
    raised.push_back(fmt::format(
        "/output/history {:.4g} s is shorter than the step {:.4g} s that would do: each row costs a "
        "step of its own",
        output.history, dt));
  }
  if (output.history > scene.time.end) {
    raised.push_back(
        fmt::format("/time/end {:.4g} s is less than one interval of /output/history, {:.4g} s: "
                    "there will be a row at the start and one at the end",
                    scene.time.end, output.history));
  } else if (output.frames && *output.frames > scene.time.end) {
    raised.push_back(
        fmt::format("/time/end {:.4g} s is less than one interval of /output/frames, {:.4g} s: "
                    "there will be a frame at the start and one at the end",
                    scene.time.end, *output.frames));
  }
}

/// A record that begins when the run has ended, or in other units of time, never acts.
void review_loads(const Scene& scene, std::vector<std::string>& raised) {
  const auto look = [&](const Function& function, const std::string& pointer) {
    if (function.zero() || !function.zero_during(0, scene.time.end)) return;
    raised.push_back(fmt::format("{} is 0 until /time/end, {:.4g} s", pointer, scene.time.end));
  };
  for (const Function& along : scene.base_acceleration) look(along, "/base_acceleration");
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    for (const Function& along : scene.loads[i].force) look(along, fmt::format("/loads/{}/force", i));
  }
  for (std::size_t i = 0; i < scene.surface_loads.size(); ++i) {
    const SurfaceLoad& load = scene.surface_loads[i];
    for (const Function& along : load.traction) look(along, fmt::format("/surface_loads/{}/traction", i));
    look(load.pressure, fmt::format("/surface_loads/{}/pressure", i));
  }
}

/// A body at the top of its flight is slow, and nothing but gravity accelerates it.
void review_sleep(const Scene& scene, std::vector<std::string>& raised) {
  const double pull = std::hypot(scene.gravity.x, scene.gravity.y);
  if (!scene.sleep || pull == 0 || scene.sleep->acceleration < pull) return;
  raised.push_back(fmt::format(
      "/sleep/acceleration {:.4g} m/s2 is not below gravity, {:.4g} m/s2: bodies that fall slowly "
      "are put to sleep in the air",
      scene.sleep->acceleration, pull));
}

void review_use(const Scene& scene, std::vector<std::string>& raised) {
  std::vector<bool> used(scene.materials.size());
  for (const SceneBody& body : scene.bodies) used[body.material] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) raised.push_back(fmt::format("no body is of the material '{}'", scene.materials[i].name));
  }
}

/// How many patches the body's cover has without one of its discontinuities.
std::size_t patches_without(SceneBody body, const Body& laid, std::size_t discontinuity) {
  body.discontinuities.erase(body.discontinuities.begin() + static_cast<std::ptrdiff_t>(discontinuity));
  return lay_cover(body, laid).patches.size();
}

void review_discontinuities(const Scene& scene, std::vector<std::string>& raised) {
  const auto is_cut = [](const SceneBody& body) { return !body.discontinuities.empty(); };
  if (std::none_of(scene.bodies.begin(), scene.bodies.end(), is_cut)) return;
  const Model model = build_model(scene);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    if (!is_cut(body)) continue;
    const std::size_t patches = lay_cover(body, model.bodies[i]).patches.size();
    for (std::size_t cut = 0; cut < body.discontinuities.size(); ++cut) {
      if (patches_without(body, model.bodies[i], cut) != patches) continue;
      raised.push_back(fmt::format(
          "/bodies/{}/discontinuities/{} cuts nothing of '{}': it lies outside, or within a patch of "
          "the cover; take smaller elements",
          i, cut, body.name));
    }
  }
}

}  // namespace

std::vector<std::string> review(const Scene& scene, double dt) {
  std::vector<std::string> raised;
  review_motion(scene, raised);
  review_gravity(scene, raised);
  review_hold(scene, raised);
  review_output(scene, dt, raised);
  review_loads(scene, raised);
  review_sleep(scene, raised);
  review_use(scene, raised);
  question_units(scene, raised);
  question_bonds(scene, raised);
  review_discontinuities(scene, raised);
  return raised;
}

}  // namespace talus
