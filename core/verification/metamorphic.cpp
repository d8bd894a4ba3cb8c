#include "archive/archive.hpp"
#include "verification/case.hpp"
#include "verification/course.hpp"
#include "verification/transform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

namespace talus::verification {
namespace {

/// A scene that is quick to run, and what it has that a relation cannot be asked of.
struct Sample {
  std::string name;
  Scene scene;
  bool free;        ///< nothing holds a body, nothing damps its motion as a whole
  bool reversible;  ///< rigid, without friction and damping, at a fixed step
  double apart;     ///< what rounding may part two runs by, share of the scene's extent
};

/// Round-off of coordinates, 1e-16, which stiff contacts magnify in some hundred steps. Where sides touch
/// without pressing (vaiont: all of them) rounding decides whether a dashpot acts from this step on or the
/// next.
constexpr double of_presses = 1e-10, of_touches = 1e-8;

/// Six free bodies that fly at each other, turn and rub.
std::string tumble_text(const std::string& law, const std::string& cover, const std::string& friction) {
  return fmt::format(
      R"({{"talus": 1, "materials": {{{}}}, "cover": {{"model": "{}"}}, "contact": {{"model": "{}"}},
    "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": {},
                    "normal_damping": 0, "tangential_damping": 0}}],
    "bodies": [
      {{"name": "a", "polygon": [[0, 0], [1, 0.1], [0.9, 1.2], [-0.1, 0.8]], "material": "rock", "velocity": [2, 1],
        "angular_velocity": 40}},
      {{"name": "b", "polygon": [[1.06, 0], [2.2, 0.1], [2, 1], [1.1, 0.9]], "material": "rock", "velocity": [-1, 0.5]}},
      {{"name": "c", "polygon": [[0.3, 1.31], [1.3, 1.31], [0.8, 2.2]], "material": "rock", "velocity": [0.3, -3],
        "angular_velocity": -90}},
      {{"name": "d", "polygon": [[-1.3, 0.1], [-0.3, 0.2], [-0.4, 1.0], [-1.2, 1.3]], "material": "rock", "velocity": [3, 0]}},
      {{"name": "e", "polygon": [[0.2, -1.2], [1.1, -1.1], [1.2, -0.2], [0.7, -0.08], [0.1, -0.3]], "material": "rock",
        "velocity": [0, 2]}},
      {{"name": "f", "polygon": [[1.5, 1.2], [2.4, 1.3], [2.2, 2.1]], "material": "rock", "velocity": [-2, -2],
        "angular_velocity": 200}}],
    "limits": {{"energy_residual": 1}}, "time": {{"end": 0.1, "dt": 2e-5}}, "output": {{"history": 0.01}}}})",
      rock_text, cover, law, friction);
}

std::vector<Sample> samples(const Bench& bench) {
  const auto shipped = [&](const std::string& name, double end, double history,
                           std::vector<Override> more = {}) {
    more.push_back({"/time/end", fmt::format("{}", end)});
    Sample sample{name, bench.shipped(name, more), false, false, name == "vaiont" ? of_touches : of_presses};
    sample.scene.output = {history, std::nullopt};
    return sample;
  };
  std::vector<Sample> all{
      shipped("incline", 0.05, 0.01),
      shipped("stick_31deg", 0.05, 0.01),
      shipped("incline_paper", 0.02, 0.005),
      shipped("collision", 1.1, 0.1),
      shipped("collision_unequal", 1.1, 0.1),
      shipped("column", 0.02, 0.005),
      shipped("brick_wall", 0.002, 0.0005),
      shipped("arch", 0.005, 0.001, {{"/settle/duration", "0.005"}}),
      shipped("four_blocks", 0.02, 0.005),
      shipped("contact_patch", 1e-4, 2e-5, {{"/settle/duration", "0.0005"}}),
      shipped("vaiont", 0.02, 0.01, {{"/settle/duration", "0.01"}, {"/time/safety", "0.2"}}),
  };
  for (Sample& sample : all) sample.free = sample.name.starts_with("collision");
  all.push_back(
      {"tumble", bench.from_text(tumble_text("overlap_area", "block", "30")), true, false, of_presses});
  all.push_back({"tumble of vertex_edge", bench.from_text(tumble_text("vertex_edge", "block", "30")), true,
                 false, of_presses});
  all.push_back(
      {"smooth tumble", bench.from_text(tumble_text("frictionless", "rigid", "0")), true, true, of_presses});
  Sample rigid = shipped("collision", 1.1, 0.1, {{"/cover/model", "rigid"}});
  rigid.name = "collision, rigid";
  rigid.free = rigid.reversible = true;
  all.push_back(std::move(rigid));
  return all;
}

