#pragma once

#include <talus/overlap/closing_loads.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus::overlap {

/// What presses on the lines at which strips end, within a body of many elements. The strips on either side
/// share such a line, and what presses on it from both cancels but where the stiffness is another beyond it.
/// What is left works as that line moves: through a vertex with that, turning as the two sides there do on
/// average; where sides further apart are equally near, with the distances to both.
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
      Meeting meeting{lines_[i].known_by};
      for (std::size_t j = i; j < lines_.size() && lines_[j].known_by.x - lines_[i].known_by.x <= near_;
           ++j) {
        if (meets(lines_[i], lines_[j])) take(lines_[j], meeting);
      }
      if (lines_[i].at_vertex)
        bear_at_vertex(sink, meeting);
      else
        bear_between(sink, meeting);
      closing.add(meeting.at, meeting.all.force, meeting.all.moment);
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
    Point at;
    Balance all{};
    const Piece* strip[2] = {nullptr, nullptr};  ///< at a vertex: whose side ends, and starts there

    double share() const { return strip[0] != nullptr && strip[1] != nullptr ? 0.5 : 1; }
  };

  static Point load(const Line& line, int end) { return line.inner.segment.load[end] * line.inner.inward; }

  bool meets(const Line& p, const Line& q) const {
    return !q.taken && p.at_vertex == q.at_vertex && (one_body_ || p.inner.body == q.inner.body) &&
           length(p.known_by - q.known_by) <= near_;
  }

  static void take(Line& line, Meeting& meeting) {
    line.taken = true;
    if (!meeting.all.started) meeting.all.add(meeting.at, {0, 0});
    for (int end = 0; end < 2; ++end) meeting.all.add(line.inner.segment.at[end], load(line, end));
    const bool second = line.at_vertex ? line.inner.segment.side != 1
                                       : meeting.strip[0] != nullptr &&
                                             meeting.strip[0]->first_corner() != line.strip.first_corner();
    meeting.strip[second ? 1 : 0] = &line.strip;
  }

  static void bear_at_vertex(const LoadSink& sink, const Meeting& meeting) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      if (meeting.strip[i] == nullptr) continue;
      sink.at_corner(*meeting.strip[i], 1 - i, meeting.share() * meeting.all.force);
      sink.couple(*meeting.strip[i], 0, meeting.share() * meeting.all.moment);
    }
  }

  /// Along the line depths d behind the two sides are equal: as those move it does by (δ₁ n₁ − δ₂ n₂)/|n₁ −
  /// n₂|.
  static void bear_between(const LoadSink& sink, const Meeting& meeting) {
    Point force[2] = {meeting.share() * meeting.all.force, meeting.share() * meeting.all.force};
    if (meeting.share() < 1) {
      const Point first = meeting.strip[0]->normal(0), second = meeting.strip[1]->normal(0);
      const double turn = cross(first, second);
      if (std::abs(turn) > least_turn) {
        force[0] = (cross(meeting.all.force, second) / turn) * first;
        force[1] = (cross(first, meeting.all.force) / turn) * second;
      }
    }
    for (int i = 0; i < 2; ++i) {
      if (meeting.strip[i] == nullptr) continue;
      sink.at_point(*meeting.strip[i], 0, meeting.at, force[i]);
      sink.couple(*meeting.strip[i], 0, meeting.share() * meeting.all.moment);
    }
  }

  static constexpr double least_turn = 0.05;  ///< sine, between sides that compete

  std::vector<Line> lines_;
  bool one_body_ = false;
  double near_ = 0;  ///< m, of one place
};

}  // namespace talus::overlap
