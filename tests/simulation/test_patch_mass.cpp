#include "model/model.hpp"
#include "simulation/patch_mass.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace talus;

namespace {

/// A body of four free patches and one that follows patches 0, 1 and 2.
Model small_model(double inertia) {
  Model model;
  Body body;
  body.kinematics = Kinematics::covered;
  body.mass = 10;
  body.ranges = 1;
  CoverRanges& ranges = model.cover_ranges.emplace_back();
  ranges.patch_end = 5;
  ranges.steady_end = 1;
  model.bodies.push_back(body);
  model.patch_star.resize(5);
  const bool tied = std::isinf(inertia);
  model.patch_mass = {2, 3, 4, 1, tied ? 0 : 0.25};
  model.steady.push_back({4, {{0, 1, 2}, {1.5, 0.5, -1}}, inertia});
  return model;
}

}  // namespace

TEST_CASE("a tied patch follows exactly and hands its force on", "[simulation][patch_mass]") {
  const Model model = small_model(std::numeric_limits<double>::infinity());
  const PatchMass mass(model);
  std::vector<Vec2> field{{2, 0}, {3, 6}, {4, 8}, {1, 1}, {2, 4}};
  mass.accelerations(model, 0, {field, 0});
  CHECK(field[0].x == (2 + 1.5 * 2) / 2.0);
  CHECK(field[1].x == (3 + 0.5 * 2) / 3.0);
  CHECK(field[2].y == (8 - 4) / 4.0);
  CHECK(field[3].x == 1);
  CHECK(field[4].x == Approx(1.5 * field[0].x + 0.5 * field[1].x - field[2].x).epsilon(1e-15));
}

TEST_CASE("added inertia is felt by the deviation alone", "[simulation][patch_mass]") {
  const double inertia = 7;
  const Model model = small_model(inertia);
  const PatchMass mass(model);
  const std::vector<Vec2> force{{2, 1}, {3, -6}, {-4, 8}, {1, 1}, {5, -3}};
  std::vector<Vec2> acceleration = force;
  mass.accelerations(model, 0, {acceleration, 0});
  // (D + I r rᵀ) a = f, written out.
  const double r[5] = {-1.5, -0.5, 1, 0, 1};
  Vec2 along;
  for (std::size_t i = 0; i < 5; ++i)
    along = {along.x + r[i] * acceleration[i].x, along.y + r[i] * acceleration[i].y};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(model.patch_mass[i] * acceleration[i].x + inertia * r[i] * along.x ==
          Approx(force[i].x).epsilon(1e-13));
    CHECK(model.patch_mass[i] * acceleration[i].y + inertia * r[i] * along.y ==
          Approx(force[i].y).epsilon(1e-13));
  }
  // A field without deviation weighs as before; one with it weighs more.
  const std::vector<Vec2> uniform(5, Vec2{1, 0});
  CHECK(mass.product(model, 0, uniform, uniform) == Approx(10.25));
  const std::vector<Vec2> lone{{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 1}};
  CHECK(mass.product(model, 0, lone, lone) == Approx(0.25 + inertia));
}
