#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::verification {
namespace {

constexpr const char* laws_of_all_shapes[] = {"overlap_area", "frictionless",        "vertex_edge",
                                              "feng_volume",  "potential_symmetric", "cohesive_overlap"};

std::string box_body(const std::string& name, double x, double y, double width, double height,
                     const std::string& more = "") {
  return fmt::format(R"({{"name": "{}", "material": "rock", "polygon": {}{}}})", name,
                     polygon_text({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}), more);
}

Scene of_bodies(const Bench& bench, const std::string& law, const std::string& bodies,
                const std::string& rest) {
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{{}}}, "contact": {{"model": "{}"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                          "friction_angle": 30, "normal_damping": 0, "tangential_damping": 0}}],
          "bodies": [{}], {}}})",
      rock_text, law, bodies, rest));
}

/// Largest of all bodies' displacements at the end; NaN where any is no number.
double largest_motion(const Scene& scene) {
  double largest = 0;
  run_through(scene, {}, [&](const Simulation& simulation) {
    for (std::size_t i = 0; i < simulation.body_count(); ++i) {
      const double moved = magnitude(simulation.body_motion(i).displacement);
      if (!(moved <= largest)) largest = std::isnan(largest) ? largest : moved;
    }
  });
  return largest;
}

/// Bodies that touch and do not press: no force, whatever is coincident.
void zero_gap(const Bench& bench, Rows& rows) {
  const std::string four = box_body("a", 0, 0, 1, 1) + ", " + box_body("b", 1, 0, 1, 1) + ", " +
                           box_body("c", 0, 1, 1, 1) + ", " + box_body("d", 1, 1, 1, 1);
  // A square whose sides carry many vertices in a line, on one that has none there; and one with edges of
  // 1e-9 m.
  const std::string subdivided =
      box_body("low", 0, 0, 1, 1) + R"(, {"name": "top", "material": "rock", "polygon":
        [[0, 1], [0.25, 1], [0.5, 1], [0.500000001, 1], [0.75, 1], [1, 1], [1, 2], [0, 2]]})";
  const std::string on_tip =
      box_body("low", 0, 0, 1, 1) +
      R"(, {"name": "top", "material": "rock", "polygon": [[0.5, 1], [1, 2], [0, 2]]})";
  const std::string tip_on_tip =
      R"({"name": "low", "material": "rock", "polygon": [[0, 0], [1, 0], [0.5, 1]]},
      {"name": "top", "material": "rock", "polygon": [[0.5, 1], [1, 2], [0, 2]]})";
  for (const auto& [what, bodies] : {std::pair{"four coincident vertices", four},
                                     {"vertices along a side, one 1e-9 m from the next", subdivided},
                                     {"a vertex on a side", on_tip},
                                     {"vertex on vertex", tip_on_tip}}) {
    double largest = 0;
    for (const char* law : laws_of_all_shapes)
      largest = std::max(largest, largest_motion(of_bodies(bench, law, bodies, R"("time": {"end": 0.05})")));
    rows.about(Kind::exact, fmt::format("{}: largest motion, six laws", what), largest, 0, 0, "m");
  }
}

/// Shapes that make no sense are refused with the reason.
void refused_shapes(const Bench& bench, Rows& rows) {
  const auto refusal = [&](const std::string& polygon) {
    try {
      bench.from_text(fmt::format(
          R"({{"talus": 1, "materials": {{{}}}, "bodies": [{{"name": "a", "material": "rock", "polygon": {}}}], "time": {{"end": 1}}}})",
          rock_text, polygon));
    } catch (const SceneError& error) {
      return error.mistakes.empty() ? std::string(error.what()) : error.mistakes[0].text();
    }
    return std::string();
  };
  rows.says("an edge of no length", refusal("[[0, 0], [1, 0], [1, 0], [1, 1]]"),
            {"/bodies/0/polygon", "same"});
  rows.says("no area", refusal("[[0, 0], [1, 0], [2, 0]]"), {"no area"});
  rows.says("a bow tie", refusal("[[0, 0], [1, 1], [1, 0], [0, 1]]"), {"intersects itself"});
  rows.says("a spike there and back", refusal("[[0, 0], [1, 0], [1, 1], [1, 3], [1, 1], [0, 1]]"),
            {"/bodies/0/polygon"});
}

