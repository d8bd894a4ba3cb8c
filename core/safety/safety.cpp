#include "safety/safety.hpp"

#include "output/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace talus {
namespace {

constexpr double seen = 1e-3;    ///< share of the width
constexpr double lost = 0.05;    ///< share of the width: whatever stops further on has failed, too
constexpr double stride = 1.25;  ///< of the factor, while neither bound is known

/// Divides what of these values is strength; returns whether any is.
bool reduce(const Parameter* parameters, std::uint32_t count, double factor, std::vector<double>& values) {
  bool reduced = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string_view key = parameters[i].key;
    if (key == "friction_angle") {
      reduced = reduced || values[i] > 0;
      values[i] = std::atan(std::tan(values[i]) / factor);
    } else if (key == "cohesion" || key == "tensile_strength") {
      reduced = reduced || values[i] > 0;
      values[i] /= factor;
    }
  }
  // Rock that has less friction dilates no more than that allows.
  const auto value_of = [&](std::string_view key) -> double* {
    for (std::uint32_t i = 0; i < count; ++i) {
      if (key == parameters[i].key) return &values[i];
    }
    return nullptr;
  };
  const double* const friction = value_of("friction_angle");
  double* const dilation = value_of("dilation_angle");
  if (friction != nullptr && dilation != nullptr) *dilation = std::min(*dilation, *friction);
  return reduced;
}

/// Of each body, its vertices.
using Shape = std::vector<std::vector<Motion>>;

Shape shape_of(const Simulation& simulation) {
  Shape shape;
  const Scene& scene = simulation.scene();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    std::vector<Motion>& vertices = shape.emplace_back();
    for (const Vec2 vertex : scene.bodies[i].outer.vertices)
      vertices.push_back(simulation.point_motion(i, vertex));
  }
  return shape;
}

/// Of each body: how far the vertex has moved that moved farthest, and the largest speed of one.
struct Instant {
  std::vector<double> moved, speed;
};

Instant instant_of(const Simulation& simulation, const Shape& from) {
  Instant instant;
  const Shape now = shape_of(simulation);
  for (std::size_t i = 0; i < now.size(); ++i) {
    double moved = 0, speed = 0;
    for (std::size_t k = 0; k < now[i].size(); ++k) {
      const Vec2 p = now[i][k].position, q = from[i][k].position, v = now[i][k].velocity;
      moved = std::max(moved, std::hypot(p.x - q.x, p.y - q.y));
      speed = std::max(speed, std::hypot(v.x, v.y));
    }
    instant.moved.push_back(moved);
    instant.speed.push_back(speed);
  }
  return instant;
}

class Reduction {
 public:
  Reduction(const Scene& scene, const SafetySettings& settings) : scene_(scene), settings_(settings) {
    scene_.output.frames.reset();
    scene_.output.history = scene_.time.end / 2;
    run_.threads = settings.threads;
    Simulation whole(with_reduced_strength(scene_, 1), run_);
    settled_ = whole.settle(settings_.interrupted);
    geometry_ = whole.geometry();
    settled_shape_ = shape_of(whole);
  }

  bool settled() const { return settled_; }

  /// Nothing if it was interrupted.
  std::optional<ReducedRun> run(double factor) const {
    Simulation simulation(with_reduced_strength(scene_, factor), run_);
    ReducedRun result;
    result.factor = factor;
    if (scene_.settle) simulation.take_geometry(geometry_);
    try {
      if (!simulation.settle(settings_.interrupted)) return std::nullopt;
      const auto advance = [&] {
        return simulation.advance(settings_.interrupted) && simulation.history_due();
      };
      if (!advance() || !advance()) return std::nullopt;
      const Instant middle = instant_of(simulation, settled_shape_);
      if (!advance()) return std::nullopt;
      judge(simulation, middle, result);
    } catch (const NumericalTrouble& trouble) {
      result.trouble = trouble.what();
      result.collapsed = true;
    }
    return result;
  }

 private:
  void judge(const Simulation& simulation, const Instant& middle, ReducedRun& result) const {
    const Instant end = instant_of(simulation, settled_shape_);
    for (std::size_t i = 0; i < end.moved.size(); ++i) {
      if (scene_.bodies[i].fixed) continue;
      if (end.moved[i] > result.displacement) {
        result.displacement = end.moved[i];
        result.body = i;
      }
      const double width = simulation.body_width(i);
      const bool goes_on =
          end.moved[i] - middle.moved[i] > end.moved[i] / 2 && end.speed[i] >= middle.speed[i];
      if (end.moved[i] > lost * width || (end.moved[i] > seen * width && goes_on)) result.moving.push_back(i);
    }
    result.kinetic = simulation.ledger().kinetic;
    result.collapsed = !result.moving.empty();
  }

  Scene scene_;
  const SafetySettings& settings_;
  RunSettings run_;
  Geometry geometry_;
  Shape settled_shape_;
  bool settled_ = false;
};

}  // namespace

Scene with_reduced_strength(const Scene& scene, double factor) {
  Scene reduced = scene;
  reduced.stages.clear();
  bool any = false;
  if (const RegisteredComponent* law = scene.contact.component; law != nullptr) {
    for (std::vector<double>& row : reduced.interface_values)
      any = reduce(law->component->interface_parameters, law->component->interface_parameter_count, factor,
                   row) ||
            any;
  }
  for (SceneMaterial& material : reduced.materials) {
    if (const RegisteredComponent* model = material.model.component; model != nullptr)
      any = reduce(model->component->parameters, model->component->parameter_count, factor,
                   material.model.values) ||
            any;
  }
  if (!any)
    throw InputError(
        "no interface and no material of the scene has friction, cohesion or tensile strength to reduce");
  return reduced;
}

std::optional<double> Safety::factor() const {
  if (!stands || !falls) return std::nullopt;
  return (*stands + *falls) / 2;
}

Safety factor_of_safety(const Scene& scene, const SafetySettings& settings) {
  Safety safety;
  const Reduction reduction(scene, settings);
  safety.interrupted = !reduction.settled();
  double next = 1;
  while (!safety.interrupted) {
    const std::optional<ReducedRun> run = reduction.run(next);
    if (!run) {
      safety.interrupted = true;
      break;
    }
    safety.runs.push_back(*run);
    if (settings.tried) settings.tried(*run);
    (run->collapsed ? safety.falls : safety.stands) = next;
    if (safety.stands && safety.falls) {
      if (*safety.falls - *safety.stands <= settings.tolerance * *safety.stands) break;
      next = (*safety.stands + *safety.falls) / 2;
    } else {
      next = run->collapsed ? next / stride : next * stride;
      if (next < settings.lowest || next > settings.highest) break;
    }
  }
  const auto stopped = [](const ReducedRun& run) { return !run.trouble.empty(); };
  if (!safety.interrupted && !safety.stands && std::ranges::all_of(safety.runs, stopped)) {
    throw NumericalTrouble(
        fmt::format("runs are stopped however strong the scene is, which says nothing of its safety: {}",
                    safety.runs.back().trouble));
  }
  return safety;
}

}  // namespace talus
