#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

/// A clamp whose jaws, 0.05 m apart, are pressed together from outside.
const std::string clamp = R"({
  "talus": 1,
  "materials": {"rubber": {"density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2,
                           "damping_time": 1e-3}},
  "cover": {"model": "hexagonal", "size": 0.25},
  "contact": {"model": "overlap_area"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                  "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}],
  "bodies": [
    {"name": "clamp", "polygon": [[0, 0], [3, 0], [3, 0.5], [0.6, 0.5], [0.6, 0.55], [3, 0.55], [3, 1.05], [0, 1.05]],
     "material": "rubber", "surfaces": {"top": [6], "bottom": [0]}, "self_contact": true,
     "fix": ["x", "y", "rotation"]}
  ],
  "surface_loads": [{"body": "clamp", "surface": "top", "pressure": 5e5},
                    {"body": "clamp", "surface": "bottom", "pressure": 5e5}],
  "damping": 40,
  "time": {"end": 0.15}, "output": {"history": 0.01}
})";

/// Gap between the tips of the jaws, m.
double final_gap(const std::vector<Override>& overrides, double& upward) {
  double gap = 0;
  run(from_text(clamp, overrides), "clamp", {}, [&](const Simulation& s) {
    gap = 0.05 + s.point_motion(0, {2.9, 0.55}).displacement.y - s.point_motion(0, {2.9, 0.5}).displacement.y;
    upward = 0;
    for (const Contact& contact : s.contacts()) upward += std::abs(contact.normal_force.y);
  });
  return gap;
}

/// A square cut across its middle, pressed by 1 MPa from above and below, off the lines of the lattice.
std::string cut_square(const std::string& rest) {
  return R"({
  "talus": 1,
  "materials": {"rock": {"density": 2000, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.2}},
  "cover": {"model": "hexagonal", "size": 0.25, "offset_y": 0.05},
  "contact": {"model": "overlap_area"},
  "interfaces": [
    {"between": ["rock", "rock"], "normal_stiffness": 1e11, "tangential_stiffness": 1e11,
     "friction_angle": 40, "normal_damping": 0.3, "tangential_damping": 0.3},
    {"between": ["crack", "crack"], "normal_stiffness": 1e11, "tangential_stiffness": 1e11,
     "friction_angle": 15, "normal_damping": 0.3, "tangential_damping": 0.3},
    {"between": ["crack", "rock"], "normal_stiffness": 1e11, "tangential_stiffness": 1e11,
     "friction_angle": 40, "normal_damping": 0.3, "tangential_damping": 0.3}
  ],
  "bodies": [
    {"name": "press", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "rock",
     "surfaces": {"top": [2], "bottom": [0]},
     "discontinuities": [{"points": [[-0.1, 0.5], [1.1, 0.5]], "surface": "crack"}]}
  ],)" + rest +
         "}";
}

struct Resultant {
  double normal = 0, tangential = 0;  ///< N/m
  std::size_t contacts = 0, slipping = 0;
};

Resultant across_crack(const Simulation& simulation) {
  Resultant sum;
  for (const Contact& contact : simulation.contacts()) {
    // Which face is the second body of a contact within one body is not laid down.
    const double up = contact.normal_force.y > 0 ? 1 : -1;
    sum.normal += up * contact.normal_force.y;
    sum.tangential += up * contact.tangential_force.x;
    if (contact.normal_force.y == 0) continue;  // what bears nothing neither sticks nor slips
    ++sum.contacts;
    sum.slipping += contact.slipping ? 1 : 0;
  }
  return sum;
}

}  // namespace

TEST_CASE("A body whose gap closes under a load stops itself", "[figures]") {
  double pressed = 0, free = 0;
  const double stopped = final_gap({}, pressed);
  const double through = final_gap({{"/bodies/0/self_contact", "false"}}, free);
  INFO(fmt::format("gap {:.3e} m with and {:.3f} m without self-contact, jaws carry {:.3e} N/m", stopped,
                   through, pressed));
  CHECK(stopped < 0);
  CHECK(stopped > -2e-4);
  CHECK(through < -0.5);
  CHECK(free == 0);
  // The jaws are 2.4 m long, and the web takes part of the 1.5 MN/m.
  CHECK(pressed > 2e5);
  CHECK(pressed < 1.5e6);
}

TEST_CASE("A crack elsewhere lets no jaws meet that may not", "[figures]") {
  double ignored = 0;
  const double gap = final_gap({{"/bodies/0/self_contact", "false"},
                                {"/bodies/0/discontinuities", R"([{"points": [[-0.1, 0.8], [0.2, 0.8]]}])"}},
                               ignored);
  CHECK(gap < -0.5);
}