/// Displacement and rotation of every body at every output time.
struct Track {
  std::vector<std::vector<Motion>> motion;  ///< [time][body]
};

Track track_of(const Scene& scene) {
  Track track;
  run_through(scene, {}, [&](const Simulation& simulation) {
    std::vector<Motion>& now = track.motion.emplace_back();
    for (std::size_t i = 0; i < simulation.body_count(); ++i) now.push_back(simulation.body_motion(i));
  });
  return track;
}

double extent_of(const Scene& scene) {
  double largest = 0;
  for (const SceneBody& body : scene.bodies) {
    for (const Vec2 vertex : body.outer.vertices)
      largest = std::max({largest, std::abs(vertex.x), std::abs(vertex.y)});
  }
  return largest;
}

/// How one observer's motion becomes the other's.
struct View {
  std::function<Vec2(Vec2 displacement, double time)> displacement;
  double turn = 1;                                                       ///< sign of rotations
  std::function<std::size_t(std::size_t body, std::size_t count)> body;  ///< its number there
};

/// Largest difference of displacements, and of rotations times the extent, over the extent of the scene.
double parted(const Scene& scene, const Scene& other, const View& view) {
  const Track here = track_of(scene), there = track_of(other);
  if (here.motion.size() != there.motion.size()) return std::nan("");
  double largest = 0;
  const double extent = extent_of(scene);
  for (std::size_t k = 0; k < here.motion.size(); ++k) {
    const double time = std::min(static_cast<double>(k) * scene.output.history, scene.time.end);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Motion &p = here.motion[k][i],
                   &q = there.motion[k][view.body ? view.body(i, scene.bodies.size()) : i];
      const Vec2 due = view.displacement(p.displacement, time);
      const double off = std::max(std::hypot(q.displacement.x - due.x, q.displacement.y - due.y) / extent,
                                  std::abs(q.rotation - view.turn * p.rotation));
      if (!(off <= largest)) largest = std::isnan(largest) ? largest : off;
    }
  }
  return largest;
}

/// The relation over all samples it can be asked of, a row for each.
template <class Asked, class Transform>
void hold_over(const Bench& bench, Rows& rows, const Asked& asked, const Transform& transform,
               const View& view) {
  for (const Sample& sample : samples(bench)) {
    if (!asked(sample)) continue;
    rows.below(Kind::exact, sample.name + ": apart, share of the scene's extent",
               parted(sample.scene, transform(sample.scene), view), sample.apart, "");
  }
}

constexpr auto of_all = [](const Sample&) { return true; };
Vec2 as_it_is(Vec2 displacement, double) {
  return displacement;
}

void translation(const Bench& bench, Rows& rows) {
  hold_over(bench, rows, of_all,
            [](const Scene& scene) {
              return moved_by(scene, {3, -7});
            },
            {as_it_is, 1, {}});
}

void rotation(const Bench& bench, Rows& rows) {
  hold_over(bench, rows, of_all, turned, {[](Vec2 d, double) { return Vec2{-d.y, d.x}; }, 1, {}});
}