/// Edges and cut elements down to a millionth.
void slivers(const Bench& bench, Rows& rows) {
  // Two triangles of the lattice, one of which the body's edge cuts to a share of 1e-6 of its height.
  for (const double sliver : {1e-3, 1e-6, 1e-9}) {
    const double height = std::sqrt(3.0) / 2 * 0.5;
    const Scene scene = bench.from_text(fmt::format(
        R"({{"talus": 1, "gravity": [0, -10], "materials": {{{}}},
            "cover": {{"model": "hexagonal", "size": 0.5, "offset_y": {:.17g}}}, "contact": {{"model": "overlap_area"}},
            "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                            "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}}],
            "bodies": [{}, {}],
            "settle": {{"duration": 0.2, "damping": "adaptive", "until": 1e-8}}, "time": {{"end": 0.01}}, "output": {{"history": 1}}}})",
        rock_text, -(2 * height + sliver) / 2, box_body("base", -1, -1, 4, 1, R"(, "fixed": true)"),
        box_body("block", 0, 0, 2, 2 * height + sliver)));
    double force = 0;
    run_through(scene, {}, [&](const Simulation& simulation) {
      force = 0;
      for (const Contact& contact : simulation.contacts()) force += contact.normal_force.y;
    });
    const double weight = 2300 * 10 * 2 * (2 * height + sliver);
    rows.near(Kind::analytic, fmt::format("lattice cut {:g} m beyond its row: the base carries", sliver),
              std::abs(force), weight, 1e-4, "N/m");
  }
  // A needle on a base, and a block with a corner cut off by a millionth.
  const auto sinks = [&](const std::string& body, double due, const std::string& what) {
    const double omega = std::sqrt(1e10 / 2300);
    const Scene scene = bench.from_text(fmt::format(
        R"({{"talus": 1, "gravity": [0, -10], "materials": {{{}}}, "cover": {{"model": "rigid"}},
            "contact": {{"model": "frictionless"}},
            "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
            "bodies": [{}, {}], "damping": {:.17g}, "time": {{"end": {:.17g}}}}})",
        rock_text, box_body("base", -9, -1, 18, 1, R"(, "fixed": true)"), body, omega, 60 / omega));
    // The cut corners carry as well, about the depth over the width of the weight.
    rows.near(Kind::analytic, what + " sinks by", -run(scene, "block").motion.back().displacement.y, due,
              1e-5, "m");
  };
  for (const double cut : {1e-3, 1e-6, 1e-9}) {
    sinks(fmt::format(R"({{"name": "block", "material": "rock", "polygon": {}}})",
                      polygon_text({{cut, 0}, {1 - cut, 0}, {1, cut}, {1, 1}, {0, 1}, {0, cut}})),
          2300 * 10 * (1 - cut * cut) / 1e10 / (1 - 2 * cut),
          fmt::format("block with corners cut off by {:g} m", cut));
  }
}

/// A block within the hole of a body that stands on a base: each carries its own, the base both.
void within_a_hole(const Bench& bench, Rows& rows) {
  const double omega = std::sqrt(1e10 / 2300);
  for (const char* cover : {"rigid", "block"}) {
    const Scene scene = bench.from_text(fmt::format(
        R"({{"talus": 1, "gravity": [0, -10],
            "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e13, "poisson_ratio": 0}}}},
            "cover": {{"model": "{}"}}, "contact": {{"model": "overlap_area"}},
            "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                            "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}}],
            "bodies": [{}, {{"name": "frame", "material": "rock", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]],
                            "holes": [[[1, 1], [3, 1], [3, 3], [1, 3]]]}},
                       {}],
            "damping": {:.17g}, "time": {{"end": {:.17g}, "safety": 0.4}}}})",
        cover, box_body("base", -1, -1, 6, 1, R"(, "fixed": true)"), box_body("block", 1.5, 1, 1, 1),
        omega / 2, 80 / omega));
    Vec2 frame{}, inside{};
    run_through(scene, {}, [&](const Simulation& simulation) {
      frame = simulation.body_motion(1).displacement;
      inside = simulation.body_motion(2).displacement;
    });
    const double weight = 2300 * 10;
    // A block of E = 1e13 Pa gives way by less than 1 % of what a joint does.
    const double share = std::string(cover) == "rigid" ? 1e-4 : 0.02;
    rows.near(Kind::analytic, fmt::format("{}: the frame sinks by (weight of both)/4α", cover), -frame.y,
              13 * weight / 4e10, share, "m");
    rows.near(Kind::analytic, fmt::format("{}: the block within sinks into it by ρgh/α", cover),
              frame.y - inside.y, weight / 1e10, share, "m");
  }
}

