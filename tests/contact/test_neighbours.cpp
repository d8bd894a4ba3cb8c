#include "contact/neighbours.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

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
    model.is_strip.push_back(0);
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

/// Whether a piece lies outside of a side of another, far longer than common ones are, by more than the skin.
bool beyond_a_long_side(const Model& model, const MotionState& motion, std::uint32_t large,
                        std::uint32_t piece, double skin) {
  const auto at = [&](std::uint32_t of_piece, std::uint32_t corner) {
    const Vec2 centre = model.bodies[model.piece_body[of_piece]].centre;
    return Vec2{centre.x + motion.corners[corner].x, centre.y + motion.corners[corner].y};
  };
  const std::uint32_t begin = model.piece_start[large], count = model.piece_start[large + 1] - begin;
  double longest = 0;
  bool beyond = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 a = at(large, begin + i), b = at(large, begin + (i + 1) % count);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Vec2 outwards{(b.y - a.y) / length, (a.x - b.x) / length};
    double nearest = INFINITY;
    for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c) {
      const Vec2 p = at(piece, c);
      nearest = std::min(nearest, (p.x - a.x) * outwards.x + (p.y - a.y) * outwards.y);
    }
    longest = std::max(longest, length);
    beyond = beyond || nearest > skin;
  }
  return longest > 20 && beyond;
}

/// Every pair of pieces, box against box; of a long side of a fixed body, or of one beside a fixed one, those
/// that it reaches.
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
      if (gap(p, q, true) > skin || gap(p, q, false) > skin) continue;
      const bool one_fixed = !model.moves(body_p) || !model.moves(body_q);
      if (one_fixed &&
          (beyond_a_long_side(model, motion, p, q, skin) || beyond_a_long_side(model, motion, q, p, skin)))
        continue;
      result.push_back({p, q});
    }
  }
  std::sort(result.begin(), result.end(), CandidateOrder(model));
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
  std::vector<Candidate> found{{7, 7}};  // whatever was there before goes
  search.find(model, motion, skin, found);
  CHECK(found == brute_force(model, motion, skin));
  const auto bodies_and_pieces = [&](const Candidate& near) {
    return std::tuple{model.piece_body[near.piece_a], model.piece_body[near.piece_b], near.piece_a,
                      near.piece_b};
  };
  CHECK(std::is_sorted(found.begin(), found.end(), [&](const Candidate& p, const Candidate& q) {
    return bodies_and_pieces(p) < bodies_and_pieces(q);
  }));

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

TEST_CASE("a long slope that is fixed has those neighbours that it reaches, not all in its box",
          "[contact][neighbours]") {
  const auto stones_near = [](Kinematics slope) {
    Crowd bodies;
    bodies.add_body({0, 0}, slope);
    bodies.add_piece({0, 0}, 50, 1, 4);
    for (std::uint32_t c = 0; c < 4; ++c) bodies.model.reference_y[c] += bodies.model.reference_x[c] / 2;
    for (int i = 0; i < 20; ++i) {  // columns on the slope, of stones 1 m high with 0.05 m between
      for (int k = 0; k < 5; ++k) {
        const double x = 2.0 * i - 20;
        bodies.add_body({x, x / 2 + 1 + 0.25 + 0.55 + 1.05 * k}, Kinematics::rigid);
        bodies.add_piece({0, 0}, 0.5, 0.5, 4);
      }
    }
    std::vector<Candidate> found;
    NeighbourSearch(bodies.model).find(bodies.model, at_start(bodies.model), 0.1, found);
    return std::count_if(found.begin(), found.end(), [](const Candidate& near) { return near.piece_a == 0; });
  };
  CHECK(stones_near(Kinematics::fixed) == 20);
  CHECK(stones_near(Kinematics::affine) == 100);
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
  CHECK(found == std::vector<Candidate>{{0, 1}});
}

TEST_CASE("cells so far apart that they share a tag are told apart", "[contact][neighbours]") {
  // Squares that are alike: cells are half as large again as they are from corner to corner.
  constexpr double cell = 1.5 * 1.4142135623730951, columns = 65536;
  Random random{std::mt19937(3)};
  Crowd result;
  for (int i = 0; i < 300; ++i) {
    const double far = i % 3 * columns * cell;
    result.add_body({random(0, 20) + far, random(0, 20)}, Kinematics::affine);
    result.add_piece({0, 0}, 0.5, 0.5, 4);
  }
  check_against_brute_force(result.model, 0.1);
}

TEST_CASE("pieces in cells side by side that share a tag are found once", "[contact][neighbours]") {
  // Where both numbers of cells, counted from the first body, go below -32,768.
  constexpr double cell = 1.5 * 1.4142135623730951, corner = -32768 * cell;
  Random random{std::mt19937(4)};
  Crowd result;
  result.add_body({0, 0}, Kinematics::affine);
  result.add_piece({0, 0}, 0.5, 0.5, 4);
  for (int i = 0; i < 60; ++i) {
    result.add_body({corner + random(-3, 3), corner + random(-3, 3)}, Kinematics::affine);
    result.add_piece({0, 0}, 0.5, 0.5, 4);
  }
  check_against_brute_force(result.model, 0.1);
}
