#include "verification/free_bar.hpp"

#include "verification/course.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace talus::verification {

Scene free_bar(const Bench& bench, const std::string& cover, const std::string& shape) {
  std::string wave;
  constexpr int pieces = 100;
  for (int i = 0; i <= pieces; ++i) {
    const double x = -5 + 10.0 * i / pieces;
    wave += fmt::format("{}[{:.17g}, {:.17g}]", i > 0 ? ", " : "", x, std::sin(std::numbers::pi * x / 10));
  }
  const std::string load = fmt::format(R"("traction": [{{"scale": 1e5, "x": [{}]}}, 0])", wave);
  return bench.from_text(fmt::format(
      R"({{"talus": 1,
          "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0}}}},
          "cover": {0}, "bodies": [{{"name": "bar", "material": "rock", {1}}}],
          "surface_loads": [{{"body": "bar", "surface": "top", {2}}}, {{"body": "bar", "surface": "bottom", {2}}}],
          "settle": {{"duration": 0.05, "damping": "adaptive"}},
          "stages": [{{"name": "free", "from": 2e-4, "set": {{"/surface_loads": []}}}}],
          "time": {{"end": 0.1002, "safety": 0.2}}, "output": {{"history": 2e-4}}}})",
      cover, shape, load));
}

double first_frequency(const Scene& scene) {
  std::vector<double> time, share, zeros;
  run_through(scene, {}, [&](const Simulation& simulation) {
    double sum = 0;
    for (int i = 0; i < 40; ++i) {
      const double x = -5 + 10 * (i + 0.5) / 40;
      sum += std::sin(std::numbers::pi * x / 10) * (simulation.point_motion(0, {x, 0}).position.x - x);
    }
    time.push_back(simulation.time());
    share.push_back(sum);
  });
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (share[i - 1] * share[i] >= 0) continue;
    zeros.push_back(time[i - 1] + (time[i] - time[i - 1]) * share[i - 1] / (share[i - 1] - share[i]));
  }
  return zeros.size() < 2 ? std::nan("")
                          : static_cast<double>(zeros.size() - 1) / 2 / (zeros.back() - zeros.front());
}

}  // namespace talus::verification
