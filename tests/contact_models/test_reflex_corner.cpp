// Contacts on both faces of a reflex corner, of one body or of two.
#include "output/sampled.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A wedge that is driven into its notch at 2 mm/s. The notch is in one body, or between two.
WorkingScene driven_wedge(double half_angle, bool one_body, const std::string& law) {
  const double half = std::tan(half_angle * degree);
  WorkingScene text;
  text.law = law;
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0, "tangential_damping": 0)";
  const auto fixed = [](const char* name, const std::string& polygon) {
    return fmt::format(R"({{"name": "{}", "material": "rock", "fixed": true, "polygon": [{}]}}, )", name,
                       polygon);
  };
  const std::string left = fmt::format("[{}, 1], [-3, 1], [-3, -0.5]", -half),
                    right = fmt::format("[3, -0.5], [3, 1], [{}, 1]", half);
  text.bodies =
      one_body ? fixed("notch", left + ", " + right + ", [0, 0]") + fixed("far", "[9, 0], [9, 1], [8, 1]")
               : fixed("left", left + ", [0, -0.5], [0, 0]") + fixed("right", "[0, 0], [0, -0.5], " + right);
  text.bodies += fmt::format(R"({{"name": "wedge", "material": "rock", "polygon": [[0, 0], [{}, 1], [{}, 1]],
                                 "drive": {{"x": 0, "y": -0.002, "rotation": 0}}}})",
                             half, -half);
  text.time = R"({"end": 0.5, "dt": 5e-4})";
  return text;
}

double upward_force(const WorkingScene& text) {
  const Simulation simulation = run_to_end(text);
  return contact_sum(simulation.contacts(), 2, {}).force.y;
}

}  // namespace

TEST_CASE("friction acts on both faces of a notch, whether one body has it or two", "[laws][friction]") {
  for (const char* law : {"overlap_area", "cohesive_overlap"}) {
    for (const double half_angle : {10.0, 30.0, 70.0}) {
      INFO(law << ", " << half_angle);
      const double a = half_angle * degree, moved = 1e-3;
      // Faces of length 1/cos a close by moved · sin a and slip by moved · cos a, which a flat wedge does not
      // long enough to overcome its friction.
      const double rubs = std::min(std::tan(30 * degree) * std::sin(a), std::cos(a));
      const double due = 2e9 * moved / std::cos(a) * (std::sin(a) * std::sin(a) + rubs * std::cos(a));
      const double one = upward_force(driven_wedge(half_angle, true, law)),
                   two = upward_force(driven_wedge(half_angle, false, law));
      CHECK(one == Approx(due).epsilon(3e-3));
      CHECK(one == Approx(two).epsilon(1e-3));
    }
  }
}

TEST_CASE("a sector turns in its bowl against the friction of all of its facets", "[laws][friction]") {
  // Facets of 6°, whose corners lie in those of the bowl; it is pushed down by 1 mm and turned about the
  // centre of the bowl, by 0.3°/s, with its own 3.68 m below.
  std::string bowl = "[-6, -6], [6, -6], [6, 0]", sector;
  const double radius = 4;
  for (int i = 60; i >= 0; i -= 6) {
    const double angle = (i - 30) * degree;
    bowl += fmt::format(", [{}, {}]", radius * std::sin(angle), -radius * std::cos(angle));
    sector = fmt::format("[{}, {}]{}", radius * std::sin(angle), -radius * std::cos(angle),
                         sector.empty() ? "" : ", " + sector);
  }
  WorkingScene text;
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0, "tangential_damping": 0)";
  text.bodies =
      fmt::format(R"({{"name": "bowl", "material": "rock", "fixed": true, "polygon": [{}, [-6, 0]]}},
      {{"name": "sector", "material": "rock", "polygon": [{}],
        "drive": {{"x": 0.01925, "y": -0.01, "rotation": 0.3}}}})",
                  bowl, sector);
  text.time = R"({"end": 0.1, "dt": 5e-4})";
  const Simulation simulation = run_to_end(text);
  const std::vector<Contact> contacts = simulation.contacts();
  double pressed = 0, rubbed = 0;
  for (const Contact& contact : contacts) {
    pressed += std::hypot(contact.normal_force.x, contact.normal_force.y);
    rubbed += std::hypot(contact.tangential_force.x, contact.tangential_force.y);
  }
  CHECK(contacts.size() >= 10);
  CHECK(rubbed == Approx(std::tan(30 * degree) * pressed).epsilon(1e-3));
  const double moment = contact_sum(contacts, 1, {0, 0}).moment;
  CHECK(std::abs(moment) == Approx(radius * std::tan(30 * degree) * pressed).epsilon(0.02));
}

