#pragma once

#include "geometry/box.hpp"
#include "geometry/geos.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace talus {

struct PlainSegment {
  Vec2 from, to;
};

/// Finds segments by place.
class SegmentTree {
 public:
  SegmentTree(const std::vector<PlainSegment>& segments, const Geos& geos);

  /// Calls `take` with the numbers of all segments whose boxes meet the box, in no order.
  void each_near(const Box& box, const std::function<void(std::size_t)>& take) const;

 private:
  struct Destroy {
    GEOSContextHandle_t context;
    void operator()(GEOSSTRtree* tree) const { GEOSSTRtree_destroy_r(context, tree); }
  };

  const Geos& geos_;
  std::vector<std::size_t> numbers_;  ///< what the tree points to
  std::vector<Geos::Geometry> lines_;
  std::unique_ptr<GEOSSTRtree, Destroy> tree_;
};

}  // namespace talus