void reflection(const Bench& bench, Rows& rows) {
  hold_over(bench, rows, of_all, mirrored, {[](Vec2 d, double) { return Vec2{-d.x, d.y}; }, -1, {}});
}

void permutation(const Bench& bench, Rows& rows) {
  const auto backwards = [](const Scene& scene) {
    std::vector<std::size_t> order(scene.bodies.size());
    std::iota(order.rbegin(), order.rend(), std::size_t{0});
    return reordered(scene, order);
  };
  hold_over(bench, rows, of_all, backwards,
            {as_it_is, 1, [](std::size_t body, std::size_t count) { return count - 1 - body; }});
}

void boost(const Bench& bench, Rows& rows) {
  constexpr Vec2 velocity{5, -3};
  hold_over(
      bench, rows, [](const Sample& sample) { return sample.free; },
      [&](const Scene& scene) { return boosted(scene, velocity); },
      {[&](Vec2 d, double time) { return d + time * velocity; }, 1, {}});
}

/// The samples that a relation does not hold for to the bit, in one row.
template <class Holds>
void hold_to_the_bit(const Bench& bench, Rows& rows, const std::string& what, const std::string& reference,
                     const Holds& holds) {
  std::vector<std::string> differing;
  const std::vector<Sample> all = samples(bench);
  for (const Sample& sample : all) {
    if (!holds(sample.scene)) differing.push_back(sample.name);
  }
  rows.same(fmt::format("{} scenes, {}", all.size(), what), differing, reference);
}

bool same_but_for_exponents(const Track& here, const Track& there, Units in) {
  if (here.motion.size() != there.motion.size()) return false;
  const double length = std::ldexp(1.0, in.length), speed = std::ldexp(1.0, in.length - in.time);
  const auto same = [](Vec2 p, Vec2 q, double factor) { return q.x == factor * p.x && q.y == factor * p.y; };
  for (std::size_t k = 0; k < here.motion.size(); ++k) {
    for (std::size_t i = 0; i < here.motion[k].size(); ++i) {
      const Motion &p = here.motion[k][i], &q = there.motion[k][i];
      if (!same(p.displacement, q.displacement, length) || !same(p.velocity, q.velocity, speed) ||
          p.rotation != q.rotation)
        return false;
    }
  }
  return true;
}

/// Lengths, masses and times by powers of two: every number changes its exponent alone.
void units(const Bench& bench, Rows& rows) {
  for (const auto& [what, in] : {std::pair{"lengths 2^10 times as large", Units{10, 0, 0}},
                                 {"2^-10 times", Units{-10, 0, 0}},
                                 {"masses 2^20 times", Units{0, 20, 0}},
                                 {"times 2^8 times", Units{0, 0, 8}},
                                 {"lengths 2^17, masses 2^-11, times 2^-6 times", Units{17, -11, -6}}}) {
    const Units to = in;  // clang 14 lets no lambda capture what a binding names
    hold_to_the_bit(bench, rows, what, "bits but for the exponents", [&, to](const Scene& scene) {
      return same_but_for_exponents(track_of(scene), track_of(in_units(scene, to)), to);
    });
  }
}

/// Spin of a body from the velocities of two of its vertices, rad/s; it does not deform.
double spin_of(const Simulation& simulation, std::size_t body) {
  const std::vector<Vec2>& vertices = simulation.scene().bodies[body].outer.vertices;
  const Motion p = simulation.point_motion(body, vertices[0]), q = simulation.point_motion(body, vertices[1]);
  const Vec2 r = q.position - p.position, v = q.velocity - p.velocity;
  return (r.x * v.y - r.y * v.x) / (r.x * r.x + r.y * r.y);
}