TEST_CASE("a box stands in the corner of one body as in that of two", "[laws]") {
  // Pulled into the corner by 3 and 9.81 m/s², without friction.
  const std::string floor_and_wall =
      box("floor", -1, -1, 3, 0, R"("fixed": true)") + ", " + box("wall", -1, 0, 0, 3, R"("fixed": true)");
  const std::string corner = R"({"name": "corner", "material": "rock", "fixed": true,
      "polygon": [[0, 0], [3, 0], [3, -1], [-1, -1], [-1, 3], [0, 3]]}, )" +
                             box("far", 9, 0, 10, 1, R"("fixed": true)");
  for (const char* law : {"overlap_area", "vertex_edge"}) {
    for (const char* cover : {"rigid", "block"}) {
      for (const std::string& around : {floor_and_wall, corner}) {
        INFO(law << ", " << cover << ", " << around);
        WorkingScene text;
        text.law = law;
        text.cover = cover;
        text.gravity = "[-3, -9.81]";
        text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                            "normal_damping": 0.3, "tangential_damping": 0.3)";
        text.bodies = around + ", " + box("box", 0, 0, 1, 1);
        text.rest = R"("damping": 100,)";
        text.time = R"({"end": 0.4})";
        const Simulation simulation = run_to_end(text);
        const Motion motion = simulation.body_motion(2);
        const ContactSum sum =
            contact_sum(simulation.contacts(), 2, {0.5 + motion.displacement.x, 0.5 + motion.displacement.y});
        CHECK(sum.force.x == Approx(3 * 2300).epsilon(1e-4));
        CHECK(sum.force.y == Approx(9.81 * 2300).epsilon(1e-4));
        CHECK(std::abs(sum.moment) < 1);
        CHECK(std::abs(motion.rotation) < 1e-6);
        CHECK(residual_share(simulation.ledger()) < 1e-3);
      }
    }
  }
}

TEST_CASE("reports tell the moment of a contact with several sides", "[laws][output]") {
  // A wedge rests in its notch under a couple, which tilts the pressure on its faces.
  const double half = std::tan(30 * degree);
  for (const char* cover : {"rigid", "block"}) {
    INFO(cover);
    WorkingScene text;
    text.cover = cover;
    text.law = "frictionless";
    text.gravity = "[0, -9.81]";
    text.interface = R"("normal_stiffness": 1e9, "normal_damping": 0.3)";
    text.bodies = fmt::format(
        R"({{"name": "notch", "material": "rock", "fixed": true,
             "polygon": [[-3, -0.5], [3, -0.5], [3, 1], [{0}, 1], [0, 0], [-{0}, 1], [-3, 1]]}},
           {{"name": "wedge", "material": "rock", "polygon": [[0, 0], [{0}, 1], [-{0}, 1]]}})",
        half);
    text.rest = R"("loads": [{"body": "wedge", "point": [0.2, 0.9], "force": [0, 2500]},
                             {"body": "wedge", "point": [-0.2, 0.9], "force": [0, -2500]}], "damping": 200,)";
    text.time = R"({"end": 0.5})";
    const Simulation simulation = run_to_end(text);
    const Motion motion = simulation.body_motion(1);
    const Vec2 centre{motion.displacement.x, 2 / 3.0 + motion.displacement.y};
    CHECK(contact_sum(simulation.contacts(), 1, centre).moment == Approx(-1000).epsilon(1e-3));
  }
}

