#include "geometry/segment_tree.hpp"

#include <numeric>

namespace talus {

SegmentTree::SegmentTree(const std::vector<PlainSegment>& segments, const Geos& geos)
    : geos_(geos),
      numbers_(segments.size()),
      tree_(GEOSSTRtree_create_r(geos.context(), 8), Destroy{geos.context()}) {
  std::iota(numbers_.begin(), numbers_.end(), std::size_t{0});
  for (std::size_t i = 0; i < segments.size(); ++i) {
    lines_.push_back(geos.line({segments[i].from, segments[i].to}));
    GEOSSTRtree_insert_r(geos.context(), tree_.get(), lines_.back().get(), &numbers_[i]);
  }
}

void SegmentTree::each_near(const Box& box, const std::function<void(std::size_t)>& take) const {
  const auto pass_on = [](void* number, void* taker) {
    (*static_cast<const std::function<void(std::size_t)>*>(taker))(*static_cast<std::size_t*>(number));
  };
  const Geos::Geometry around = geos_.line({box.low, box.high});
  GEOSSTRtree_query_r(geos_.context(), tree_.get(), around.get(), pass_on,
                      const_cast<std::function<void(std::size_t)>*>(&take));
}

}  // namespace talus
