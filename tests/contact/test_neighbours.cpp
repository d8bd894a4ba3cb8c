#include "contact/neighbours.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace talus;

namespace {

/// Bodies by hand: each has pieces that are triangles or quadrangles about its centre.
struct Crowd {
  Model model;

  Crowd() { model.piece_start.push_back(0); }

  void add_body(Vec2 centre, Kinematics kinematics) {
    Body body;
    body.kinematics = kinematics;
    body.centre = centre;
    model.bodies.push_back(body);
  }

  void add_piece(Vec2 offset, double half_width, double half_height, int corners) {
    const Vec2 at[4] = {{-half_width, -half_height},
                        {half_width, -half_height},
                        {half_width, half_height},
                        {-half_width, half_height}};
    for (int c = 0; c < corners; ++c) {
      model.reference_x.push_back(offset.x + at[c].x);
      model.reference_y.push_back(offset.y + at[c].y);
      model.surface.push_back(0);
      model.cut.push_back(0);
    }
    model.piece_body.push_back(static_cast<std::uint32_t>(model.bodies.size() - 1));
    model.piece_start.push_back(static_cast<std::uint32_t>(model.reference_x.size()));
  }
};

struct Random {
  std::mt19937 engine;
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
  }
};

Crowd crowd(unsigned seed, Vec2 origin, int bodies) {
  Random random{std::mt19937(seed)};
  Crowd result;
  for (int i = 0; i < bodies; ++i) {
    const auto kinematics =
        i % 7 == 0 ? Kinematics::fixed : (i % 2 == 0 ? Kinematics::rigid : Kinematics::affine);
    result.add_body({origin.x + random(0, 30), origin.y + random(0, 20)}, kinematics);
    const int pieces = i % 5 == 0 ? 3 : 1;
    for (int p = 0; p < pieces; ++p) {
      result.add_piece({p * random(0.2, 1), p * random(-0.5, 0.5)}, random(0.1, 0.9), random(0.1, 0.9),
                       3 + i % 2);
    }
  }
  return result;
}

/// Every pair of pieces, box against box.
std::vector<Candidate> brute_force(const Model& model, const MotionState& motion, double skin) {
  const auto gap = [&](std::uint32_t p, std::uint32_t q, bool along_x) {
    const auto range = [&](std::uint32_t piece) {
      const Vec2 centre = model.bodies[model.piece_body[piece]].centre;
      const double offset = along_x ? centre.x : centre.y;
      double low = INFINITY, high = -INFINITY;
      for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c) {
        const double at = offset + (along_x ? motion.corners[c].x : motion.corners[c].y);
        low = std::min(low, at);
        high = std::max(high, at);
      }
      return std::pair{low, high};
    };
    const auto [p_low, p_high] = range(p);
    const auto [q_low, q_high] = range(q);
    return std::max(q_low - p_high, p_low - q_high);
  };
  std::vector<Candidate> result;
  for (std::uint32_t p = 0; p < model.piece_body.size(); ++p) {
    for (std::uint32_t q = 0; q < model.piece_body.size(); ++q) {
      const std::uint32_t body_p = model.piece_body[p], body_q = model.piece_body[q];
      if (body_p >= body_q || (!model.moves(body_p) && !model.moves(body_q))) continue;
      if (gap(p, q, true) <= skin && gap(p, q, false) <= skin) result.push_back({body_p, body_q, p, q});
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

MotionState at_start(const Model& model) {
  MotionState motion(model);
  for (std::size_t c = 0; c < motion.corners.size(); ++c) {
    motion.corners[c].x = model.reference_x[c];
    motion.corners[c].y = model.reference_y[c];
  }
  return motion;
}

void check_against_brute_force(const Model& model, double skin) {
  MotionState motion = at_start(model);
  NeighbourSearch search(model);
  std::vector<Candidate> found{{7, 7, 7, 7}};  // whatever was there before goes
  search.find(model, motion, skin, found);
  CHECK(found == brute_force(model, motion, skin));
  CHECK(std::is_sorted(found.begin(), found.end()));

  // The same searcher again, after everything has moved.
  Random random{std::mt19937(99)};
  for (std::size_t c = 0; c < motion.corners.size(); ++c) {
    motion.corners[c].x += random(-0.3, 0.3);
    motion.corners[c].y += random(-0.3, 0.3);
  }
  search.find(model, motion, skin, found);
  CHECK(found == brute_force(model, motion, skin));
}

}  // namespace

TEST_CASE("the neighbour search finds what brute force finds", "[contact][neighbours]") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    for (const double skin : {0.0, 0.1, 0.7}) {
      INFO("seed " << seed << ", skin " << skin);
      const Crowd bodies = crowd(seed, {0, 0}, 150);
      REQUIRE_FALSE(brute_force(bodies.model, at_start(bodies.model), skin).empty());
      check_against_brute_force(bodies.model, skin);
    }
  }
}

TEST_CASE("very large bodies are neighbours of all they reach", "[contact][neighbours]") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    INFO("seed " << seed);
    Crowd bodies = crowd(seed, {0, 0}, 80);
    bodies.add_body({15, -1}, Kinematics::fixed);  // a base 1000 times as wide as a stone
    bodies.add_piece({0, 0}, 500, 2, 4);
    bodies.add_body({15, 10}, Kinematics::affine);  // a large body that moves, over everything
    bodies.add_piece({0, 0}, 40, 12, 4);
    bodies.add_body({0, 10}, Kinematics::rigid);  // and a tall one
    bodies.add_piece({0, 0}, 0.5, 300, 4);
    check_against_brute_force(bodies.model, 0.1);
  }
}

TEST_CASE("far from the origin the neighbours are the same", "[contact][neighbours]") {
  for (const Vec2 origin : {Vec2{5e5, 5e6}, Vec2{-3e6, 1e3}}) {
    const Crowd here = crowd(4, {0, 0}, 100), there = crowd(4, origin, 100);
    MotionState motion_here = at_start(here.model), motion_there = at_start(there.model);
    std::vector<Candidate> near, far;
    NeighbourSearch(here.model).find(here.model, motion_here, 0.1, near);
    NeighbourSearch(there.model).find(there.model, motion_there, 0.1, far);
    CHECK(near == far);
  }
}

TEST_CASE("bodies that touch are neighbours even without a skin", "[contact][neighbours]") {
  Crowd bodies;
  bodies.add_body({0, 0}, Kinematics::fixed);
  bodies.add_piece({0, 0}, 1, 1, 4);
  bodies.add_body({2, 0}, Kinematics::rigid);
  bodies.add_piece({0, 0}, 1, 1, 4);
  std::vector<Candidate> found;
  NeighbourSearch(bodies.model).find(bodies.model, at_start(bodies.model), 0, found);
  CHECK(found == std::vector<Candidate>{{0, 1, 0, 1}});
}