TEST_CASE("reports count what a jump of the stiffness does", "[laws][output]") {
  // A block is pushed by 1 mm into a floor of which one half is stiffer: shifted aside it would store less.
  WorkingScene text;
  text.law = "frictionless";
  text.interface = R"("normal_stiffness": 1e8, "normal_damping": 0},
                     {"between": ["soft", "rock"], "normal_stiffness": 1e7, "normal_damping": 0)";
  text.bodies = R"({"name": "floor", "material": "rock", "fixed": true, "surfaces": {"soft": [3]},
                    "polygon": [[-2, -1], [2, -1], [2, 0], [0, 0], [-2, 0]]}, )" +
                box("block", -0.5, 0, 0.5, 1, R"("drive": {"x": 0, "y": -0.01, "rotation": 0})");
  text.time = R"({"end": 0.1, "dt": 1e-4})";
  const Simulation simulation = run_to_end(text);
  const Vec2 force = contact_sum(simulation.contacts(), 1, {0, 0}).force;
  CHECK(force.y == Approx(1e-3 * (1e8 + 1e7) / 2).epsilon(1e-6));
  CHECK(force.x == Approx(-(1e8 - 1e7) * 1e-6 / 2).epsilon(1e-3));
}

namespace {

/// A round trough of 20 m with bends of a few degrees, from 45° to 45°.
std::string trough(double bend) {
  std::string polygon = "[-20, -23], [20, -23]";
  const int facets = static_cast<int>(std::lround(90 / bend));
  for (int i = facets; i >= 0; --i) {
    const double angle = (i * bend - 45) * degree;
    polygon += fmt::format(", [{}, {}]", 20 * std::sin(angle), -20 * std::cos(angle));
  }
  return fmt::format(R"({{"name": "trough", "material": "rock", "fixed": true, "polygon": [{}]}})", polygon);
}

/// A block of 2 × 1 m in it whose base stands on both of its ends, 25° to the left.
std::string block_in_trough(double bend) {
  const double c = std::cos(25 * degree), s = std::sin(25 * degree);
  const double base = std::sqrt(20 * 20 - 1) - 1.02 * 20 * (1 - std::cos(bend / 2 * degree));
  std::string polygon;
  for (const auto& [along, up] : {std::pair(-1, 0), std::pair(1, 0), std::pair(1, 1), std::pair(-1, 1)}) {
    const double from_centre = base - up;
    polygon += fmt::format("{}[{}, {}]", polygon.empty() ? "" : ", ", along * c - from_centre * s,
                           -along * s - from_centre * c);
  }
  return fmt::format(R"({{"name": "block", "material": "rock", "polygon": [{}]}})", polygon);
}

WorkingScene slide_in_trough(double bend) {
  WorkingScene text;
  text.law = "vertex_edge";
  text.cover = "rigid";
  text.gravity = "[0, -9.81]";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies = trough(bend) + ", " + block_in_trough(bend);
  text.time = R"({"end": 4})";
  return text;
}

}  // namespace

TEST_CASE("a block slides over the bends of a trough and neither gains nor loses by them",
          "[laws][vertex_edge]") {
  for (const double bend : {0.5, 2.0}) {
    INFO(bend << " degrees");
    const Simulation simulation = run_to_end(slide_in_trough(bend));
    CHECK(std::abs(residual_share(simulation.ledger())) < 1e-3);
    CHECK(simulation.ledger().contact_damping_loss < 0.03 * simulation.ledger().throughput);
  }
}

TEST_CASE("a block that slides over bends is the same bits however candidates are sought",
          "[laws][vertex_edge]") {
  for (const double bend : {0.5, 2.0}) {
    INFO(bend << " degrees");
    const auto hash = [&](bool skin) {
      Simulation simulation(slide_in_trough(bend).read(), {.neighbour_skin = skin});
      while (simulation.advance()) {
      }
      return simulation.state_hash();
    };
    CHECK(hash(true) == hash(false));
  }
}

