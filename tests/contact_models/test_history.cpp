#include "contact_models/law_bench.hpp"
#include "random/random.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::bench;

namespace {

bool same_bits(const Evaluation& p, const Evaluation& q) {
  if (p.corners.size() != q.corners.size() || p.history != q.history) return false;
  for (std::size_t i = 0; i < p.corners.size(); ++i) {
    if (p.corners[i].force.x != q.corners[i].force.x || p.corners[i].force.y != q.corners[i].force.y) {
      return false;
    }
  }
  return p.pairs[0].stored == q.pairs[0].stored && p.pairs[0].slip_loss == q.pairs[0].slip_loss;
}

void stop(std::vector<HeldBody>& bodies) {
  for (HeldBody& body : bodies) body.motion.velocity = {}, body.motion.rate = {};
}

}  // namespace

TEST_CASE("The same history gives the same bits: all state lives with the host", "[laws]") {
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : random_pairs(36)) {
      INFO(law << ", " << pair.name);
      LawBench bench(law), disturbed(law);
      bench.bodies = disturbed.bodies = pair.bodies;
      bench.step();
      disturbed.step();
      LawBench other(law);  // something else in between
      other.bodies = chamfered(0.01, 44, 4e-3).bodies;
      other.step();
      for (int i = 0; i < 3; ++i) disturbed.look(5e-4);
      CHECK(same_bits(bench.step(), disturbed.step()));
    }
  }
}

TEST_CASE("Bodies that stand still keep their tangential force", "[laws]") {
  for (const std::string& law : laws()) {
    for (const HeldPair& pair : random_pairs(72)) {
      INFO(law << ", " << pair.name);
      LawBench bench(law);
      bench.bodies = pair.bodies;
      bench.step();
      bench.step();
      stop(bench.bodies);
      bench.step();  // the dashpots let go, and with them may go a part of the limit
      const Evaluation first = bench.step();
      for (int i = 0; i < 5; ++i) CHECK(same_bits(first, bench.step()));
    }
  }
}

TEST_CASE("While friction is held stuck it takes what it must, past the limit", "[laws]") {
  for (const std::string& law : frictional_laws()) {
    INFO(law);
    LawBench bench(law, undamped_interface());
    bench.bodies = {box(-1, 0, 2, 1), box(0, 0.999, 1, 2)};
    bench.hold_stick = true;
    bench.step();
    bench.bodies[1].motion.velocity = {5, 0};
    const Vec2 held = bench.step(1e-3).on(1);  // 5 mm of slip
    CHECK(-held.x > 2 * std::tan(0.4363) * held.y);
    CHECK(-held.x == Approx(7e8 * 5e-3).epsilon(0.01));
    bench.hold_stick = false;
    bench.bodies[1].motion.velocity = {};
    const Vec2 freed = bench.step().on(1);
    CHECK(-freed.x == Approx(std::tan(25 * 3.14159265358979323846 / 180) * freed.y).epsilon(1e-3));
  }
}

TEST_CASE("A contact that opens forgets, and its spring energy is booked as lost", "[laws]") {
  for (const std::string& law : frictional_laws()) {
    INFO(law);
    LawBench bench(law, undamped_interface());
    bench.bodies = {box(-1, 0, 2, 1), box(0, 0.999, 1, 2)};
    bench.step();
    bench.bodies[1].motion.velocity = {0.1, 0};
    const Evaluation sheared = bench.step(1e-3);
    const double spring = 7e8 * 1e-4 * 1e-4 / 2;
    CHECK(sheared.pairs[0].stored == Approx(1e9 * 1e-6 / 2 + spring).epsilon(1e-3));
    bench.bodies[1].motion.velocity = {0, 2};
    const Evaluation opened = bench.step(1e-3);
    CHECK(opened.size() == 0);
    CHECK(opened.pairs[0].slip_loss == Approx(spring).epsilon(1e-3));
    bench.bodies[1].motion.velocity = {0, -2};
    CHECK(std::abs(bench.step(1e-3).on(1).x) < 1e-6);
  }
}

