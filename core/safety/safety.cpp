#include "safety/safety.hpp"

#include "plugin/parameters.hpp"
#include "safety/collapse.hpp"
#include "safety/strength.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace talus {
namespace {

constexpr double stride = 1.25;  ///< of the factor, while neither bound is known
constexpr int looks = 8;         ///< at what moves, in half of the time that the scene lasts
constexpr int longest = 8;       ///< times as long as the scene says a run goes on to be told
/// A body that goes on so slowly that a run would have to be so many times as long once more is named.
constexpr double last_look = 4;
constexpr double jammed = 0.01;  ///< of its width: what comes so far and rests has met something

/// Cosine of what the normals of contacts on one face of a body differ by.
constexpr double one_face = 0.9;

class Reduction {
 public:
  Reduction(const Scene& scene, const SafetySettings& settings) : scene_(scene), settings_(settings) {
    scene_.output.frames.reset();
    scene_.output.history = scene_.time.end / (2 * looks);
    hold_loads();
    scene_.time.end *= longest;
    run_.threads = settings.threads;
    Simulation whole(with_reduced_strength(scene_, 1), run_);
    const bool as_drawn = may_bond(scene_);
    const Pieces drawn(whole);
    const std::vector<Vec2> began = drawn.places(whole);
    if (as_drawn) stand(whole);
    settled_ = whole.settle(settings_.interrupted);
    warnings_ = whole.summary().warnings;
    if (!as_drawn) {
      warn_of_gone(drawn.gone(drawn.motions(whole, began)));
      stand(whole);
    }
    warn_of_locking(whole);
    warn_of_brittle_bonds(whole.deepest_overlap().penetration);
    geometry_ = whole.geometry();
    warn_of_short_runs();
    warn_of_held_friction(whole);
  }