void time_reversal(const Bench& bench, Rows& rows) {
  for (const Sample& sample : samples(bench)) {
    if (!sample.reversible) continue;
    Simulation forth(sample.scene, {});
    while (forth.advance()) {
    }
    Scene back = sample.scene;
    for (std::size_t i = 0; i < back.bodies.size(); ++i) {
      const Vec2 v = forth.body_motion(i).velocity;
      back.bodies[i].velocity = {-v.x, -v.y};
      back.bodies[i].angular_velocity = -spin_of(forth, i);
    }
    Simulation again(back, {});
    again.take_geometry(forth.geometry());
    while (again.advance()) {
    }
    double off = 0;
    for (std::size_t i = 0; i < back.bodies.size(); ++i) {
      for (const Vec2 vertex : back.bodies[i].outer.vertices) {
        const Vec2 p = again.point_motion(i, vertex).position;
        off = std::max(off, std::hypot(p.x - vertex.x, p.y - vertex.y));
      }
    }
    rows.below(Kind::exact, sample.name + ": misses its start, share of the scene's extent",
               off / extent_of(back), sample.apart, "");
  }
}

/// With the state taken into a simulation made anew after every 37 steps, ten times while it settles and ten
/// times after that: to lay all bodies costs more than the steps between.
std::string hash_in_pieces(const Scene& scene) {
  constexpr std::uint64_t piece = 37, pieces = 10;
  auto simulation = std::make_unique<Simulation>(scene, RunSettings{});
  std::uint64_t steps = 0;
  const Pause pause = [&] { return steps < piece * pieces && ++steps % piece == 0; };
  const auto go_on = [&] {
    Archive kept;
    simulation->exchange(kept);
    simulation = std::make_unique<Simulation>(scene, RunSettings{});
    Archive taken(kept.bytes());
    simulation->exchange(taken);
  };
  while (!simulation->settle(pause)) go_on();
  steps = 0;
  while (simulation->advance(pause)) {
    if (steps > 0 && steps < piece * pieces) go_on();
  }
  return simulation->state_hash();
}

void restart(const Bench& bench, Rows& rows) {
  hold_to_the_bit(bench, rows, "left off and taken up ten times and more", "state as in one go",
                  [](const Scene& scene) { return hash_in_pieces(scene) == hash_after(scene, {}); });
}

void thread_count(const Bench& bench, Rows& rows) {
  for (const int threads : {2, 3}) {
    hold_to_the_bit(bench, rows, fmt::format("{} threads", threads), "state as with 1",
                    [&](const Scene& scene) {
                      return hash_after(scene, {.threads = threads}) == hash_after(scene, {.threads = 1});
                    });
  }
}

void neighbour_search(const Bench& bench, Rows& rows) {
  hold_to_the_bit(bench, rows, "neighbours sought in every step", "state as with the skin",
                  [](const Scene& scene) {
                    return hash_after(scene, {.neighbour_skin = false}) == hash_after(scene, {});
                  });
}

}  // namespace

std::span<const Case> metamorphic_cases() {
  static constexpr Case cases[] = {
      {"metamorphic", "translation", "What is moved as a whole moves the same, but for rounded coordinates.",
       3, translation},
      {"metamorphic", "rotation", "What is turned by 90° moves the same, turned.", 3, rotation},
      {"metamorphic", "reflection", "What is mirrored moves the same, mirrored.", 3, reflection},
      {"metamorphic", "permutation", "The order in which bodies are listed does not matter.", 3, permutation},
      {"metamorphic", "boost", "What nothing holds moves the same in a frame that moves.", 1, boost},
      {"metamorphic", "units", "Units that differ by powers of two give the same digits to the bit.", 6,
       units},
      {"metamorphic", "time_reversal", "Without friction and damping a motion runs back to its start.", 1,
       time_reversal},
      {"metamorphic", "restart", "What is left off and goes on gives the same bits.", 6, restart},
      {"metamorphic", "threads", "The number of threads changes no bit.", 5, thread_count},
      {"metamorphic", "neighbour_search", "When neighbours are sought changes no bit.", 5, neighbour_search},
  };
  return cases;
}

}  // namespace talus::verification
