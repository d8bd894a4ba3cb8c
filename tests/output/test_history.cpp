#include "files/whole_file.hpp"
#include "output/history.hpp"
#include "output/sampled.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace talus;

TEST_CASE("columns are monitor, quantity and unit", "[output][history]") {
  Scene scene;
  scene.monitors = {{"block", 0, {}, {"ux", "speed", "rotation"}}, {"toe", 0, Vec2{1, 2}, {"stress_xx"}}};
  CHECK(monitor_columns(scene) == std::vector<std::string>{"block.ux [m]", "block.speed [m/s]",
                                                           "block.rotation [deg]", "toe.stress_xx [Pa]"});
}

TEST_CASE("history.csv reads back to the same bits, row by row", "[output][history]") {
  const Scratch scratch;
  const std::vector<std::string> columns{"a.ux [m]", "a.uy [m]"};
  const std::vector<double> values{0.1 + 0.2, -1e-300};
  HistoryWriter writer(scratch / "history.csv", columns);
  CHECK(read_whole_file(scratch / "history.csv") == "t [s],a.ux [m],a.uy [m]\n");
  writer.add(0, values);
  CHECK(read_whole_file(scratch / "history.csv") ==
        "t [s],a.ux [m],a.uy [m]\n0,0.30000000000000004,-1e-300\n");
  writer.add(1.0 / 3, values);
  const Series series = read_series(scratch / "history.csv");
  CHECK(series.time == std::vector<double>{0, 1.0 / 3});
  CHECK(series.values[0] == std::vector<double>{values[0], values[0]});
}

TEST_CASE("displacements, speeds, angles in degrees and stresses follow from a motion", "[output][history]") {
  Motion motion{};
  motion.position = {1, 2};
  motion.displacement = {3, -4};
  motion.velocity = {-6, 8};
  motion.rotation = std::numbers::pi / 6;
  motion.stress_xx = -5;
  const auto value = [&](const char* name) {
    return value_of(find_quantity(name)->what, {motion, {500000, 5e6}});
  };
  CHECK(value("ux") == 3);
  CHECK(value("uy") == -4);
  CHECK(value("displacement") == 5);
  CHECK(value("vx") == -6);
  CHECK(value("vy") == 8);
  CHECK(value("speed") == 10);
  CHECK(value("rotation") == Approx(30).epsilon(1e-15));
  CHECK(value("x") == 500001);
  CHECK(value("y") == 5000002);
  CHECK(value("stress_xx") == -5);
  CHECK(find_quantity("colour") == nullptr);
}

TEST_CASE("a history that cannot be written says so", "[output][history]") {
  const Scratch scratch;
  const std::vector<std::string> columns{"a.ux [m]"};
  CHECK_THROWS_AS(HistoryWriter(scratch / "nowhere/history.csv", columns), std::system_error);
}
