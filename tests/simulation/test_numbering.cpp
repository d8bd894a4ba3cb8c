#include "simulation/numbering.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

using namespace talus;

namespace {

constexpr int columns = 105, rows = 20, boxes = columns * rows;

/// Boxes in columns on a floor, listed along the rows or in steps of 997 of them; one is pushed.
WorkingScene stacks(bool criss_cross) {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("floor", -1, -1, columns + 1, 0, R"("fixed": true)");
  for (int i = 0; i < boxes; ++i) {
    const int number = criss_cross ? (i * 997) % boxes : i, x = number % columns, y = number / columns;
    text.bodies += ", " + box(fmt::format("b{}", number), x + 0.01, y, x + 0.99, y + 1);
  }
  text.rest = fmt::format(R"("loads": [{{"body": "b{}", "point": [50.5, {}], "force": [1e4, 0]}}],)"
                          R"("stages": [{{"name": "late", "from": 1e-3, "set": {{"/loads": []}}}}],)",
                          (rows - 1) * columns + 50, rows - 0.5);
  text.interface =
      R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
         "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.time = R"({"end": 2e-3, "dt": 5e-5})";
  text.output = R"({"history": 1e-3})";
  return text;
}

std::map<std::string, Motion> motions(const Simulation& simulation) {
  std::map<std::string, Motion> all;
  for (std::size_t i = 0; i < simulation.body_count(); ++i)
    all[simulation.scene().bodies[i].name] = simulation.body_motion(i);
  return all;
}

}  // namespace

TEST_CASE("bodies are numbered anew where many are listed criss-cross", "[simulation][numbering]") {
  const Scene listed = stacks(false).read(), crossed = stacks(true).read();
  CHECK(numbering_of(listed).inner.empty());
  const Numbering numbering = numbering_of(crossed);
  REQUIRE(numbering.inner.size() == boxes + 1);
  const Scene within = renumbered(crossed, numbering);
  double last = -1;
  for (std::uint32_t i = 0; i < within.bodies.size(); ++i) {
    CHECK(numbering.inside(numbering.outside(i)) == i);
    if (within.bodies[i].fixed) continue;
    const double x = within.bodies[i].outer.vertices[0].x;
    CHECK(x >= last);
    last = x;
  }
  CHECK(within.bodies[within.loads[0].body].name == crossed.bodies[crossed.loads[0].body].name);
  Scene few = crossed;
  few.bodies.resize(500);
  CHECK(numbering_of(few).inner.empty());
}

TEST_CASE("numbers within a simulation change neither what happens nor what is called what",
          "[simulation][numbering]") {
  Simulation listed(stacks(false).read(), {}), crossed(stacks(true).read(), {});
  while (listed.advance()) {
  }
  while (crossed.advance()) {
  }
  CHECK(crossed.scene().bodies[2].name == "b997");
  const std::map<std::string, Motion> due = motions(listed), found = motions(crossed);
  REQUIRE(found.size() == due.size());
  double fall = 0, push = 0;
  for (const auto& [name, motion] : due) {
    const Motion& other = found.at(name);
    // They fall by 2e-5 m; sums in another order part them by rounding.
    CHECK(std::abs(other.displacement.x - motion.displacement.x) < 1e-13);
    CHECK(std::abs(other.displacement.y - motion.displacement.y) < 1e-13);
    CHECK(other.position.x == Approx(motion.position.x).epsilon(1e-12));
    fall = std::max(fall, -motion.displacement.y);
    push = std::max(push, motion.displacement.x);
  }
  CHECK(fall > 1e-6);
  CHECK(push > 1e-6);

  const std::vector<Contact> contacts = crossed.contacts();
  REQUIRE(contacts.size() == listed.contacts().size());
  std::pair<std::uint32_t, std::uint32_t> last{0, 0};
  for (const Contact& contact : contacts) {
    const std::pair<std::uint32_t, std::uint32_t> now{contact.body_a, contact.body_b};
    CHECK(now.first < now.second);
    CHECK(now >= last);
    last = now;
    const double a = crossed.body_motion(contact.body_a).position.y,
                 b = crossed.body_motion(contact.body_b).position.y;
    CHECK((contact.normal_force.y > 0) == (b > a));
  }
}

TEST_CASE("a settled geometry goes from one numbering to another", "[simulation][numbering]") {
  Simulation crossed(stacks(true).read(), {});
  while (crossed.advance()) {
  }
  const Geometry geometry = crossed.geometry();
  Scene scene = stacks(true).read();
  Simulation next(scene, {});
  CHECK(next.take_geometry(geometry).empty());
  CHECK(next.geometry().unknowns == geometry.unknowns);
  next.advance();
  const std::size_t pushed = scene.loads[0].body;
  CHECK(next.body_motion(pushed).position.x == crossed.body_motion(pushed).position.x);
}

TEST_CASE("a settled geometry does not go to patches that stand elsewhere", "[simulation][numbering]") {
  WorkingScene text;
  text.cover = R"(hexagonal", "size": 0.3, "slivers": "keep)";
  text.bodies = box("a", 0, 0, 1, 2.05);
  const Simulation kept(text.read(), {});
  text.cover = R"(hexagonal", "size": 0.3, "slivers": "merge)";
  Simulation merged(text.read(), {});
  const Geometry geometry = kept.geometry();
  REQUIRE(geometry.unknowns.size() == merged.geometry().unknowns.size());
  CHECK(merged.take_geometry(geometry) == "its bodies or patches are not those of the other");
}

TEST_CASE("a monitor sees what its body does, however bodies are numbered and covered",
          "[simulation][numbering]") {
  WorkingScene text = stacks(true);
  text.cover = "block";
  text.bodies += ", " + box("beam", 0, rows, 30, rows + 1, R"("cover": {"model": "hexagonal", "size": 0.7})");
  text.monitors = R"(
    {"name": "p", "body": "b4", "point": [4.2, 0.3], "quantities": ["ux", "stress_yy"]},
    {"name": "q", "body": "beam", "point": [20, 20.6], "quantities": ["stress_xx"]},
    {"name": "r", "body": "beam", "point": [20, 20.6], "quantities": ["uy"]},
    {"name": "s", "body": "beam", "quantities": ["vy", "stress_xy"]},
    {"name": "t", "body": "beam", "quantities": ["vy"]})";
  Simulation simulation(text.read(), {});
  while (simulation.advance()) {
  }
  const Scene& scene = simulation.scene();
  REQUIRE_FALSE(numbering_of(scene).inner.empty());
  for (std::size_t i = 0; i < scene.monitors.size(); ++i) {
    const Monitor& monitor = scene.monitors[i];
    const Motion seen = simulation.monitor_motion(i),
                 due = monitor.point ? simulation.point_motion(monitor.body, *monitor.point)
                                     : simulation.body_motion(monitor.body);
    INFO(monitor.name);
    CHECK(seen.position.x == due.position.x);
    CHECK(seen.displacement.y == due.displacement.y);
    CHECK(seen.velocity.y == due.velocity.y);
    CHECK(seen.rotation == due.rotation);
    CHECK(due.stress_yy != 0);
    const bool with_stress = monitor.name == "p" || monitor.name == "q" || monitor.name == "s";
    CHECK(seen.stress_xx == (with_stress ? due.stress_xx : 0));
    CHECK(seen.stress_yy == (with_stress ? due.stress_yy : 0));
    CHECK(seen.stress_xy == (with_stress ? due.stress_xy : 0));
  }
}
