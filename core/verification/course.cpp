#include "verification/course.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus::verification {
namespace {

std::size_t output_before(const std::vector<double>& times, double at) {
  const auto after = std::upper_bound(times.begin(), times.end(), at);
  const auto index = static_cast<std::size_t>(after - times.begin());
  return std::clamp<std::size_t>(index, 1, times.size() - 1) - 1;
}

}  // namespace

double magnitude(Vec2 v) {
  return std::hypot(v.x, v.y);
}

double Course::speed(double at) const {
  const std::size_t i = output_before(time, at);
  const double share = (at - time[i]) / (time[i + 1] - time[i]);
  return (1 - share) * magnitude(motion[i].velocity) + share * magnitude(motion[i + 1].velocity);
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
    const Vec2 now = motion[i].displacement;
    largest = std::max(largest, std::hypot(now.x - start.x, now.y - start.y));
  }
  return largest;
}

std::size_t Course::fastest() const {
  const auto slower = [](const Motion& p, const Motion& q) {
    return magnitude(p.velocity) < magnitude(q.velocity);
  };
  return static_cast<std::size_t>(std::max_element(motion.begin(), motion.end(), slower) - motion.begin());
}

std::uint32_t body_number(const Scene& scene, const std::string& name) {
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name == name) return i;
  }
  throw std::logic_error("no body '" + name + "'");
}

RunSummary run_through(const Scene& scene, const RunSettings& settings, const Watch& watch) {
  Simulation simulation(scene, settings);
  simulation.settle();
  while (simulation.advance()) {
    if (watch) watch(simulation);
  }
  return simulation.summary();
}

Course run(const Scene& scene, const std::string& body, const RunSettings& settings, const Watch& watch) {
  const std::uint32_t number = body_number(scene, body);
  Course course;
  run_through(scene, settings, [&](const Simulation& simulation) {
    course.time.push_back(simulation.time());
    course.motion.push_back(simulation.body_motion(number));
    if (watch) watch(simulation);
  });
  return course;
}

std::string trouble_of(const Scene& scene) {
  try {
    run_through(scene);
  } catch (const NumericalTrouble& problem) {
    return problem.what();
  }
  return "";
}

std::string hash_after(const Scene& scene, const RunSettings& settings) {
  std::string hash;
  run_through(scene, settings, [&](const Simulation& simulation) {
    if (simulation.time() >= simulation.scene().time.end) hash = simulation.state_hash();
  });
  return hash;
}

}  // namespace talus::verification
