#include "model/strips.hpp"

#include "geometry/segment_tree.hpp"
#include "model/fragments.hpp"

#include <talus/contact_model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace talus {
namespace {

constexpr double depth_share = 0.4;    ///< of the side of an equilateral triangle as large as the element's
constexpr double safe_share = 0.9;     ///< of the depth at which other parts of the boundary are as near
constexpr double longest_miter = 3;    ///< of the depth, along the bisector of a sharp corner
constexpr double smallest_turn = 0.1;  ///< rad, between sides that compete past a short one
constexpr std::size_t most_competitors = 4;  ///< per strip and direction

Vec2 inward(Vec2 tangent) {
  return {-tangent.y, tangent.x};
}
Vec2 unit(Vec2 p) {
  const double size = std::sqrt(dot(p, p));
  return size > 0 ? p / size : Vec2{};
}

struct ReferenceSide {
  Vec2 start, end, tangent;
  double length;
};

ReferenceSide reference_side(const Model& model, std::uint32_t side) {
  const Vec2 start = model.sides[side].start.reference, end = model.sides[side].end.reference;
  const Vec2 span = end - start;
  return {start, end, unit(span), std::sqrt(dot(span, span))};
}

/// The sides of a body, by where they are and which fragment they bound.
class SidesNear {
 public:
  SidesNear(const Model& model, std::uint32_t body)
      : first_(model.ranges(model.bodies[body]).side_begin),
        sides_(segments_of(model, body)),
        tree_(sides_, geos_) {
    const CoverRanges& ranges = model.ranges(model.bodies[body]);
    Fragments fragments(ranges);
    for (std::size_t e = model.elements.size(); e > 0 && model.element_body[e - 1] == body; --e)
      fragments.add(model.elements[e - 1]);
    for (std::uint32_t side = ranges.side_begin; side < ranges.side_end; ++side)
      fragment_.push_back(static_cast<std::uint32_t>(fragments.of(model.sides[side].start.carrier.patch[0])));
  }

  std::uint32_t fragment_of(std::uint32_t side) const { return fragment_[side - first_]; }

  /// Of the same fragment, where the boxes around both are within `gap` along x and y; in no order.
  void each_of_fragment(std::uint32_t side, double gap,
                        const std::function<void(std::uint32_t)>& visit) const {
    const PlainSegment& own = sides_[side - first_];
    Box box = box_around({own.from, own.to});
    box.low = box.low - Vec2{gap, gap};
    box.high = box.high + Vec2{gap, gap};
    tree_.each_near(box, [&](std::size_t other) {
      if (fragment_[other] == fragment_of(side)) visit(first_ + static_cast<std::uint32_t>(other));
    });
  }

 private:
  static std::vector<PlainSegment> segments_of(const Model& model, std::uint32_t body) {
    const CoverRanges& ranges = model.ranges(model.bodies[body]);
    std::vector<PlainSegment> segments;
    for (std::uint32_t side = ranges.side_begin; side < ranges.side_end; ++side)
      segments.push_back({model.sides[side].start.reference, model.sides[side].end.reference});
    return segments;
  }

