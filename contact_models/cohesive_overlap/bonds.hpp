#pragma once

#include "damage.hpp"

#include <talus/overlap/piece.hpp>

#include <vector>

namespace talus::cohesive_overlap {

using overlap::LoadSink;
using overlap::Piece;
using overlap::Point;

/// A point of a joint: two material points, one on either face, that were together when the bond formed.
struct Bond {
  double side_a, side_b;    ///< 1 + number of the corner where each face starts
  double lever_a, lever_b;  ///< where on the faces, 0 to 1
  double length;            ///< m, of the joint that it stands for
  double damage;            ///< 0 intact, 1 broken
  double opening, slip;     ///< m, at the step before
};

inline constexpr unsigned bond_doubles = 8;

inline Bond read_bond(const double* from) {
  return {from[0], from[1], from[2], from[3], from[4], from[5], from[6], from[7]};
}

inline void write_bond(const Bond& bond, double* to) {
  to[0] = bond.side_a, to[1] = bond.side_b, to[2] = bond.lever_a, to[3] = bond.lever_b;
  to[4] = bond.length, to[5] = bond.damage, to[6] = bond.opening, to[7] = bond.slip;
}

/// The two faces of a joint. Directions are the mean of both faces, so that neither body is preferred.
struct Faces {
  Piece a, b;
  std::uint32_t side_a, side_b;

  Point tangent() const {
    const Point sum = a.tangent(side_a) - b.tangent(side_b);
    const double size = length(sum);
    return size > 0 ? (1 / size) * sum : a.tangent(side_a);
  }
  static Point normal(Point tangent) { return {tangent.y, -tangent.x}; }  ///< out of a
};

/// Where a bond is now, in the directions of its faces, and how fast it parts.
struct BondState {
  Point at_a, at_b, tangent, normal;
  Separation separation;
  double opening_rate, slip_rate;  ///< m/s
};

inline BondState state_of(const Faces& faces, const Bond& bond) {
  const auto on = [](const Piece& piece, std::uint32_t side, double lever) {
    return (1 - lever) * piece.at(side) + lever * piece.at(piece.next(side));
  };
  const auto spin = [](const Piece& piece, std::uint32_t side) {
    const Point stretch = piece.velocity(piece.next(side)) - piece.velocity(side);
    return -dot(piece.normal(side), stretch) / piece.length(side);
  };
  BondState now{};
  now.at_a = on(faces.a, faces.side_a, bond.lever_a);
  now.at_b = on(faces.b, faces.side_b, bond.lever_b);
  now.tangent = faces.tangent();
  now.normal = Faces::normal(now.tangent);
  const Point apart = now.at_b - now.at_a;
  now.separation = {dot(now.normal, apart), dot(now.tangent, apart)};
  // The directions turn with the mean of both faces.
  const double turn = (spin(faces.a, faces.side_a) + spin(faces.b, faces.side_b)) / 2;
  const Point rate = faces.b.velocity_at(faces.side_b, bond.lever_b) -
                     faces.a.velocity_at(faces.side_a, bond.lever_a) - turn * Point{-apart.y, apart.x};
  now.opening_rate = dot(now.normal, rate);
  now.slip_rate = dot(now.tangent, rate);
  return now;
}

/// Two opposite forces at the two points, and the couples by which ½ k δ² depends on the directions of the
/// faces, half on each: no net moment, and the loads are the derivative of the energy.
inline void load_bond(const LoadSink& sink, const Faces& faces, const Bond& bond, const BondState& now,
                      Point on_b) {
  sink.on_side(faces.b, faces.side_b, bond.lever_b, on_b);
  sink.on_side(faces.a, faces.side_a, bond.lever_a, -1.0 * on_b);
  const double moment = cross(now.at_b - now.at_a, on_b);
  sink.couple(faces.a, faces.side_a, -moment / 2);
  sink.couple(faces.b, faces.side_b, -moment / 2);
}

/// Finds the faces of bonds, and pairs of faces that may be bonded.
class BondFinder {
 public:
  void take(const ContactBatch& batch, const BodyPair& pair) {
    faces_.clear();
    for (const PiecePair pieces : batch.piece_pairs.of(pair)) {
      const Piece a(batch.boundaries, pieces.a, {0, 0}, pieces.load_start);
      const Piece b(batch.boundaries, pieces.b, {pair.offset_x, pair.offset_y}, pieces.load_start + a.size());
      faces_.push_back({a, b, 0, 0});
    }
  }