  bool settled() const { return settled_; }
  bool of_what_is_left() const { return of_what_is_left_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Nothing if it was interrupted.
  std::optional<ReducedRun> run(double factor) const {
    Simulation simulation(with_reduced_strength(scene_, factor), run_);
    ReducedRun result;
    result.factor = factor;
    if (scene_.settle) simulation.take_geometry(geometry_);
    try {
      if (!simulation.settle(settings_.interrupted)) return std::nullopt;
      if (!follow(simulation, result)) return std::nullopt;
      if (result.collapsed) result.parts = moved_parts(simulation);
    } catch (const NumericalTrouble& trouble) {
      result.trouble = trouble.what();
      result.collapsed = true;
    }
    return result;
  }

 private:
  /// Runs that go on for longer than the scene lasts see no loads that it does not have.
  void hold_loads() {
    const double end = scene_.time.end;
    double last_change = -std::numeric_limits<double>::infinity();
    const auto hold = [&](Function& function) {
      function = function.held_from(end);
      last_change = std::max(last_change, function.last_change());
    };
    for (PointLoad& load : scene_.loads) std::ranges::for_each(load.force, hold);
    for (SurfaceLoad& load : scene_.surface_loads) {
      std::ranges::for_each(load.traction, hold);
      hold(load.pressure);
    }
    for (const Function& ground : scene_.base_acceleration)
      last_change = std::max(last_change, ground.last_change());
    loads_change_late_ = last_change > end / 2;
  }

  /// All runs start from there, and motions count from it.
  void stand(const Simulation& simulation) {
    stood_ = parts_of(simulation);
    pieces_.emplace(simulation);
  }

  /// What fell before there was a geometry to fall from stands all the better where it lies.
  void warn_of_gone(const std::vector<std::size_t>& bodies) {
    if (bodies.empty()) return;
    of_what_is_left_ = true;
    std::vector<std::string> names;
    for (const std::size_t body : bodies) names.push_back(scene_.bodies[body].name);
    warnings_.push_back(fmt::format(
        "with its full strength this moved by a twentieth of its width or more while the scene settled: the "
        "factor is of what lies there then, that of the scene as it is drawn may be below 1: {}",
        listed(names)));
  }

  /// Bonds that soften too soon are gone before friction has come to its limit: the two are never there
  /// together, as limit equilibrium has them. Friction of μp over a cohesion of c is late by (μp − c)/α_T,
  /// and c has lost as much of its softening by then.
  void warn_of_brittle_bonds(double penetration) {
    constexpr double enough = 10;  // of the slip at which a bond has all of its strength
    constexpr double late = 100;   // of the slip by which friction is late
    double wanted = 0;
    for (const std::vector<double>& values : scene_.interface_values) {
      const double cohesion = value_of(values, "cohesion"),
                   stiffness = value_of(values, "tangential_stiffness"),
                   friction = std::tan(value_of(values, "friction_angle")) *
                              value_of(values, "normal_stiffness") * penetration;
      const double due = std::max(enough * cohesion, late * (friction - cohesion)) / stiffness;
      if (cohesion > 0 && std::isfinite(due) && value_of(values, "softening_slip") < due)
        wanted = std::max(wanted, due);
    }
    if (wanted == 0) return;
    const double digit = std::pow(10, std::floor(std::log10(wanted)) - 1);  // the second
    wanted = digit * std::ceil(wanted / digit * (1 - 1e-9));
    warnings_.push_back(fmt::format(
        "cohesion of an interface is lost where it breaks before friction bears its part: the factor "
        "may be below that of limit equilibrium; `cohesive_overlap` with a softening_slip of {:.2g} m "
        "or more, ten times cohesion/tangential_stiffness and a hundred times by what friction is more than "
        "cohesion, brings it nearer",
        wanted));
  }

  /// What friction bears of a body on one of its faces, held without limit, comes upon the bonds of another
  /// when it is let go.
  void warn_of_held_friction(Simulation& whole) {
    const auto bonded = [&](const std::vector<double>& values) { return value_of(values, "cohesion") > 0; };
    if (!scene_.settle || !scene_.settle->hold_stick || std::ranges::none_of(scene_.interface_values, bonded))
      return;
    try {
      whole.advance(settings_.interrupted);
    } catch (const NumericalTrouble&) {
      return;  // told where the runs meet it
    }
    std::vector<std::optional<Vec2>> face(scene_.bodies.size());
    for (const Contact& contact : whole.contacts()) {
      const double size = size_of(contact.normal_force);
      if (size == 0 || !(contact.penetration > 0)) continue;  // a bond that pulls points the other way
      const Vec2 normal = contact.normal_force / size;
      for (const auto& [body, sign] : {std::pair{contact.body_a, -1.0}, {contact.body_b, 1.0}}) {
        if (scene_.bodies[body].fixed) continue;
        const Vec2 out = sign * normal;
        if (!face[body]) face[body] = out;
        if (out.x * face[body]->x + out.y * face[body]->y > one_face) continue;
        warnings_.push_back(fmt::format(
            "'{}' stands on several faces, and friction is held without limit while the scene settles: what "
            "it lets go of at t = 0 comes upon bonds at once, and the factor may be less than that of limit "
            "equilibrium, by a tenth and more; see what it is with /settle/hold_stick = false",
            scene_.bodies[body].name));
        return;
      }
    }
  }

  /// A parameter of an interface by its key; 0 where the law has none.
  double value_of(const std::vector<double>& values, std::string_view key) const {
    if (scene_.contact.component == nullptr) return 0;
    const Component& law = *scene_.contact.component->component;
    const auto index = index_of({law.interface_parameters, law.interface_parameter_count}, key);
    return index ? values[*index] : 0;
  }

  /// What lacks a share of its strength gains at most that share of gravity, and is held up by `damping`.
  void warn_of_short_runs() {
    const double gravity = std::hypot(scene_.gravity.x, scene_.gravity.y), damping = constant_damping();
    if (!(gravity > 0)) return;
    const double pull = settings_.tolerance * gravity, wanted = pieces_->time_to_tell(pull, damping);
    if (scene_.time.end >= wanted) return;
    const bool held_up = scene_.time.end >= pieces_->time_to_tell(pull, 0);
    warnings_.push_back(
        fmt::format("runs of up to {:.3g} s are too short to see a body fail that lacks {:.3g} % of its "
                    "strength{}: the factor may be less; give it a /time/end of {:.2g} s at least{}",
                    scene_.time.end, 100 * settings_.tolerance,
                    held_up ? fmt::format(" where /damping of {:.3g} 1/s holds it up", damping) : "",
                    1.1 * wanted / longest, held_up ? ", or less damping" : ""));
  }

  /// 1/s, of the run; kinetic damping, which takes velocities at their peaks, holds nothing up for long.
  double constant_damping() const {
    return scene_.damping.kind == Damping::Kind::constant ? scene_.damping.constant : 0;
  }

  void warn_of_locking(const Simulation& whole) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const SceneBody& body = scene_.bodies[i];
      Choice model = scene_.materials[body.material].model;
      if (!body.fixed && whole.fragments(i).size() > 1 && reduce(model, 1)) names.push_back(body.name);
    }
    if (names.empty()) return;
    warnings_.push_back(
        fmt::format("triangles of constant strain lock where they yield: a factor of bodies of many elements "
                    "that yield is too high, the more so the coarser they are; see where it goes with their "
                    "size: {}",
                    listed(names)));
  }

  /// Where the parts of all bodies are.
  std::vector<MovedPart> parts_of(const Simulation& simulation) const {
    std::vector<MovedPart> parts;
    for (std::size_t body = 0; body < scene_.bodies.size(); ++body) {
      for (const BodyPart& part : simulation.parts(body)) {
        MovedPart& one = parts.emplace_back(MovedPart{body, {}});
        for (const std::vector<PartPoint>& loop : part.loops) {
          auto& points = one.loops.emplace_back();
          for (const PartPoint& p : loop) points.push_back({p.position, {0, 0}});
        }
      }
    }
    return parts;
  }

