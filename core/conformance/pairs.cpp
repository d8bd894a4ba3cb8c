#include "conformance/pairs.hpp"

#include "random/random.hpp"

#include <cmath>
#include <numbers>

namespace talus::conformance {
namespace {

using std::numbers::pi;

using Ring = std::vector<Vec2>;

Vec2 turned(Vec2 p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

Ring polygon(Random& random, std::uint32_t corners) {
  Ring ring;
  const double step = 2 * pi / corners, first = random.between(0, 2 * pi);
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = first + step * (i + random.between(-0.12, 0.12));
    ring.push_back({std::cos(angle), std::sin(angle)});
  }
  return ring;
}

/// A place on a boundary and the direction out of the body there.
struct Feature {
  Vec2 at;
  double outward;  ///< rad
};

Feature side(const Ring& ring, Random& random) {
  const std::size_t i = random.below(ring.size());
  const Vec2 p = ring[i], q = ring[(i + 1) % ring.size()];
  const double t = random.between(0.3, 0.7);
  return {p + t * (q - p), std::atan2(p.x - q.x, q.y - p.y)};
}

Feature corner(const Ring& ring, Random& random) {
  const std::size_t n = ring.size(), i = random.below(n);
  const auto unit = [](Vec2 p, Vec2 q) {
    const double size = std::hypot(q.x - p.x, q.y - p.y);
    return (q - p) / size;
  };
  const Vec2 in = unit(ring[(i + n - 1) % n], ring[i]), out = unit(ring[(i + 1) % n], ring[i]);
  return {ring[i], std::atan2(in.y + out.y, in.x + out.x)};
}

/// Turns and moves b so that its feature stands `depth` behind that of a, facing it up to `tilt`.
HeldPair stand(const std::string& name, const Ring& a, Feature on_a, Ring b, Feature on_b, double tilt,
               double depth) {
  const double turn = on_a.outward + pi - on_b.outward + tilt;
  const Vec2 foot = turned(on_b.at, turn);
  const Vec2 goal{on_a.at.x - depth * std::cos(on_a.outward), on_a.at.y - depth * std::sin(on_a.outward)};
  for (Vec2& p : b) {
    const Vec2 q = turned(p, turn);
    p = q - foot + goal;
  }
  return {name, {held(a), held(b)}, depth};
}

HeldPair boxes(const std::string& name, HeldBody a, HeldBody b, double depth) {
  return {name, {std::move(a), std::move(b)}, depth};
}

}  // namespace

std::vector<HeldPair> random_pairs(std::uint32_t count) {
  constexpr std::uint32_t corners[] = {3, 4, 6};
  std::vector<HeldPair> pairs;
  Random random(20240607);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Ring a = polygon(random, corners[i % 3]), b = polygon(random, corners[i / 3 % 3]);
    const double depth = std::pow(10, random.between(-4, -2));
    const std::string number = std::to_string(i);
    switch (i / 9 % 4) {
      case 0:
        pairs.push_back(stand("corner on flat " + number, a, side(a, random), b, corner(b, random),
                              random.between(-0.15, 0.15), depth));
        break;
      case 1:
        pairs.push_back(stand("flat on flat " + number, a, side(a, random), b, side(b, random),
                              random.between(-0.1, 0.1) * depth, depth));
        break;
      case 2:
        pairs.push_back(stand("corner on corner " + number, a, corner(a, random), b, corner(b, random),
                              random.between(-0.15, 0.15), depth));
        break;
      default:
        pairs.push_back(stand("flat on corner " + number, a, corner(a, random), b, side(b, random),
                              random.between(-0.15, 0.15), depth));
    }
    set_moving(pairs.back(), i + 1);
  }
  return pairs;
}