  std::uint32_t first_;
  std::vector<PlainSegment> sides_;
  Geos geos_;
  SegmentTree tree_;
  std::vector<std::uint32_t> fragment_;  ///< [side]
};

/// Visits the sides further along a stretch without reflex corner, with the angle turned so far, until
/// `visit` says no or twice the depth is walked.
template <class Visit>
void walk(const Model& model, std::uint32_t side, double depth, bool onwards, const Visit& visit) {
  const auto step = [&](std::uint32_t s) { return onwards ? model.next_side[s] : model.previous_side[s]; };
  Vec2 tangent = reference_side(model, side).tangent;
  double turned = 0, walked = 0;
  for (std::uint32_t next = step(side); next != side && walked <= 2 * depth; next = step(next)) {
    const ReferenceSide there = reference_side(model, next);
    const double turn =
        (onwards ? 1 : -1) * std::atan2(cross(tangent, there.tangent), dot(tangent, there.tangent));
    if (turn < -1e-6) return;
    turned += turn;
    if (!visit(next, turned)) return;
    walked += there.length;
    tangent = there.tangent;
  }
}

/// Sides past the next one that are reached before twice the depth and look another way.
void find_competitors(const Model& model, std::uint32_t side, double depth, bool onwards,
                      std::vector<std::uint32_t>& competitors) {
  const std::uint32_t neighbour = onwards ? model.next_side[side] : model.previous_side[side];
  std::size_t found = 0;
  walk(model, side, depth, onwards, [&](std::uint32_t next, double turned) {
    if (next != neighbour && turned > smallest_turn && turned < 3) {
      competitors.push_back(next);
      ++found;
    }
    return found < most_competitors;
  });
}

double distance_to_side(Vec2 point, const ReferenceSide& side) {
  const Vec2 way = point - side.start;
  const Vec2 foot = side.start + std::clamp(dot(way, side.tangent), 0.0, side.length) * side.tangent;
  const Vec2 apart = point - foot;
  return std::sqrt(dot(apart, apart));
}

/// Inner bisector at the vertex between two sides, scaled to a depth of 1 behind both, cut short at sharp
/// corners.
Vec2 miter(Vec2 before, Vec2 after) {
  const Vec2 sum{-before.y - after.y, before.x + after.x};
  const double squared = dot(sum, sum);  // 4 cos² of half the turn
  const double longest = cross(before, after) > 0 ? longest_miter : std::sqrt(2.0);
  if (squared > 4 / (longest * longest)) return 2 * sum / squared;
  const double turn = cross(before, after);
  if (turn > 1e-6) {  // a sharp corner
    const Vec2 direction = unit(squared > 1e-12 ? sum : after - before);
    return longest_miter * direction;
  }
  // Around the tip of a crack, no farther than behind its faces.
  return squared > 1e-12 ? unit(sum) : unit(before - after);
}

/// A way along which a strip reaches its depth: t m behind the side it is at from + t direction.
struct Ray {
  Vec2 from, direction;
};

/// Depth behind a side at which another part of the boundary is as near, seen from three points of the side
/// and along the bisectors at its ends: to the lines of other sides where they are met, and to every corner.
/// Sides that compete with it have their say later; of other fragments there is none behind it. Exact as far
/// as it is below `wanted`: what is more than five times that away allows more, for bisectors are no longer
/// than three.
double equal_depth(const Model& model, std::uint32_t side, double wanted, const SidesNear& sides_near,
                   const std::vector<std::uint32_t>& competitors) {
  const auto is_beside = [&](std::uint32_t other) {
    return other == side || other == model.next_side[side] || other == model.previous_side[side] ||
           std::ranges::find(competitors, other) != competitors.end();
  };
  const ReferenceSide own = reference_side(model, side);
  const Vec2 normal = inward(own.tangent);
  const Vec2 before = reference_side(model, model.previous_side[side]).tangent,
             after = reference_side(model, model.next_side[side]).tangent;
  const double rounding = 1e-9 * model.side_size[side];  // faces of a crack coincide
  const auto is_tip = [](Vec2 p, Vec2 q) { return dot(p, q) < 0 && cross(p, q) < 1e-6; };
  struct End {
    Ray bisector;
    bool reflex, tip;
  };
  const auto end_between = [&](Vec2 at, Vec2 p, Vec2 q) {
    const bool tip = is_tip(p, q);
    return End{{at, miter(p, q)}, tip || cross(p, q) < -1e-6, tip};
  };
  const End ends[] = {end_between(own.start, before, own.tangent), end_between(own.end, own.tangent, after)};

  double least = std::numeric_limits<double>::infinity();
  sides_near.each_of_fragment(side, 5 * wanted, [&](std::uint32_t other) {
    if (is_beside(other)) return;
    const ReferenceSide there = reference_side(model, other);
    const auto meet = [&](const Ray& ray) {
      const Vec2 other_normal = inward(there.tangent);
      const double behind = dot(ray.from - there.start, other_normal),
                   opening = 1 - dot(ray.direction, other_normal);
      if (!(behind > rounding) || !(opening > 1e-6)) return;
      const double depth = behind / opening;
      const double place = dot(ray.from + depth * ray.direction - there.start, there.tangent);
      if (place >= 0 && place <= there.length) least = std::min(least, depth);
    };
    for (const double share : {0.0, 0.5, 1.0}) meet({own.start + share * own.length * own.tangent, normal});
    for (const End& end : ends) {
      meet(end.bisector);
      const double distance = end.tip ? distance_to_side(end.bisector.from, there) : 0;
      if (distance > rounding) least = std::min(least, distance / 2);
    }
    if (is_beside(model.previous_side[other])) return;
    for (const auto& [bisector, reflex, tip] : ends) {
      // Around a reflex corner the strip fans out.
      const Vec2 way = there.start - bisector.from;
      const double ahead = reflex ? dot(way, bisector.direction) : 0;
      if (ahead > rounding) least = std::min(least, dot(way, way) / (2 * ahead));
    }
    const Vec2 way = there.start - own.start;
    const double behind = dot(way, normal), along_side = dot(way, own.tangent);
    if (!(behind > rounding)) return;
    const double past = std::max({0.0, -along_side, along_side - own.length});
    least = std::min(least, (behind * behind + past * past) / (2 * behind));
  });
  return least;
}

using Corners = std::array<Vec2, 4 + 2 * most_competitors + 1>;

/// Keeps what is no deeper behind side k than behind the competitor; both ends of side k must stay.
std::size_t cut_towards(Corners& corners, std::size_t count, Vec2 tangent, Vec2 competitor_start,
                        Vec2 competitor_tangent) {
  const Vec2 own = inward(tangent), other = inward(competitor_tangent), start = corners[0];
  const auto lead = [&](Vec2 p) { return dot(p - competitor_start, other) - dot(p - start, own); };
  // The corners that go are in a row, whatever rounding makes of those that lie on the line.
  std::array<double, std::tuple_size_v<Corners>> leads;
  std::size_t first_behind = count, last_behind = 0;
  for (std::size_t i = 0; i < count; ++i) {
    leads[i] = lead(corners[i]);
    if (leads[i] >= 0) continue;
    first_behind = std::min(first_behind, i);
    last_behind = i;
  }
  if (first_behind < 2 || first_behind == count) return count;
  const auto crossing = [&](std::size_t behind, std::size_t ahead) {
    const double share = leads[ahead] / (leads[ahead] - leads[behind]);
    const Vec2 way = corners[behind] - corners[ahead];
    return corners[ahead] + share * way;
  };
  const Vec2 entry = crossing(first_behind, first_behind - 1),
             exit = crossing(last_behind, last_behind + 1 == count ? 0 : last_behind + 1);
  const std::size_t size = count - (last_behind + 1 - first_behind) + 2;
  if (size > count) {
    std::copy_backward(corners.begin() + last_behind + 1, corners.begin() + count, corners.begin() + size);
  } else {
    std::copy(corners.begin() + last_behind + 1, corners.begin() + count, corners.begin() + first_behind + 2);
  }
  corners[first_behind] = entry;
  corners[first_behind + 1] = exit;
  return size;
}

/// A side as short as rounding would have any direction: its ends become one, that of the side itself where
/// it is one of them.
void join_coincident(Corners& corners, std::size_t count, double depth) {
  const auto coincide = [&](std::size_t i, std::size_t j) {
    const Vec2 apart = corners[i] - corners[j];
    return dot(apart, apart) < 1e-18 * depth * depth;
  };
  for (std::size_t i = 2; i < count; ++i) {
    if (coincide(i, i - 1)) corners[i] = corners[i - 1];
  }
  for (std::size_t i = count; i-- > 2 && coincide(i, 0);) corners[i] = corners[0];
}

}  // namespace

