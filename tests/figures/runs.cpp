#include "figures/runs.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus::figures {
namespace {

std::size_t output_before(const std::vector<double>& times, double at) {
  const auto after = std::upper_bound(times.begin(), times.end(), at);
  const auto index = static_cast<std::size_t>(after - times.begin());
  return std::clamp<std::size_t>(index, 1, times.size() - 1) - 1;
}

}  // namespace

Registry& registry() {
  static Registry all = [] {
    Registry made;
    const std::filesystem::path folder = TALUS_PLUGINS;
    load_folders(made, {&folder, 1});
    return made;
  }();
  return all;
}

Scene shipped(const std::string& name, const std::vector<Override>& overrides) {
  return read_scene(std::filesystem::path(TALUS_SCENES) / (name + ".json"), registry(), {overrides});
}

Scene from_text(const std::string& text, const std::vector<Override>& overrides) {
  return read_scene_text(text, "scene.json", registry(), {overrides});
}

double Course::speed(double at) const {
  const std::size_t i = output_before(time, at);
  const auto size = [&](std::size_t k) { return std::hypot(motion[k].velocity.x, motion[k].velocity.y); };
  const double share = (at - time[i]) / (time[i + 1] - time[i]);
  return (1 - share) * size(i) + share * size(i + 1);
}

Vec2 Course::displacement(double at) const {
  const std::size_t i = output_before(time, at);
  return (at - time[i] < time[i + 1] - at ? motion[i] : motion[i + 1]).displacement;
}

double Course::moved_between(double from, double to) const {
  const Vec2 start = displacement(from);
  double largest = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < from || time[i] > to) continue;
    largest =
        std::max(largest, std::hypot(motion[i].displacement.x - start.x, motion[i].displacement.y - start.y));
  }
  return largest;
}

std::uint32_t body_number(const Scene& scene, const std::string& name) {
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name == name) return i;
  }
  throw std::logic_error("no body '" + name + "'");
}

Course run(const Scene& scene, const std::string& body, const RunSettings& settings,
           const std::function<void(const Simulation&)>& watch) {
  const std::uint32_t number = body_number(scene, body);
  Simulation simulation(scene, settings);
  simulation.settle();
  Course course;
  while (simulation.advance()) {
    course.time.push_back(simulation.time());
    course.motion.push_back(simulation.body_motion(number));
    if (watch) watch(simulation);
  }
  return course;
}

std::string trouble(const Scene& scene) {
  try {
    Simulation simulation(scene, {});
    while (simulation.advance()) {
    }
  } catch (const NumericalTrouble& problem) {
    return problem.what();
  }
  return "";
}

std::string hash_after(const Scene& scene, const RunSettings& settings) {
  Simulation simulation(scene, settings);
  simulation.settle();
  while (simulation.advance()) {
  }
  return simulation.state_hash();
}

}  // namespace talus::figures
