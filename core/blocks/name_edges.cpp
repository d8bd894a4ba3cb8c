#include "blocks/faces.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
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

struct TreeEnd {
  GEOSContextHandle_t context;
  void operator()(GEOSSTRtree* tree) const { GEOSSTRtree_destroy_r(context, tree); }
};

/// Segments by place.
class Index {
 public:
  Index(const std::vector<Segment>& segments, double tolerance, const Geos& geos)
      : segments_(segments),
        tolerance_(tolerance),
        geos_(geos),
        tree_(GEOSSTRtree_create_r(geos.context(), 8), TreeEnd{geos.context()}) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      lines_.push_back(geos.line({segments[i].from, segments[i].to}));
      GEOSSTRtree_insert_r(geos.context(), tree_.get(), lines_.back().get(),
                           const_cast<Segment*>(&segments_[i]));
    }
  }

  /// The tree tells what it finds in no order: the first segment of the list wins. Of a side too long to be
  /// that of a crossing `beaten` is told the name of another.
  std::uint32_t surface_of(Vec2 from, Vec2 to, NamesOfOneLine& beaten) const {
    Search search{from, to, tolerance_, nullptr, nullptr};
    const double margin = tolerance_;
    const Geos::Geometry around =
        geos_.line({{std::min(from.x, to.x) - margin, std::min(from.y, to.y) - margin},
                    {std::max(from.x, to.x) + margin, std::max(from.y, to.y) + margin}});
    GEOSSTRtree_query_r(geos_.context(), tree_.get(), around.get(), look_at, &search);
    if (search.found == nullptr) return 0;
    const bool long_enough = std::hypot(to.x - from.x, to.y - from.y) > 10 * tolerance_;
    if (search.beaten != nullptr && long_enough)
      beaten.emplace(search.found->surface, search.beaten->surface);
    return search.found->surface;
  }

 private:
  struct Search {
    Vec2 from, to;
    double tolerance;
    const Segment* found;
    const Segment* beaten;  ///< the first of another name
  };

  static void look_at(void* item, void* data) {
    const auto* segment = static_cast<const Segment*>(item);
    auto& search = *static_cast<Search*>(data);
    if (!is_near(*segment, search.from, search.tolerance) || !is_near(*segment, search.to, search.tolerance))
      return;
    const Segment* other = segment;
    if (search.found == nullptr || segment < search.found) std::swap(search.found, other);
    if (other == nullptr || other->surface == search.found->surface) return;
    if (search.beaten == nullptr || other < search.beaten) search.beaten = other;
  }

  const std::vector<Segment>& segments_;
  double tolerance_;
  const Geos& geos_;
  std::unique_ptr<GEOSSTRtree, TreeEnd> tree_;
  std::vector<Geos::Geometry> lines_;
};

}  // namespace

NamesOfOneLine name_edges(std::vector<Block>& blocks, const Block& domain, const std::vector<Cut>& cuts,
                          double tolerance, const Geos& geos) {
  NamesOfOneLine beaten;
  const std::vector<Segment> segments = named_segments(domain, cuts);
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
