#include "blocks/faces.hpp"
#include "geometry/segment_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {
namespace {

struct Segment {
  Vec2 from, to;
  std::uint32_t surface;
};

/// Segments of named lines, those of the domain first.
std::vector<Segment> named_segments(const Block& domain, const std::vector<Cut>& cuts) {
  std::vector<Segment> segments;
  for (std::size_t loop = 0; loop < domain.loops.size(); ++loop) {
    const Ring& ring = domain.loops[loop];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (domain.edge_surface[loop][i] != 0)
        segments.push_back({ring[i], ring[(i + 1) % ring.size()], domain.edge_surface[loop][i]});
    }
  }
  for (const Cut& cut : cuts) {
    for (std::size_t i = 1; cut.surface != 0 && i < cut.points.size(); ++i)
      segments.push_back({cut.points[i - 1], cut.points[i], cut.surface});
  }
  return segments;
}

bool is_near(const Segment& segment, Vec2 point, double tolerance) {
  return distance_from(point, segment.from, segment.to) <= tolerance;
}

std::vector<PlainSegment> places_of(const std::vector<Segment>& segments) {
  std::vector<PlainSegment> places;
  for (const Segment& segment : segments) places.push_back({segment.from, segment.to});
  return places;
}

/// Segments by place.
class Index {
 public:
  Index(const std::vector<Segment>& segments, double tolerance, const Geos& geos)
      : segments_(segments), tolerance_(tolerance), tree_(places_of(segments), geos) {}

  /// The first segment of the list that an edge lies on; nothing if it lies on none.
  const Segment* first_along(Vec2 from, Vec2 to) const {
    const Segment* found = nullptr;
    each_along(from, to, [&](const Segment* segment) {
      if (found == nullptr || segment < found) found = segment;
    });
    return found;
  }

  /// The tree tells what it finds in no order: the first segment of the list wins. Of a side too long to be
  /// that of a crossing `beaten` is told the name of another.
  std::uint32_t surface_of(Vec2 from, Vec2 to, NamesOfOneLine& beaten) const {
    const Segment* found = nullptr;
    const Segment* of_another_name = nullptr;
    each_along(from, to, [&](const Segment* segment) {
      const Segment* other = segment;
      if (found == nullptr || segment < found) std::swap(found, other);
      if (other == nullptr || other->surface == found->surface) return;
      if (of_another_name == nullptr || other < of_another_name) of_another_name = other;
    });
    if (found == nullptr) return 0;
    const bool long_enough = std::hypot(to.x - from.x, to.y - from.y) > 10 * tolerance_;
    if (of_another_name != nullptr && long_enough) beaten.emplace(found->surface, of_another_name->surface);
    return found->surface;
  }

 private:
  template <class LookAt>
  void each_along(Vec2 from, Vec2 to, const LookAt& look_at) const {
    const double margin = tolerance_;
    tree_.each_near({{std::min(from.x, to.x) - margin, std::min(from.y, to.y) - margin},
                     {std::max(from.x, to.x) + margin, std::max(from.y, to.y) + margin}},
                    [&](std::size_t number) {
                      const Segment* segment = &segments_[number];
                      if (is_near(*segment, from, tolerance_) && is_near(*segment, to, tolerance_))
                        look_at(segment);
                    });
  }

  const std::vector<Segment>& segments_;
  double tolerance_;
  SegmentTree tree_;
};

/// Each of the surface of that side of its corner which lies on the first of the lines.
std::vector<Segment> with_chords(const std::vector<Segment>& lines, const std::vector<Chord>& chords,
                                 double tolerance, const Geos& geos) {
  std::vector<Segment> segments = lines;
  if (chords.empty()) return segments;
  const Index drawn(lines, tolerance, geos);
  for (const Chord& chord : chords) {
    const Segment* from = drawn.first_along(chord.from, chord.corner);
    const Segment* to = drawn.first_along(chord.corner, chord.to);
    const Segment* first = from == nullptr || (to != nullptr && to < from) ? to : from;
    if (first != nullptr) segments.push_back({chord.from, chord.to, first->surface});
  }
  return segments;
}

}  // namespace

NamesOfOneLine name_edges(std::vector<Block>& blocks, const Block& domain, const std::vector<Cut>& cuts,
                          const std::vector<Chord>& chords, double tolerance, const Geos& geos) {
  NamesOfOneLine beaten;
  const std::vector<Segment> segments = with_chords(named_segments(domain, cuts), chords, tolerance, geos);
  const Index index(segments, tolerance, geos);
  for (Block& block : blocks) {
    block.edge_surface.clear();
    for (const Ring& ring : block.loops) {
      std::vector<std::uint32_t>& names = block.edge_surface.emplace_back();
      for (std::size_t i = 0; i < ring.size(); ++i)
        names.push_back(segments.empty() ? 0
                                         : index.surface_of(ring[i], ring[(i + 1) % ring.size()], beaten));
    }
  }
  return beaten;
}

}  // namespace talus