void add_strips(Model& model, std::uint32_t index) {
  Body& body = model.bodies[index];
  CoverRanges& ranges = model.ranges(body);
  const SidesNear sides_near(model, index);
  std::vector<double> depths;
  for (std::uint32_t side = ranges.side_begin; side < ranges.side_end; ++side) {
    const double wanted = depth_share * model.side_size[side];
    std::vector<std::uint32_t> competitors;
    find_competitors(model, side, wanted, true, competitors);
    find_competitors(model, side, wanted, false, competitors);
    const double depth =
        std::min(wanted, safe_share * equal_depth(model, side, wanted, sides_near, competitors));
    depths.push_back(depth);
    const std::size_t corners = 4 + competitors.size();
    for (std::size_t c = 0; c < corners; ++c) {
      model.reference_x.push_back(c == 1 || c == 2 ? model.sides[side].end.reference.x
                                                   : model.sides[side].start.reference.x);
      model.reference_y.push_back(c == 1 || c == 2 ? model.sides[side].end.reference.y
                                                   : model.sides[side].start.reference.y);
      model.surface.push_back(c == 0 ? model.sides[side].surface : internal_side);
      model.cut.push_back(static_cast<std::uint32_t>(model.cut.size()));
    }
    model.piece_body.push_back(index);
    model.piece_start.push_back(static_cast<std::uint32_t>(model.surface.size()));
    model.is_strip.push_back(1);
    model.strips.push_back({side, depth, static_cast<std::uint32_t>(model.competitors.size()),
                            static_cast<std::uint32_t>(model.competitors.size() + competitors.size()),
                            sides_near.fragment_of(side)});
    model.piece_strip.push_back(static_cast<std::uint32_t>(model.strips.size() - 1));
    model.competitors.insert(model.competitors.end(), competitors.begin(), competitors.end());
  }
  std::nth_element(depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2),
                   depths.end());
  ranges.contact_depth = depths[depths.size() / 2];
}

