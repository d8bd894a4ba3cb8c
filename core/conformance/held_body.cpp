#include "conformance/held_body.hpp"

#include "geometry/polygon.hpp"

#include <cmath>
#include <numbers>

namespace talus::conformance {
namespace {

constexpr double degree = std::numbers::pi / 180;

Vec2 times(const Matrix2& m, Vec2 p) {
  return {m.xx * p.x + m.xy * p.y, m.yx * p.x + m.yy * p.y};
}

/// Q M Qᵀ.
Matrix2 conjugated(const Matrix2& q, const Matrix2& m) {
  const Vec2 x = times(q, {m.xx, m.yx}), y = times(q, {m.xy, m.yy});  // columns of Q M
  return {x.x * q.xx + y.x * q.xy, x.x * q.yx + y.x * q.yy, x.y * q.xx + y.y * q.xy, x.y * q.yx + y.y * q.yy};
}

}  // namespace

HeldBody held(const std::vector<Vec2>& outline, const std::vector<std::uint32_t>& surfaces) {
  const AreaMoments moments = ring_moments(outline, outline[0]);
  HeldBody body;
  body.centre = {outline[0].x + moments.x / moments.area, outline[0].y + moments.y / moments.area};
  Loop loop;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    loop.vertices.push_back(body.reference_of(outline[i]));
    loop.surface_class.push_back(surfaces.empty() ? 0 : surfaces[i]);
  }
  body.pieces = convex_pieces(loop, {});
  return body;
}

HeldBody held_as_it_is(const std::vector<Vec2>& ring) {
  HeldBody body;
  ConvexPiece& piece = body.pieces.emplace_back();
  for (const Vec2 at : ring) piece.push_back({at, 0, 0});
  return body;
}

HeldBody box(double left, double bottom, double right, double top) {
  return held({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

HeldBody in_strips(const HeldBody& body, int parts, double depth) {
  std::vector<Vec2> ring;
  const ConvexPiece& whole = body.pieces[0];
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Vec2 from = whole[i].at, to = whole[(i + 1) % whole.size()].at;
    for (int k = 0; k < parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      ring.push_back(from + share * (to - from));
    }
  }
  const std::size_t n = ring.size();
  std::vector<Vec2> inner;  // on the inner bisectors, `depth` behind both sides
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = ring[i] - ring[(i + n - 1) % n], after = ring[(i + 1) % n] - ring[i];
    const double p = size_of(before), q = size_of(after);
    const Vec2 sum{-before.y / p - after.y / q, before.x / p + after.x / q};
    const double scale = 2 * depth / dot(sum, sum);
    inner.push_back(ring[i] + scale * sum);
  }
  HeldBody result = body;
  result.strips = true;
  result.pieces.clear();
  std::uint32_t cut = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const std::uint32_t first = cut;
    cut += 3;
    result.pieces.push_back({{ring[i], whole[0].surface, 0},
                             {ring[next], internal_side, first},
                             {inner[next], internal_side, first + 1},
                             {inner[i], internal_side, first + 2}});
  }
  return result;
}

Isometry turned_by(double degrees) {
  const double c = std::cos(degrees * degree), s = std::sin(degrees * degree);
  return {{c, -s, s, c}, {0, 0}};
}

Isometry mirrored() {
  return {{-1, 0, 0, 1}, {0, 0}};
}

HeldBody moved(const Isometry& isometry, const HeldBody& body) {
  const Matrix2& q = isometry.q;
  const bool mirrors = q.xx * q.yy - q.xy * q.yx < 0;
  HeldBody result = body;
  result.centre = times(q, body.centre);
  result.centre.x += isometry.shift.x;
  result.centre.y += isometry.shift.y;
  result.motion.u = times(q, body.motion.u);
  result.motion.velocity = times(q, body.motion.velocity);
  result.motion.h = conjugated(q, body.motion.h);
  result.motion.rate = conjugated(q, body.motion.rate);
  for (ConvexPiece& piece : result.pieces) {
    for (PieceCorner& corner : piece) corner.at = times(q, corner.at);
    if (!mirrors) continue;
    // The ring runs the other way; a side now starts where it ended.
    const ConvexPiece old = piece;
    const std::size_t n = old.size();
    for (std::size_t i = 0; i < n; ++i) {
      piece[i] = old[(2 * n - 2 - i) % n];
      piece[i].at = old[n - 1 - i].at;
    }
  }
  return result;
}

BodyForce moved(const Isometry& isometry, const BodyForce& force) {
  return {times(isometry.q, force.force), conjugated(isometry.q, force.moment)};
}

}  // namespace talus::conformance