std::vector<HeldPair> awkward_pairs() {
  std::vector<HeldPair> pairs;
  for (const double degrees : {0.0, 3.0, 44.0}) {
    for (const double chamfer : {0.01, 0.002}) pairs.push_back(chamfered(chamfer, degrees, 0.004));
  }
  pairs.push_back(boxes("a sliver of 4e-17 m", box(0, 0, 1, 0.5), box(0, 0.5 - 5.6e-17, 1, 1), 4e-17));
  pairs.push_back(
      boxes("a sliver beside a half brick", box(0, 0, 0.5, 0.5), box(0.5 - 5.6e-17, 0, 1.5, 0.5), 4e-17));
  pairs.push_back(boxes("a half brick on two", box(0, 0, 1, 0.5), box(0.5, 0.499, 1, 0.999), 1e-3));
  pairs.push_back(boxes("touching sides", box(0, 0, 1, 1), box(0, 1, 1, 2), 0));
  pairs.push_back(boxes("touching corners", box(0, 0, 1, 1), box(1, 1, 2, 2), 0));
  pairs.push_back(boxes("equal boxes, one a little up", box(0, 0, 1, 1), box(0, 0.999, 1, 1.999), 1e-3));
  pairs.push_back(boxes("box in the corner of a box", box(0, 0, 1, 1), box(0.999, 0.999, 2, 2), 1e-3));
  pairs.push_back(boxes("collinear subdivided edges",
                        held({{0, 0}, {3, 0}, {3, 1}, {2.5, 1}, {1.7, 1}, {1, 1}, {0.2, 1}, {0, 1}}),
                        held({{0.5, 0.998}, {1.2, 0.998}, {1.9, 0.998}, {2.2, 0.998}, {2.2, 2}, {0.5, 2}}),
                        2e-3));
  pairs.push_back(boxes("thin plates", box(0, 0, 1, 1e-3), box(0.2, 8e-4, 1.2, 1.8e-3), 2e-4));
  pairs.push_back(boxes("a needle", box(0, 0, 1, 1), held({{0.5, 0.99}, {0.5001, 2}, {0.4999, 2}}), 1e-2));
  pairs.push_back(saw_teeth(1e-3));
  pairs.push_back(body_in_notch(1e-3));
  for (std::size_t i = 0; i < pairs.size(); ++i) set_moving(pairs[i], 1000 + i);
  return pairs;
}

void set_moving(HeldPair& pair, std::uint64_t seed) {
  Random random(seed);
  for (HeldBody& body : pair.bodies) {
    const auto any = [&] { return random.between(-0.1, 0.1); };
    body.motion.velocity = {any(), any()};
    body.motion.rate = {any(), any(), any(), any()};
  }
}

HeldPair saw_teeth(double depth) {
  const Ring lower{{0, 0},     {4, 0},     {4, 1.1}, {3.5, 1.6}, {3, 1},  {2.5, 1.7},
                   {2.1, 1.2}, {1.5, 1.6}, {1, 1.1}, {0.4, 1.5}, {0, 1.2}};
  // The same line of teeth, moved down and a little aside, is the lower side of the upper body.
  const double aside = 0.2 * depth;
  Ring upper;
  for (std::size_t i = lower.size(); i-- > 2;) upper.push_back({lower[i].x + aside, lower[i].y - depth});
  upper.push_back({4 + aside, 3});
  upper.push_back({aside, 3});
  return {"saw teeth", {held(lower), held(upper)}, depth};
}

HeldPair body_in_notch(double depth) {
  const HeldBody notched = held({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2.1, 1}, {1, 1}, {1, 2}, {0, 2}});
  return {"body in a notch", {notched, box(1 - depth / 2, 1 - depth, 1.8, 1.9)}, depth};
}

HeldPair chamfered(double chamfer, double degrees, double depth) {
  const Ring ring{{chamfer, 0}, {1 - chamfer, 0}, {1, chamfer}, {1, 1}, {0, 1}, {0, chamfer}};
  HeldBody body = moved(turned_by(degrees), held(ring));
  double low = 1e300;
  for (const PieceCorner& corner : body.pieces[0]) low = std::fmin(low, body.centre.y + corner.at.y);
  body.centre.y += -low - depth;
  body.centre.x = 0;
  return {"chamfers of " + std::to_string(chamfer) + " m at " + std::to_string(degrees) + " degrees",
          {held({{-3, -2}, {3, -2}, {3, 0}, {-3, 0}}), body},
          depth};
}

}  // namespace talus::conformance
