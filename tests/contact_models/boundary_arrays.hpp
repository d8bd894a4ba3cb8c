#pragma once

#include "geometry/convex_pieces.hpp"
#include "model/motion.hpp"

#include <talus/contact_model.hpp>

#include <cmath>
#include <vector>

namespace talus::bench {

/// A body held against the law: its pieces relative to its centre, displaced by u + H X.
struct HeldBody {
  std::vector<ConvexPiece> pieces;
  Vec2 centre;
  BodyMotion motion;
  double mass = 2000;

  Vec2 reference_of(Vec2 world) const { return {world.x - centre.x, world.y - centre.y}; }
};

/// The arrays of all bodies, as the host keeps them.
struct BoundaryArrays {
  std::vector<double> x, y, vx, vy, tangent_x, tangent_y, length;
  std::vector<std::uint32_t> surface, cut, piece_start{0}, body_piece{0}, corner_body;
  std::vector<std::uint8_t> is_strip;
  std::vector<Vec2> reference;

  explicit BoundaryArrays(const std::vector<HeldBody>& bodies) {
    for (std::uint32_t i = 0; i < bodies.size(); ++i) add(bodies[i], i);
  }

  void add(const HeldBody& body, std::uint32_t number) {
    for (const ConvexPiece& piece : body.pieces) {
      for (const PieceCorner& corner : piece) {
        const Vec2 u = displacement(body.motion, corner.at), v = velocity(body.motion, corner.at);
        x.push_back(corner.at.x + u.x), y.push_back(corner.at.y + u.y);
        vx.push_back(v.x), vy.push_back(v.y);
        surface.push_back(corner.surface), cut.push_back(corner.cut);
        reference.push_back(corner.at), corner_body.push_back(number);
      }
      measure_sides(piece_start.back());
      piece_start.push_back(static_cast<std::uint32_t>(x.size()));
      is_strip.push_back(0);
    }
    body_piece.push_back(static_cast<std::uint32_t>(piece_start.size() - 1));
  }

  void measure_sides(std::size_t begin) {
    for (std::size_t i = begin; i < x.size(); ++i) {
      const std::size_t next = i + 1 == x.size() ? begin : i + 1;
      const double dx = x[next] - x[i], dy = y[next] - y[i];
      length.push_back(std::sqrt(dx * dx + dy * dy));
      tangent_x.push_back(length[i] > 0 ? dx / length[i] : 0);
      tangent_y.push_back(length[i] > 0 ? dy / length[i] : 0);
    }
  }

  Boundaries view() const {
    Boundaries all{};
    all.x = x.data(), all.y = y.data(), all.vx = vx.data(), all.vy = vy.data();
    all.tangent_x = tangent_x.data(), all.tangent_y = tangent_y.data(), all.length = length.data();
    all.surface = surface.data(), all.cut = cut.data(), all.piece_start = piece_start.data();
    all.is_strip = is_strip.data();
    return all;
  }
};

}  // namespace talus::bench