TEST_CASE("A body that is cut apart needs a row for its outline", "[figures]") {
  const std::string rest = R"("time": {"end": 0.001})";
  std::string text = cut_square(rest);
  const std::string row = R"(["rock", "rock"])";
  text.replace(text.find(row), row.size(), R"(["crack", "top"])");
  CHECK_THROWS_WITH(Simulation(from_text(text), {}),
                    Catch::Contains("cut it apart") && Catch::Contains("no row of /interfaces covers"));
  // A crack that ends within leaves it whole.
  CHECK_NOTHROW(
      Simulation(from_text(text, {{"/bodies/0/discontinuities/0/points", "[[-0.1, 0.5], [0.5, 0.5]]"}}), {}));
}

TEST_CASE("A closed crack carries compression as if it were not there", "[figures]") {
  const std::string text = cut_square(R"(
    "surface_loads": [{"body": "press", "surface": "top", "traction": [0, -1e6]},
                      {"body": "press", "surface": "bottom", "traction": [0, 1e6]}],
    "damping": 2000, "time": {"end": 0.02}, "output": {"history": 0.001})");
  Resultant crack;
  double cut_height = 0, whole_height = 0;
  const auto height = [](const Simulation& s) {
    return s.point_motion(0, {0.5, 1}).displacement.y - s.point_motion(0, {0.5, 0}).displacement.y;
  };
  const Course cut = run(from_text(text), "press", {}, [&](const Simulation& s) {
    crack = across_crack(s);
    cut_height = height(s);
  });
  const std::vector<Override> without_crack{{"/bodies/0/discontinuities", "[]"}, {"/interfaces", "[]"}};
  const Course whole = run(from_text(text, without_crack), "press", {},
                           [&](const Simulation& s) { whole_height = height(s); });
  const Motion &with = cut.motion.back(), &without = whole.motion.back();
  INFO(fmt::format(
      "stress_yy {:.2f} with and {:.2f} Pa without, crack carries {:.8g} N/m, height lost {:.6e} and "
      "{:.6e} m",
      with.stress_yy, without.stress_yy, crack.normal, -cut_height, -whole_height));
  CHECK(with.stress_yy == Approx(without.stress_yy).epsilon(1e-3));
  CHECK(with.stress_xx == Approx(0).margin(1e3));
  CHECK(with.stress_xy == Approx(0).margin(1e3));
  CHECK(crack.normal == Approx(1e6).epsilon(1e-3));
  // The penalty gives by p/α_N = 1e-5 m; forces are lumped to patches, so not quite evenly.
  CHECK(cut_height == Approx(whole_height - 1e-5).epsilon(1e-3));
}

TEST_CASE("The faces of a crack slide by the friction of their own surface", "[figures]") {
  // 0.2 MPa of shear is held, for tan 15 = 0.268; 0.3 MPa is not.
  const std::string text = cut_square(R"(
    "prescribed": [{"body": "press", "surface": "bottom", "stiffness": 1e11, "displacement": [0, 0]}],
    "surface_loads": [{"body": "press", "surface": "top",
      "traction": [{"scale": 1e6, "time": [[0, 0], [0.005, 0], [0.01, 0.2], [0.04, 0.2], [0.045, 0.3]]}, -1e6]}],
    "damping": 1000, "stages": [{"name": "free", "from": 0.04, "set": {"/damping": 0}}],
    "time": {"end": 0.05}, "output": {"history": 0.001})");
  Resultant held, sliding;
  double speed_held = 1, speed_sliding = 0;
  run(from_text(text), "press", {}, [&](const Simulation& s) {
    const double speed = s.point_motion(0, {0.5, 0.75}).velocity.x;
    if (s.time() < 0.0395) {
      held = across_crack(s);
      speed_held = speed;
    } else {
      sliding = across_crack(s);
      speed_sliding = speed;
    }
  });
  INFO(fmt::format("held {:.6g} of {:.6g} N/m at {:.1e} m/s, sliding {:.6g} of {:.6g} N/m at {:.3f} m/s",
                   held.tangential, held.normal, speed_held, sliding.tangential, sliding.normal,
                   speed_sliding));
  CHECK(held.normal == Approx(1e6).epsilon(1e-3));
  CHECK(held.tangential == Approx(-0.2e6).epsilon(0.01));
  CHECK(speed_held < 1e-3);
  CHECK(sliding.slipping == sliding.contacts);
  CHECK(sliding.tangential == Approx(-std::tan(std::acos(-1.0) / 12) * sliding.normal).epsilon(1e-3));
  CHECK(speed_sliding > 0.2);
}