  /// False where the two pieces are no neighbours any more.
  bool find(const Bond& bond, Faces& found) const {
    const auto a = static_cast<std::uint32_t>(bond.side_a - 1),
               b = static_cast<std::uint32_t>(bond.side_b - 1);
    for (const Faces& pieces : faces_) {
      const std::uint32_t side_a = a - pieces.a.first_corner(), side_b = b - pieces.b.first_corner();
      if (side_a >= pieces.a.size() || side_b >= pieces.b.size()) continue;  // wraps round below zero
      found = {pieces.a, pieces.b, side_a, side_b};
      return found.a.real(side_a) && found.b.real(side_b);
    }
    return false;
  }

  /// Calls visit(faces, lever_a, lever_b, beside, length) for two points of each stretch along which sides
  /// face each other, where they touch or overlap: those of Gauss, with which even bending is carried as by
  /// all of the stretch. `beside` is lever_a of the other one, whether that touches or not.
  template <class Visit>
  void find_touching(const Visit& visit) const {
    for (const Faces& pieces : faces_) {
      for (std::uint32_t i = 0; i < pieces.a.size(); ++i) {
        for (std::uint32_t j = 0; pieces.a.real(i) && j < pieces.b.size(); ++j) {
          if (pieces.b.real(j)) offer({pieces.a, pieces.b, i, j}, visit);
        }
      }
    }
  }

 private:
  /// Cosine of the angle up to which sides count as parallel, 5 degrees.
  static constexpr double parallel = 0.9961946980917455;

  template <class Visit>
  static void offer(const Faces& faces, const Visit& visit) {
    const Piece &a = faces.a, &b = faces.b;
    const std::uint32_t i = faces.side_a, j = faces.side_b;
    if (dot(a.tangent(i), b.tangent(j)) > -parallel) return;
    const double from = std::max(0.0, a.lever(i, b.at(b.next(j)))), to = std::min(1.0, a.lever(i, b.at(j)));
    const double stretch = (to - from) * a.length(i);
    if (!(stretch > 1e-6 * std::min(a.length(i), b.length(j)))) return;
    constexpr double half = 0.28867513459481287;  // 1/(2 √3)
    for (const double aside : {-half, half}) {
      const double lever_a = from + (0.5 + aside) * (to - from), beside = from + (0.5 - aside) * (to - from);
      const Point on_a = (1 - lever_a) * a.at(i) + lever_a * a.at(a.next(i));
      const double lever_b = std::clamp(b.lever(j, on_a), 0.0, 1.0), depth = b.depth(j, on_a);
      if (depth < -touching(faces) || !shallow(a, i, depth) || !shallow(b, j, depth)) continue;
      visit(faces, lever_a, lever_b, beside, stretch / 2);
    }
  }

 public:
  /// A gap that is only rounding, m.
  static double touching(const Faces& faces) {
    return 1e-9 * std::max(faces.a.length(faces.side_a), faces.b.length(faces.side_b));
  }

 private:
  /// Seen through a body its far side faces the other, too.
  static bool shallow(const Piece& piece, std::uint32_t side, double depth) {
    double most = 0;
    for (std::uint32_t k = 0; k < piece.size(); ++k) most = std::max(most, piece.depth(side, piece.at(k)));
    return depth < most / 2;
  }

  std::vector<Faces> faces_;
};

}  // namespace talus::cohesive_overlap