  /// Where they stood with full strength, and how far they have come from there.
  std::vector<MovedPart> moved_parts(const Simulation& simulation) const {
    std::vector<MovedPart> parts = parts_of(simulation);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t l = 0; l < parts[i].loops.size(); ++l) {
        for (std::size_t p = 0; p < parts[i].loops[l].size(); ++p) {
          MovedPart::Point& point = parts[i].loops[l][p];
          const Vec2 from = stood_[i].loops[l][p].from;
          point = {from, point.from - from};
        }
      }
    }
    return parts;
  }

  /// Until it is clear whether it stands, each time twice as long as before. False if it was interrupted.
  bool follow(Simulation& simulation, ReducedRun& result) const {
    const auto next = [&] { return simulation.advance(settings_.interrupted) && simulation.history_due(); };
    if (!next()) return false;  // t = 0
    const std::vector<Vec2> began = pieces_->places(simulation);
    PieceMotions middle, end = pieces_->motions(simulation, began);
    const auto advance = [&](int halves) {
      for (int i = 0; i < halves * looks; ++i) {
        if (!next()) return false;
        PieceMotions now = pieces_->motions(simulation, began);
        std::ranges::transform(now.way, end.farthest, now.farthest.begin(),
                               [](double here, double before) { return std::max(here, before); });
        end = std::move(now);
      }
      return true;
    };
    // What follows a load that still grows goes on, too: whether it does without is seen after the end.
    int times = loads_change_late_ ? 2 : 1;
    if (!advance(times)) return false;
    for (;; times *= 2) {
      middle = end;
      if (!advance(times)) return false;
      const double to_tell = judge(middle, end, static_cast<double>(longest) / times, result);
      result.lasted = simulation.time();
      result.kinetic = simulation.ledger().kinetic;
      if (result.collapsed || times == longest || to_tell * times > longest) return true;
    }
  }

  /// Returns how many times as long it would have to last to tell of the body that goes on fastest.
  double judge(const PieceMotions& middle, const PieceMotions& end, double longer, ReducedRun& result) const {
    result.moving_little.clear();
    result.came_to_rest.clear();
    const auto add = [](std::vector<std::size_t>& bodies, std::size_t body) {
      if (bodies.empty() || bodies.back() != body) bodies.push_back(body);
    };
    double least = std::numeric_limits<double>::infinity();
    bool goes_on = false;
    std::vector<std::size_t> beside;  // come as far, but slow down at present: part of what fails
    for (std::size_t i = 0; i < pieces_->all().size(); ++i) {
      const std::size_t body = pieces_->all()[i].body;
      if (end.moved[i] > result.displacement) {
        result.displacement = end.moved[i];
        result.body = body;
      }
      const Course course = pieces_->course(i, middle, end, longer == 1);
      if (course == Course::rests && end.moved[i] > jammed * pieces_->all()[i].size)
        add(result.came_to_rest, body);
      if (course == Course::failed || course == Course::stopped) add(result.moving, body);
      goes_on = goes_on || course == Course::failed;
      if (course != Course::goes_on) continue;
      const double to_tell = pieces_->times_to_tell(i, end);
      least = std::min(least, to_tell);
      if (to_tell <= 1) add(beside, body);
      if (to_tell < last_look * longer) add(result.moving_little, body);
    }
    result.collapsed = !result.moving.empty();
    if (result.collapsed) {
      const auto failing = result.moving;
      result.moving.clear();
      std::ranges::set_union(failing, beside, std::back_inserter(result.moving));
    }
    result.stands_again = result.collapsed && !goes_on;
    return least;
  }

  Scene scene_;
  const SafetySettings& settings_;
  RunSettings run_;
  Geometry geometry_;
  std::vector<MovedPart> stood_;
  std::optional<Pieces> pieces_;
  bool settled_ = false, of_what_is_left_ = false, loads_change_late_ = false;
  std::vector<std::string> warnings_;
};

}  // namespace

std::optional<double> Safety::factor() const {
  if (!stands || !falls) return std::nullopt;
  return (*stands + *falls) / 2;
}

std::string trouble_of_runs(const std::vector<ReducedRun>& runs) {
  const auto stopped = [](const ReducedRun& run) { return !run.trouble.empty(); };
  const auto of_themselves = std::find_if_not(runs.rbegin(), runs.rend(), stopped);
  if (of_themselves == runs.rbegin()) return "";
  return fmt::format(
      "runs with {:.3g} to {:.3g} times the strength are all stopped, which says nothing of safety: {}",
      1 / of_themselves.base()->factor, 1 / runs.back().factor, runs.back().trouble);
}

Safety factor_of_safety(const Scene& scene, const SafetySettings& settings) {
  Safety safety;
  const Reduction reduction(scene, settings);
  safety.interrupted = !reduction.settled();
  safety.warnings = reduction.warnings();
  safety.of_what_is_left = reduction.of_what_is_left();
  double next = 1;
  while (!safety.interrupted) {
    const std::optional<ReducedRun> run = reduction.run(next);
    if (!run) {
      safety.interrupted = true;
      break;
    }
    if (run->collapsed) {
      for (ReducedRun& before : safety.runs) before.parts.clear();  // at a larger factor: of no more use
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
  if (!safety.interrupted && !safety.stands) safety.trouble = trouble_of_runs(safety.runs);
  if (!safety.trouble.empty() && scene.settle && !may_bond(scene))
    safety.trouble += "; all start from what the scene settles to with its own strength";
  return safety;
}

}  // namespace talus