TEST_CASE("a wedge whose tip sticks in the toe of a bench comes to rest", "[laws][vertex_edge]") {
  struct Bench {
    double plane, face;  ///< deg
    const char* floor;   ///< friction, deg
  };
  for (const Bench& bench : {Bench{35, 60, "45"}, Bench{40, 60, "0"}, Bench{50, 75, "0"}}) {
    INFO("plane of " << bench.plane << ", face of " << bench.face << " degrees");
    const double over_plane = 1 / std::tan(bench.plane * degree),
                 over_face = 1 / std::tan(bench.face * degree);
    WorkingScene text;
    text.law = "vertex_edge";
    text.cover = "block";
    text.gravity = "[0, -9.81]";
    text.interface =
        fmt::format(R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": {},
                                    "normal_damping": 0.3, "tangential_damping": 0.3}},
        {{"between": ["plane", "rock"], "normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 60,
          "normal_damping": 0.3, "tangential_damping": 0.3)",
                    bench.floor);
    text.bodies = fmt::format(
        R"({{"name": "bench", "material": "rock", "fixed": true, "surfaces": {{"plane": [0]}},
             "polygon": [[0, 0], [{}, 16], [{}, -8], [-5, -8], [-5, 0]]}},
           {{"name": "wedge", "material": "rock", "polygon": [[0, 0], [{}, 8], [{}, 12], [{}, 12]]}})",
        16 * over_plane, 16 * over_plane, 8 * over_plane, 8 * over_plane, 12 * over_face);
    text.rest = R"("settle": {"duration": 2, "damping": "adaptive", "until": 1e-6, "hold_stick": false},)";
    text.time = R"({"end": 0.5})";
    const Simulation simulation = settle_and_run(text);
    CHECK(residual_share(simulation.ledger()) < 5e-3);
    const Vec2 velocity = simulation.body_motion(1).velocity;
    CHECK(std::hypot(velocity.x, velocity.y) < 1e-3);
  }
}

TEST_CASE("a corner that comes to a slight bend is pushed by how deep it is, before it and past it",
          "[laws][vertex_edge]") {
  // It sinks by 5 mm/s and moves on by 1 m/s, to the bend in 0.2 s.
  for (const double bend : {0.3, 1.0, 10.0}) {
    const double rise = std::tan(bend * degree);
    WorkingScene text;
    text.law = "vertex_edge";
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 0,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.bodies = fmt::format(R"({{"name": "below", "material": "rock", "fixed": true,
            "polygon": [[-4, -2], [4, -2], [4, {}], [0, 0], [-4, 0]]}},
         {{"name": "box", "material": "rock", "polygon": [[-1.2, 0], [-0.2, 0], [-0.2, 1], [-1.2, 1]],
           "drive": {{"x": 1, "y": -0.005, "rotation": 0}}}})",
                              4 * rise);
    text.rest = R"("limits": {"penetration": 1, "energy_residual": 1e9},)";
    text.time = R"({"end": 0.4, "dt": 5e-4})";
    Simulation simulation(text.read(), {});
    while (simulation.advance()) {
      const double depth = 0.005 * simulation.time(), past = simulation.time() - 0.2;
      // Both of its ends bear half a metre.
      const double due = 5e8 * (depth + (past > 0 ? depth + past * rise : depth));
      const double force = contact_sum(simulation.contacts(), 1, {}).force.y;
      INFO(bend << " degrees, " << past << " m past the bend");
      REQUIRE(force == Approx(due).epsilon(bend < 5 ? 0.02 : 0.08).margin(1e4));
    }
  }
}

TEST_CASE("corners of two blocks that meet in the reflex corner of a roof bear it as their faces do",
          "[laws][vertex_edge]") {
  for (const double incline : {5.0, 10.0, 20.0}) {
    INFO("faces of " << incline << " degrees");
    const double drop = std::tan(incline * degree);
    WorkingScene text;
    text.law = "vertex_edge";
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 0,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.bodies = fmt::format(
        R"({{"name": "left", "material": "rock", "fixed": true, "polygon": [[-1, -2], [0, -2], [0, 0], [-1, {0}]]}},
           {{"name": "right", "material": "rock", "fixed": true, "polygon": [[0, -2], [1, -2], [1, {0}], [0, 0]]}},
           {{"name": "roof", "material": "rock", "polygon": [[-1, {0}], [0, 0], [1, {0}], [1, 1], [-1, 1]],
             "drive": {{"x": 0, "y": -0.1, "rotation": 0}}}})",
        -drop);
    text.time = R"({"end": 0.01, "dt": 1e-4})";
    const ContactSum sum = contact_sum(run_to_end(text).contacts(), 2, {});
    CHECK(sum.force.y == Approx(2e9 * 1e-3).epsilon(3e-3));
    CHECK(std::abs(sum.force.x) < 1);
  }
}
