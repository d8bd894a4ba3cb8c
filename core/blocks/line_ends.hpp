#pragma once

#include "blocks/cut.hpp"
#include "geometry/segment_tree.hpp"

#include <functional>
#include <vector>

namespace talus {

/// An end of a drawn line.
struct LineEnd {
  std::size_t line;  ///< number of the cut
  bool last;         ///< whether it is the last point of the line, or the first
  Vec2 at;
  Vec2 before;  ///< the point next to it
};

/// Those of lines that are not closed, in the order of the lines, the first of each first.
std::vector<LineEnd> ends_of(const std::vector<Cut>& cuts);

/// A straight part of a cut or of the domain's boundary.
struct LineSide {
  std::size_t line;  ///< number of the cut; those behind them are the loops of the domain
  std::size_t number;
  Vec2 from, to;
};

class SidesByPlace {
 public:
  /// What is at most `reach` (m) apart counts as meeting.
  SidesByPlace(const std::vector<Cut>& cuts, const Block& domain, double reach, const Geos& geos);

  /// Calls `take` with all sides at most `distance` (m) from an end and how far they are, but for those that
  /// lead to it: the last two of its own line, and others that lie along it and end there, too, as where a
  /// line is drawn twice.
  void each_near(const LineEnd& end, double distance,
                 const std::function<void(const LineSide&, double)>& take) const;

 private:
  std::vector<LineSide> sides_;
  std::vector<std::size_t> count_;  ///< [line]
  double reach_;
  SegmentTree tree_;
};

/// The cuts, each led on to what it ends within `reach` (m) of where it would not meet it if it were
/// lengthened by as much: ahead, or to the nearest point where that is too far or nothing is ahead.
std::vector<Cut> joined_ends(const std::vector<Cut>& cuts, const Block& domain, const SidesByPlace& sides,
                             double reach);

}  // namespace talus