void shape_strip(const Model& model, std::uint32_t piece, MotionState& motion) {
  const Body& body = model.bodies[model.piece_body[piece]];
  const std::uint32_t first_side = model.ranges(body).side_begin;
  const auto first_corner = [&](std::uint32_t side) {
    return model.piece_start[body.piece_begin + side - first_side];
  };
  const auto corner = [&](std::uint32_t c) { return Vec2{motion.corners[c].x, motion.corners[c].y}; };
  const auto tangent_of = [&](std::uint32_t side) {
    const std::uint32_t c = first_corner(side);
    return unit(corner(c + 1) - corner(c));
  };
  const Strip& strip = model.strips[model.piece_strip[piece]];
  const std::uint32_t first = model.piece_start[piece], last = model.piece_start[piece + 1];
  const Vec2 start = corner(first), end = corner(first + 1), span = end - start;
  const Vec2 tangent = unit(span), normal = inward(tangent);
  const Vec2 at_start = miter(tangent_of(model.previous_side[strip.side]), tangent);
  const Vec2 at_end = miter(tangent, tangent_of(model.next_side[strip.side]));
  double start_depth = strip.depth, end_depth = strip.depth;
  // The bisectors meet where the strip has no width left.
  const double start_behind = dot(at_start, normal), end_behind = dot(at_end, normal);
  if (start_behind > 0 && end_behind > 0) {
    const double closing = dot(at_start, tangent) / start_behind - dot(at_end, tangent) / end_behind;
    const double length = std::sqrt(dot(span, span));
    if (closing > 0) {
      start_depth = std::min(start_depth, length / closing / start_behind);
      end_depth = std::min(end_depth, length / closing / end_behind);
    }
  }
  Corners corners{start, end, end + end_depth * at_end, start + start_depth * at_start};
  std::size_t count = 4;
  for (std::uint32_t i = strip.competitor_begin; i < strip.competitor_end; ++i) {
    const std::uint32_t other = model.competitors[i];
    count = cut_towards(corners, count, tangent, corner(first_corner(other)), tangent_of(other));
  }
  join_coincident(corners, count, strip.depth);
  for (std::uint32_t c = first + 2; c < last; ++c) {
    const std::size_t from = std::min<std::size_t>(c - first, count - 1);
    const BoundaryCorner& led_by = motion.corners[from == 2 ? first + 1 : first];
    motion.corners[c].x = corners[from].x;
    motion.corners[c].y = corners[from].y;
    motion.corners[c].vx = led_by.vx;
    motion.corners[c].vy = led_by.vy;
  }
}

bool hang_together(const Model& model, const Strip& strip, std::uint32_t side) {
  bool met = model.next_side[strip.side] == side || model.previous_side[strip.side] == side;
  for (std::uint32_t i = strip.competitor_begin; i < strip.competitor_end; ++i)
    met = met || model.competitors[i] == side;
  for (const bool onwards : {true, false}) {
    walk(model, strip.side, strip.depth, onwards, [&](std::uint32_t next, double /*turned*/) {
      met = met || next == side;
      return !met;
    });
  }
  return met;
}

}  // namespace talus