TEST_CASE("Overlaps that meet in a point at the back of one strip are contacts of their own at any rounding",
          "[laws]") {
  // A box in halves lies deeper in its base than the base's strips are: both halves are bounded by the back
  // of one strip, and meet there at the line that divides them.
  for (const std::string& law : frictional_laws()) {
    if (law == "vertex_edge") continue;
    INFO(law);
    LawBench bench(law);
    bench.bodies = {in_strips(box(-2, -1, 2, 0), 1, 0.01), in_strips(box(-0.5, -0.03, 0.5, 0.97), 2, 0.1)};
    Random random(5);
    std::size_t first = 0;
    for (int i = 0; i < 200; ++i) {
      bench.bodies[1].motion.h = {random.between(-1e-9, 1e-9), random.between(-1e-9, 1e-9),
                                  random.between(-1e-9, 1e-9), random.between(-1e-9, 1e-9)};
      bench.bodies[1].motion.u = {random.between(-1e-3, 1e-3), random.between(-1e-4, 1e-4)};
      const std::size_t contacts = bench.look().contacts.size();
      if (i == 0) first = contacts;
      CHECK(contacts == first);
    }
    CHECK(first >= 2);
  }
}

TEST_CASE("Friction is not forgotten where the load acts beside the overlap", "[laws]") {
  // Two acute corners, point on point, 1.4 mm deep: where the sides of the one are nearest is not in the
  // other.
  const HeldBody lower = held({{0.8101, 0.5863}, {-0.7794, 0.6266}, {0.3334, -0.9428}}),
                 pointed = held({{-4.0791, -1.5969}, {-0.7764, 0.6253}, {-4.1585, 0.1934}});
  // Dashpots would take all of the pressure away, and with it the friction.
  LawBench plain("overlap_area", undamped_interface()), general("overlap_area", undamped_interface());
  for (LawBench* bench : {&plain, &general}) {
    bench->bodies = {lower, pointed};
    bench->bodies[0].motion.velocity = {0.5, 1};
    bench->master_share = 1;
    bench->plain = bench == &plain;
    for (int step = 0; step < 5; ++step) bench->step(1e-5);
  }
  const double elastic = plain.history.begin()->second.history[0];
  CHECK(std::abs(elastic) > 1);
  CHECK(general.history.begin()->second.history[0] == Approx(elastic).epsilon(1e-6));
}

TEST_CASE("Contacts side by side are told apart however fast the frame moves in which they are seen",
          "[laws]") {
  // Two feet stand on a plate, which pushes and lets go of now the one, now the other.
  const auto slid = [](double speed) {
    WorkingScene text;
    text.interface = R"("normal_stiffness": 1e7, "tangential_stiffness": 1e7, "friction_angle": 20,
                        "normal_damping": 0.3, "tangential_damping": 0.3)";
    const std::string moving = fmt::format(R"("velocity": [{}, 0])", speed);
    text.bodies = box("plate", -0.1, -0.05, 0.1, 0, moving) +
                  R"(, {"name": "feet", "material": "rock", "polygon": [[-0.025, 0], [-0.015, 0],
                        [-0.015, 0.015], [0.015, 0.015], [0.015, 0], [0.025, 0], [0.025, 0.04],
                        [-0.025, 0.04]], )" +
                  moving + "}";
    text.time = R"({"end": 0.1, "dt": 4e-4})";
    text.rest = R"("limits": {"energy_residual": 1, "penetration": 1}, "loads": [
        {"body": "plate", "point": [0.004, -0.001],
         "force": [{"scale": -300, "time": [[0, 0], [0.1, 1], [0.2, -1], [0.3, 0]]}, 1000]},
        {"body": "feet", "point": [0.004, 0.016],
         "force": [{"scale": 300, "time": [[0, 0], [0.1, 1], [0.2, -1], [0.3, 0]]}, -1000]}],)";
    const Simulation simulation = run_to_end(text);
    return simulation.body_motion(1).displacement.x - simulation.body_motion(0).displacement.x;
  };
  const double due = slid(0);
  for (const double speed : {30.0, 55.0, 100.0, 500.0}) CHECK(slid(speed) == Approx(due).epsilon(1e-6));
}
