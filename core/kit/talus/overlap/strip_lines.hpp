#pragma once

#include <talus/overlap/closing_loads.hpp>
#include <talus/overlap/division_lines.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus::overlap {

/// Lines at which the strips of a body of many elements end, and along which the pressure jumps. The strips
/// on either side share one, and what presses on it from both cancels but for the jump; each knows its own
/// side only, so that lines are brought together by place.
class StripLines {
 public:
  /// `one_body`: both bodies of the pair are the same.
  void start(bool one_body) {
    lines_.clear();
    one_body_ = one_body;
    near_ = 0;
  }

  void add(const InnerSegment& line, const Piece& strip) {
    const std::uint32_t edge = line.segment.side;
    const bool at_vertex = edge == 1 || edge + 1 == strip.size();
    const Point known_by =
        at_vertex ? strip.at(edge == 1 ? 1 : 0) : 0.5 * (line.segment.at[0] + line.segment.at[1]);
    lines_.push_back({line, strip, known_by, at_vertex});
    near_ = std::max(near_, 1e-9 * strip.length(0));
  }

  void close(const LoadSink& sink, ClosingLoads& closing) {
    std::ranges::stable_sort(lines_, {}, [](const Line& line) { return line.known_by.x; });
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].taken) continue;
      const Point at = lines_[i].known_by;
      Meeting meeting;
      for (std::size_t j = i; j < lines_.size() && lines_[j].known_by.x - at.x <= near_; ++j) {
        if (meets(lines_[i], lines_[j])) take(lines_[j], meeting);
      }
      if (lines_[i].at_vertex)
        bear_at_vertex(sink, meeting.side[0], meeting.side[1], at, meeting.load);
      else
        bear_between(sink, meeting.side[0], meeting.side[1], at, meeting.load);
      closing.add(at, meeting.load.force, meeting.load.moment_about(at));
    }
  }

 private:
  struct Line {
    InnerSegment inner;
    Piece strip;
    Point known_by;  ///< the vertex that it goes through, or its middle
    bool at_vertex;
    bool taken = false;
  };

  /// Lines at one place, of one or two strips.
  struct Meeting {
    Balance load;
    LineSide side[2];  ///< at a vertex: that ends, and that starts there
  };

  bool meets(const Line& p, const Line& q) const {
    return !q.taken && p.at_vertex == q.at_vertex && (one_body_ || p.inner.body == q.inner.body) &&
           length(p.known_by - q.known_by) <= near_;
  }

  static void take(Line& line, Meeting& meeting) {
    line.taken = true;
    line.inner.add_to(meeting.load);
    const Piece* first = meeting.side[0].piece;
    const bool second = line.at_vertex
                            ? line.inner.segment.side != 1
                            : first != nullptr && first->first_corner() != line.strip.first_corner();
    meeting.side[second ? 1 : 0] = {&line.strip, 0};
  }

  std::vector<Line> lines_;
  bool one_body_ = false;
  double near_ = 0;  ///< m, of one place
};

}  // namespace talus::overlap
