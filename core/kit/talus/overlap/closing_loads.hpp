#pragma once

#include <talus/overlap/cell_loads.hpp>

namespace talus::overlap {

/// A stretch of a cell along a line within a body: a cut, the end of a strip, or one that divides the
/// overlap.
struct InnerSegment {
  std::uint32_t body;  ///< whose line it is
  bool between_sides;  ///< it divides the overlap between sides of that body
  Segment segment;
  Point inward;  ///< into the cell

  Point load(int end) const { return segment.load[end] * inward; }
  void add_to(Balance& all) const {
    for (int end = 0; end < 2; ++end) all.add(segment.at[end], load(end));
  }
};

/// A side that bears loads, and where.
struct LoadedSide {
  Piece piece;
  std::uint32_t side = 0;
  Point foot{0, 0};
  double load = 0;         ///< N/m
  bool as_master = false;  ///< it is that of the master of its cell
};

/// Where a deep overlap reaches past a cut, or the stiffness is another beyond it, the pressure jumps along a
/// line within a body and Eqs. 33–34 leave a remainder. The line moves with its body, so that one bears it,
/// as −∂Π/∂q has it: given to the other, which may be fixed, the motion would know nothing of it.
class ClosingLoads {
 public:
  void clear() {
    all_ = within_[0] = within_[1] = {};
    bears_[0] = bears_[1] = {};
  }

  /// A load that is on a body already.
  void add(Point at, Point load, double couple = 0) { all_.add(at, load, couple); }
  /// What presses on a line within a body, from one side; from the other its neighbour does.
  void add_within(std::uint32_t body, Point at, Point load) { within_[body].add(at, load); }
  /// Of these the side with the largest load takes what is left over on its body. A cell of a body and the
  /// one where it is slave often come with the same load: then rounding, or who is body a, must not decide.
  void may_bear(std::uint32_t body, const LoadedSide& side) {
    constexpr double alike = 1e-9;
    const LoadedSide& before = bears_[body];
    const double handicap = (before.as_master ? alike : 0) - (side.as_master ? alike : 0);
    if (side.load > (1 + handicap) * before.load && side.piece.length(side.side) > 0) bears_[body] = side;
  }

  /// Loads of both bodies so that nothing is left over.
  void close(const LoadSink& sink) {
    for (std::uint32_t body = 0; body < 2; ++body) {
      if (bears_[body].load > 0) put(sink, body, within_[body], 1);
    }
    const std::uint32_t last = bears_[0].load < bears_[1].load ? 1 : 0;
    if (bears_[last].load > 0) put(sink, last, all_, -1);  // rounding
  }

 private:
  void put(const LoadSink& sink, std::uint32_t body, const Balance& what, double sign) {
    const LoadedSide& at = bears_[body];
    const double lever = std::clamp(at.piece.lever(at.side, at.foot), 0.0, 1.0);
    const Point point = at.piece.point_at(at.side, lever);
    const Point force = sign * what.force;
    const double moment = sign * what.moment_about(point);
    sink.on_side(at.piece, at.side, lever, force);
    sink.couple(at.piece, at.side, moment);
    all_.add(point, force, moment);
  }

  Balance all_, within_[2];
  LoadedSide bears_[2];
};

}  // namespace talus::overlap
