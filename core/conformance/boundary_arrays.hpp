#pragma once

#include "conformance/held_body.hpp"
#include "geometry/straight_beyond.hpp"
#include "geometry/vanishing_depth.hpp"

#include <talus/contact_model.hpp>

#include <cmath>
#include <span>
#include <vector>

namespace talus::conformance {

/// The arrays of all bodies, as the host keeps them.
struct BoundaryArrays {
  std::vector<BoundaryCorner> corners;
  std::vector<double> clear_depth, straight_beyond;
  std::vector<std::uint32_t> piece_start{0}, body_piece{0}, corner_body;
  std::vector<std::uint8_t> is_strip;
  std::vector<Vec2> reference;

  explicit BoundaryArrays(const std::vector<HeldBody>& bodies) {
    for (std::uint32_t i = 0; i < bodies.size(); ++i) add(bodies[i], i);
    if (!straight_beyond.empty()) straight_beyond.resize(4 * corners.size());
  }

  void add(const HeldBody& body, std::uint32_t number) {
    const std::size_t first = corners.size(), first_piece = piece_start.size() - 1;
    for (const ConvexPiece& piece : body.pieces) {
      for (const PieceCorner& corner : piece) {
        const Vec2 u = displacement(body.motion, corner.at), v = velocity(body.motion, corner.at);
        corners.push_back(
            {corner.at.x + u.x, corner.at.y + u.y, 0, 0, v.x, v.y, 0, corner.surface, corner.cut});
        reference.push_back(corner.at), corner_body.push_back(number);
      }
      measure_sides(piece_start.back());
      const std::size_t begin = piece_start.back();
      clear_depth.push_back(vanishing_depth(&corners[begin], corners.size() - begin));
      piece_start.push_back(static_cast<std::uint32_t>(corners.size()));
      is_strip.push_back(body.strips ? 1 : 0);
    }
    body_piece.push_back(static_cast<std::uint32_t>(piece_start.size() - 1));
    if (body.strips || body.pieces.size() < 2) return;
    const std::vector<double> own = talus::straight_beyond(std::span(corners).subspan(first),
                                                           std::span(piece_start).subspan(first_piece));
    straight_beyond.resize(4 * first);
    straight_beyond.insert(straight_beyond.end(), own.begin(), own.end());
  }

  void measure_sides(std::size_t begin) {
    for (std::size_t i = begin; i < corners.size(); ++i) {
      BoundaryCorner& corner = corners[i];
      const BoundaryCorner& next = corners[i + 1 == corners.size() ? begin : i + 1];
      const double dx = next.x - corner.x, dy = next.y - corner.y;
      corner.length = std::sqrt(dx * dx + dy * dy);
      corner.tangent_x = corner.length > 0 ? dx / corner.length : 0;
      corner.tangent_y = corner.length > 0 ? dy / corner.length : 0;
    }
  }

  /// Surface class of a body that is plain as BodyPair says it; of others internal_side.
  std::uint32_t plain_surface(std::uint32_t body) const {
    if (body_piece[body + 1] != body_piece[body] + 1) return internal_side;
    const std::uint32_t begin = piece_start[body_piece[body]], end = piece_start[body_piece[body] + 1];
    if (end - begin > most_plain_corners) return internal_side;
    for (std::uint32_t c = begin; c < end; ++c) {
      if (corners[c].surface != corners[begin].surface) return internal_side;
    }
    return corners[begin].surface;
  }

  Boundaries view() const {
    return {corners.data(), piece_start.data(), is_strip.data(), clear_depth.data(),
            straight_beyond.empty() ? nullptr : straight_beyond.data()};
  }
};

}  // namespace talus::conformance