/// Two saw-toothed bodies in each other: friction of the asperity, tan(φ + i), under a horizontal force.
Scene saw_teeth(const Bench& bench, double friction, double share) {
  constexpr int teeth = 5;
  constexpr double tooth = 1, slope = 20;
  const double rise = tooth / 2 * std::tan(slope * std::numbers::pi / 180);
  std::vector<Vec2> lower{{-3, -2}, {teeth + 3.0, -2}, {teeth + 3.0, 0}}, upper{{0, 0}};
  for (int i = teeth + 3; i-- > -3;) {
    lower.push_back({i + 0.5, rise});
    if (i > -3) lower.push_back({static_cast<double>(i), 0});
  }
  lower.push_back({-3, 0});
  for (int i = 0; i < teeth; ++i) {
    upper.push_back({i + 0.5, rise});
    upper.push_back({i + 1.0, 0});
  }
  upper.push_back({teeth, 1});
  upper.push_back({0, 1});
  double area = 0;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    const Vec2 p = upper[i], q = upper[(i + 1) % upper.size()];
    area += (p.x * q.y - q.x * p.y) / 2;
  }
  const double weight = 2300 * 10 * area;
  const double force = share * weight * std::tan((slope + friction) * std::numbers::pi / 180);
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "gravity": [0, -10], "materials": {{{}}}, "cover": {{"model": "rigid"}},
          "contact": {{"model": "overlap_area"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e11, "tangential_stiffness": 1e11,
                          "friction_angle": {}, "normal_damping": 0.3, "tangential_damping": 0.3}}],
          "bodies": [{{"name": "lower", "material": "rock", "fixed": true, "polygon": {}}},
                     {{"name": "upper", "material": "rock", "fix": ["rotation"], "polygon": {}}}],
          "settle": {{"duration": 0.3, "damping": 300}},
          "loads": [{{"body": "upper", "point": [2.5, 0.5],
                     "force": [{{"scale": {:.17g}, "time": [[0, 0], [0.5, 1]]}}, 0]}}],
          "time": {{"end": 1}}, "output": {{"history": 0.01}}}})",
      rock_text, friction, polygon_text(lower), polygon_text(upper), force));
}

void saw_tooth(const Bench& bench, Rows& rows) {
  for (const double friction : {0.0, 25.0}) {
    const Course holds = run(saw_teeth(bench, friction, 0.98), "upper");
    rows.below(Kind::analytic, fmt::format("φ = {:g}°, teeth of 20°, 0.98 W tan(φ+i): moves by", friction),
               holds.moved_between(0, 2), 1e-4, "m");
    const Course climbs = run(saw_teeth(bench, friction, 1.02), "upper");
    const Vec2 moved = climbs.motion.back().displacement;
    rows.above(Kind::analytic, fmt::format("φ = {:g}°, 1.02 W tan(φ+i): climbs, moves by", friction),
               climbs.moved_between(0, 2), 5e-3, "m");
    rows.near(Kind::analytic, fmt::format("φ = {:g}°: climbs along the teeth, rise over run", friction),
              moved.y / moved.x, std::tan(20 * std::numbers::pi / 180), 0.02, "");
  }
}

/// 505 blocks that touch along all of their sides, let go at once: overlaps of 1e-16 m come and go.
void rounded_overlaps(const Bench& bench, Rows& rows) {
  const auto let_go = [&](const std::string& law) {
    return bench.shipped("vaiont", {{"/settle", "null"},
                                    {"/contact/model", law},
                                    {"/time/end", "0.05"},
                                    {"/output", R"({"history": 0.001})"}});
  };
  for (const std::string law : laws_of_all_shapes) {
    if (law == "feng_volume") continue;
    double fastest = 0;
    const RunSummary summary = run_through(let_go(law), {}, [&](const Simulation& simulation) {
      for (std::size_t i = 0; i < simulation.body_count(); ++i) {
        // Nothing falls faster than freely, but for what the elastic blocks ring.
        const double speed = magnitude(simulation.body_motion(i).velocity);
        fastest = std::max(fastest, speed - 9.81 * simulation.time());
      }
    });
    rows.below(Kind::bound, law + ": largest energy residual, share", summary.largest_residual_share, 0.01,
               "");
    rows.below(Kind::bound, law + ": speed beyond that of a free fall", fastest, 0.1, "m/s");
  }
  // Its stiffness has no bound towards no depth: no step is small enough for what begins to touch everywhere.
  rows.says("feng_volume: stops and", trouble_of(let_go("feng_volume")),
            {"energy balance is lost", "smaller"});
}

}  // namespace

std::span<const Case> shape_cases() {
  static constexpr Case cases[] = {
      {"extremes", "zero_gap",
       "What touches without pressing feels no force: nothing moves, and nothing is no number.", 3, zero_gap},
      {"extremes", "refused_shapes", "Shapes without sense are refused with the reason.", 1, refused_shapes},
      {"extremes", "slivers", "Edges and cut elements down to 1e-9 m carry what they should.", 4, slivers},
      {"extremes", "rounded_overlaps",
       "Blocks that touch along their sides and are let go overlap by rounding, 1e-16 m, here and there: "
       "nothing is "
       "pushed apart, or a law that is too stiff for that stops.",
       2, rounded_overlaps},
      {"extremes", "within_a_hole", "A block in the hole of another presses on it as on any ground.", 1,
       within_a_hole},
      {"extremes", "saw_tooth",
       "Saw teeth of slope i hold a horizontal force up to W tan(φ+i), and are climbed beyond.", 2,
       saw_tooth},
  };
  return cases;
}

}  // namespace talus::verification
