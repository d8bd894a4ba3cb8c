#include "geometry/convex_pieces.hpp"
#include "geometry/polygon.hpp"

#include <talus/contact_model.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>

using namespace talus;

namespace {

const double pi = std::acos(-1.0);

struct Shape {
  std::string name;
  Ring outer;
  std::vector<Ring> holes;  ///< clockwise
  std::size_t pieces;       ///< expected; 0 where only the rules count
};

const Ring square_hole{{1, 1}, {1, 2}, {2, 2}, {2, 1}};
const Ring triangular_hole{{4, 1}, {4.5, 2.5}, {5, 1}};

Ring star(int points) {
  Ring ring;
  for (int i = 0; i < 2 * points; ++i) {
    const double radius = i % 2 == 0 ? 2 : 0.8, angle = pi * i / points;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

Ring saw_tooth(int teeth) {
  Ring ring{{static_cast<double>(teeth), 2}, {0, 2}, {0, 1}};
  for (int i = 0; i < teeth; ++i) {
    ring.push_back({i + 0.5, 0.5});
    if (i + 1 < teeth) ring.push_back({i + 1.0, 1});
  }
  ring.push_back({static_cast<double>(teeth), 1});
  return ring;
}

std::vector<Shape> shapes() {
  return {
      {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}, 1},
      {"square with collinear vertices", {{0, 0}, {0.3, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0, 1}}, {}, 1},
      {"L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, {}, 2},
      {"T", {{-1, 0}, {1, 0}, {1, 3}, {3, 3}, {3, 4}, {-3, 4}, {-3, 3}, {-1, 3}}, {}, 3},
      {"U", {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {}, 3},
      {"L with collinear vertices", {{0, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, {}, 2},
      {"star", star(5), {}, 0},
      {"saw-tooth", saw_tooth(6), {}, 0},
      {"one hole", {{0, 0}, {6, 0}, {6, 4}, {0, 4}}, {square_hole}, 0},
      {"two holes", {{0, 0}, {6, 0}, {6, 4}, {0, 4}}, {square_hole, triangular_hole}, 0},
      {"two holes in a row",
       {{0, 0}, {6, 0}, {6, 3}, {0, 3}},
       {square_hole, {{4, 1}, {4, 2}, {5, 2}, {5, 1}}},
       0},
      {"thin spike outwards", {{0, 0}, {2, 0}, {2, 1}, {1.0001, 1}, {1, 5}, {0.9999, 1}, {0, 1}}, {}, 0},
      {"thin slit", {{0, 0}, {2, 0}, {2, 3}, {1.0001, 3}, {1, 1}, {0.9999, 3}, {0, 3}}, {}, 2},
      {"spiral",
       {{0, 0}, {5, 0}, {5, 5}, {1, 5}, {1, 2}, {3, 2}, {3, 3}, {2, 3}, {2, 4}, {4, 4}, {4, 1}, {0, 1}},
       {},
       0},
  };
}

Ring turned(const Ring& ring, double angle) {
  Ring result;
  for (const Vec2 p : ring) {
    result.push_back(
        {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y});
  }
  return result;
}

/// Every edge gets a surface class of its own.
Loop loop_of(const Ring& ring, std::uint32_t first_class) {
  Loop loop{ring, {}};
  for (std::uint32_t i = 0; i < ring.size(); ++i) loop.surface_class.push_back(first_class + i);
  return loop;
}

Vec2 between(Vec2 p, Vec2 q) {
  return {q.x - p.x, q.y - p.y};
}
double length(Vec2 p) {
  return std::sqrt(p.x * p.x + p.y * p.y);
}

struct Side {
  Vec2 from, to;
};

void check_convex(const ConvexPiece& piece) {
  REQUIRE(piece.size() >= 3);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec2 in = between(piece[i].at, piece[(i + 1) % piece.size()].at);
    const Vec2 out = between(piece[(i + 1) % piece.size()].at, piece[(i + 2) % piece.size()].at);
    CHECK(length(in) > 0);
    CHECK(cross(in, out) >= -1e-10 * length(in) * length(out));
  }
}

/// The sides of one class lie on its edge and follow one another from end to end.
void check_cover(Vec2 from, Vec2 to, const std::vector<Side>& sides) {
  const Vec2 edge = between(from, to);
  const double size = length(edge);
  std::vector<std::pair<double, double>> stretches;
  for (const Side& side : sides) {
    for (const Vec2 end : {side.from, side.to}) {
      CHECK(std::abs(cross(edge, between(from, end))) / size < 1e-12 * std::max(1.0, size));
    }
    const auto along = [&](Vec2 p) {
      const Vec2 away = between(from, p);
      return (away.x * edge.x + away.y * edge.y) / size;
    };
    stretches.emplace_back(along(side.from), along(side.to));
  }
  std::sort(stretches.begin(), stretches.end());
  double reached = 0;
  for (const auto& [start, end] : stretches) {
    CHECK(start == Approx(reached).margin(1e-12 * std::max(1.0, size)));
    CHECK(end > start);
    reached = end;
  }
  CHECK(reached == Approx(size).margin(1e-12 * std::max(1.0, size)));
}

std::vector<ConvexPiece> check_rules(const Ring& outer, const std::vector<Ring>& holes) {
  std::vector<Loop> hole_loops;
  auto classes = static_cast<std::uint32_t>(outer.size());
  double area = ring_moments(outer, outer[0]).area;
  for (const Ring& hole : holes) {
    hole_loops.push_back(loop_of(hole, classes));
    classes += static_cast<std::uint32_t>(hole.size());
    area += ring_moments(hole, outer[0]).area;
  }
  const Loop outer_loop = loop_of(outer, 0);
  const std::vector<ConvexPiece> pieces = convex_pieces(outer_loop, hole_loops);

  double sum = 0;
  std::map<std::uint32_t, std::vector<Side>> boundary, cuts;
  for (const ConvexPiece& piece : pieces) {
    check_convex(piece);
    Ring ring;
    for (const PieceCorner& corner : piece) ring.push_back(corner.at);
    const double part = ring_moments(ring, ring[0]).area;
    CHECK(part > 0);
    sum += part;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const bool internal = piece[i].surface == internal_side;
      auto& sides = internal ? cuts[piece[i].cut] : boundary[piece[i].surface];
      sides.push_back({piece[i].at, piece[(i + 1) % piece.size()].at});
    }
  }
  CHECK(sum == Approx(area).epsilon(1e-12));

  CHECK(boundary.size() == classes);
  const auto check_loop = [&](const Loop& loop) {
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      check_cover(loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()],
                  boundary[loop.surface_class[i]]);
    }
  };
  check_loop(outer_loop);
  for (const Loop& hole : hole_loops) check_loop(hole);

  for (const auto& [number, sides] : cuts) {
    INFO("cut " << number);
    CHECK(sides.size() >= 2);
    Vec2 closing{0, 0};
    for (const Side& side : sides) {
      const Vec2 along = between(side.from, side.to), first = between(sides[0].from, sides[0].to);
      CHECK(std::abs(cross(along, first)) < 1e-9 * length(first) * length(along));
      CHECK(std::abs(cross(between(sides[0].from, side.from), first)) < 1e-9 * length(first));
      closing = {closing.x + along.x, closing.y + along.y};
    }
    CHECK(length(closing) < 1e-12);  // as much on one side of the cut as on the other
  }
  return pieces;
}

double uniform(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0;
}

/// Around the origin, nowhere nearer to it than 1.5.
Ring ragged(std::mt19937& random) {
  const int corners = 5 + static_cast<int>(random() % 30);
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * pi * (i + 0.8 * uniform(random)) / corners, radius = 1.5 + 3 * uniform(random);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

Ring small_hole(std::mt19937& random) {
  const int corners = 3 + static_cast<int>(random() % 5);
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = -2 * pi * i / corners, radius = 0.2 + 0.3 * uniform(random);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

std::vector<double> sorted_areas(const std::vector<ConvexPiece>& pieces) {
  std::vector<double> areas;
  for (const ConvexPiece& piece : pieces) {
    Ring ring;
    for (const PieceCorner& corner : piece) ring.push_back(corner.at);
    areas.push_back(ring_moments(ring, ring[0]).area);
  }
  std::sort(areas.begin(), areas.end());
  return areas;
}

void check_alike(const std::vector<double>& areas, const std::vector<double>& others) {
  REQUIRE(areas.size() == others.size());
  for (std::size_t i = 0; i < areas.size(); ++i) CHECK(areas[i] == Approx(others[i]).margin(1e-9));
}

}  // namespace

TEST_CASE("bodies fall into convex pieces that keep area, boundary and cuts", "[geometry][pieces]") {
  for (const Shape& shape : shapes()) {
    for (const double angle : {0.0, 0.3, 1.1, 2.5}) {
      INFO(shape.name << " turned by " << angle);
      std::vector<Ring> holes;
      for (const Ring& hole : shape.holes) holes.push_back(turned(hole, angle));
      const std::vector<ConvexPiece> pieces = check_rules(turned(shape.outer, angle), holes);
      if (shape.pieces > 0) CHECK(pieces.size() == shape.pieces);
    }
  }
}

TEST_CASE("a convex body is its own only piece", "[geometry][pieces]") {
  const Ring ring{{0, 0}, {2, 0}, {3, 1}, {1, 3}};
  const std::vector<ConvexPiece> pieces = convex_pieces(loop_of(ring, 5), {});
  REQUIRE(pieces.size() == 1);
  REQUIRE(pieces[0].size() == 4);
  for (std::uint32_t i = 0; i < 4; ++i) {
    CHECK(pieces[0][i].at.x == ring[i].x);
    CHECK(pieces[0][i].at.y == ring[i].y);
    CHECK(pieces[0][i].surface == 5 + i);
  }
}

TEST_CASE("a cut runs along the inner bisector of its reflex vertex", "[geometry][pieces]") {
  const std::vector<ConvexPiece> pieces =
      convex_pieces(loop_of({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 0), {});
  REQUIRE(pieces.size() == 2);
  int internal = 0;
  for (const ConvexPiece& piece : pieces) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
      if (piece[i].surface != internal_side) continue;
      ++internal;
      const Vec2 along = between(piece[i].at, piece[(i + 1) % piece.size()].at);
      CHECK(along.x == Approx(along.y));
    }
  }
  CHECK(internal == 2);
}

TEST_CASE("ragged bodies of any outline are cut", "[geometry][pieces]") {
  std::mt19937 random(20);
  for (int body = 0; body < 200; ++body) {
    INFO("body " << body);
    const Ring outer = ragged(random), hole = small_hole(random);
    check_rules(outer, body % 2 == 0 ? std::vector<Ring>{} : std::vector<Ring>{hole});
  }
}

TEST_CASE("frames are cut at any angle, where cuts meet at one point and run along each other",
          "[geometry][pieces]") {
  std::mt19937 random(22);
  for (int body = 0; body < 400; ++body) {
    const int columns = 2 + body % 3, rows = 2 + body % 2;
    const double angle = 2 * pi * uniform(random);
    INFO(columns << " x " << rows << " windows turned by " << angle);
    std::vector<Ring> windows;
    for (int i = 0; i < columns * rows; ++i) {
      const double left = 1 + 2 * (i % columns), low = 1 + 2 * static_cast<double>(i / columns);
      Ring window{{left, low}, {left, low + 1}, {left + 1, low + 1}, {left + 1, low}};
      std::rotate(window.begin(), window.begin() + static_cast<int>(random() % 4), window.end());
      windows.push_back(turned(window, angle));
    }
    std::shuffle(windows.begin(), windows.end(), random);
    const double width = 2 * columns + 1, height = 2 * rows + 1;
    check_rules(turned({{0, 0}, {width, 0}, {width, height}, {0, height}}, angle), windows);
  }
}

TEST_CASE("pieces are the same from whichever corner, and in whichever direction, a body is listed",
          "[geometry][pieces]") {
  std::mt19937 random(21);
  for (int body = 0; body < 100; ++body) {
    INFO("body " << body);
    const Ring outer = ragged(random);
    const std::vector<double> areas = sorted_areas(convex_pieces(loop_of(outer, 0), {}));
    Ring other = outer;
    std::rotate(other.begin(), other.begin() + 1 + body % 4, other.end());
    check_alike(areas, sorted_areas(convex_pieces(loop_of(other, 0), {})));
    for (Vec2& corner : other) corner.x = -corner.x;
    std::reverse(other.begin(), other.end());
    check_alike(areas, sorted_areas(convex_pieces(loop_of(other, 0), {})));
  }
}

TEST_CASE("a body with a needle as thin as rounding is refused, not cut into pieces that lose area",
          "[geometry][pieces]") {
  const Loop body{{{-1.4374897480156505, -10.0625},
                   {-1.4376118183137123, -10.0626220703125},
                   {-1.4375507831574623, -10.06256103515625},
                   {-1.4374897480012123, -10.0625},
                   {-1.4375507831573486, -10.06256103515625},
                   {-1.4374897480010986, -10.0625},
                   {-1.3749897480010986, -10},
                   {9.947239875793457, -5.511456251144409},
                   {9.947342872619629, -5.5113303661346436},
                   {59.75, 61.75}},
                  std::vector<std::uint32_t>(10, 0)};
  CHECK_THROWS_WITH(convex_pieces(body, {}), Catch::Contains("cannot be cut into convex pieces near (-1.43"));
  // A slit 8e-13 m wide: one of the pieces went round its tip and counted as convex.
  const Loop slit{{{14.19824218750081, 18.135498046875},
                   {14.22656250000081, 18.163818359375},
                   {14.19580078125, 18.136962890625},
                   {14.2265625, 18.163818359375},
                   {14.1923828125, 18.192138671875},
                   {14.220703125, 18.220458984375},
                   {14.20361328125, 18.2216796875},
                   {14.25, 18.25},
                   {-120.25, 47},
                   {7.75, -2}},
                  std::vector<std::uint32_t>(10, 0)};
  CHECK_THROWS_WITH(convex_pieces(slit, {}), Catch::Contains("cannot be cut into convex pieces near (14.19"));
  // Sides as short are no harm where the direction of rounding leads nowhere.
  const Loop chamfer{{{0, 0}, {60, 0}, {60, 40}, {1e-8, 40}, {0, 40 - 1e-8}},
                     std::vector<std::uint32_t>(5, 0)};
  CHECK(convex_pieces(chamfer, {}).size() == 1);
}

TEST_CASE("of ways that are equally long the same is taken first, however the body lies",
          "[geometry][pieces]") {
  // A wall with battlements: two of its cuts would cross.
  const Ring castle{{0, 0},     {4, 0},     {4, 1.5}, {3, 1.5}, {3, 1},   {2.5, 1},
                    {2.5, 1.5}, {1.5, 1.5}, {1.5, 1}, {1, 1},   {1, 1.5}, {0, 1.5}};
  // Where the corners of all pieces are in the body's own axes.
  const auto corners_of = [&](std::size_t first, double angle, Vec2 shift) {
    const double c = std::cos(angle), s = std::sin(angle);
    Ring moved;
    for (std::size_t i = 0; i < castle.size(); ++i) {
      const Vec2 p = castle[(first + i) % castle.size()];
      moved.push_back({c * p.x - s * p.y + shift.x, s * p.x + c * p.y + shift.y});
    }
    std::vector<std::pair<double, double>> corners;
    for (const ConvexPiece& piece : convex_pieces(loop_of(moved, 0), {})) {
      for (const PieceCorner& corner : piece) {
        const Vec2 p = corner.at - shift;
        corners.emplace_back(std::round(1e6 * (c * p.x + s * p.y)), std::round(1e6 * (c * p.y - s * p.x)));
      }
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const auto due = corners_of(0, 0, {0, 0});
  for (std::size_t first = 0; first < castle.size(); ++first) {
    for (const double angle : {0.0, 0.7, 2.9}) CHECK(corners_of(first, angle, {1000.3, -300.1}) == due);
  }
}
