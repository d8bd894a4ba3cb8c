#include "noding.hpp"

#include "cells.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <span>

namespace talus::hexagonal {
namespace {

constexpr std::uint32_t no_node = 0xFFFFFFFFu;
constexpr int square_bits = 8;

struct Registration {
  std::uint64_t cell;  ///< row and column in one number
  std::uint32_t segment;
};

/// A node that a segment has to pass through.
struct Insertion {
  std::uint32_t segment, node;

  friend auto operator<=>(const Insertion&, const Insertion&) = default;
};

bool is_curve(const Segment& segment) {
  return segment.kind != EdgeKind::lattice;
}

/// Calls visit(segments of one cell) for each cell with a curve in it.
template <class Visit>
void visit_crowded_cells(const Nodes& nodes, const std::vector<Segment>& segments, Visit&& visit) {
  std::vector<Registration> registered;
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    visit_cells(nodes[segments[s].p], nodes[segments[s].q], [&](Cell cell) {
      const auto row = static_cast<std::uint32_t>(cell.j), column = static_cast<std::uint32_t>(cell.i);
      registered.push_back({std::uint64_t{row} << 32 | column, s});
    });
  }
  std::stable_sort(registered.begin(), registered.end(),
                   [](const Registration& m, const Registration& n) { return m.cell < n.cell; });
  const auto curve_in = [&](const Registration& entry) { return is_curve(segments[entry.segment]); };
  for (auto first = registered.begin(); first != registered.end();) {
    const auto last = std::find_if(first, registered.end(),
                                   [&](const Registration& entry) { return entry.cell != first->cell; });
    if (std::any_of(first, last, curve_in)) visit(std::span<const Registration>(first, last));
    first = last;
  }
}

bool passes_by(const Nodes& nodes, const Segment& segment, std::uint32_t node) {
  if (node == segment.p || node == segment.q) return false;
  const GridPoint p = nodes[segment.p], q = nodes[segment.q], n = nodes[node];
  const Wide along = dot(p, q, n);
  if (along <= 0 || along >= dot(p, q, q)) return false;
  const double length = std::hypot(static_cast<double>(q.a - p.a), static_cast<double>(q.b - p.b));
  return std::fabs(static_cast<double>(cross(p, q, n))) <= static_cast<double>(nodes.tolerance()) * length;
}

std::vector<Insertion> nodes_near_segments(const Nodes& nodes, const std::vector<Segment>& segments) {
  std::vector<Insertion> result;
  std::vector<std::pair<std::int64_t, std::uint32_t>> ends;  // of one cell, by a
  visit_crowded_cells(nodes, segments, [&](std::span<const Registration> cell) {
    ends.clear();
    for (const Registration& entry : cell) {
      for (const std::uint32_t node : {segments[entry.segment].p, segments[entry.segment].q}) {
        ends.push_back({nodes[node].a, node});
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const Registration& entry : cell) {
      const Segment& segment = segments[entry.segment];
      const auto [left, right] = std::minmax({nodes[segment.p].a, nodes[segment.q].a});
      auto end =
          std::lower_bound(ends.begin(), ends.end(), std::pair{left - nodes.tolerance(), std::uint32_t{0}});
      for (; end != ends.end() && end->first <= right + nodes.tolerance(); ++end) {
        if (passes_by(nodes, segment, end->second)) result.push_back({entry.segment, end->second});
      }
    }
  });
  return result;
}

int sign(Wide number) {
  return number > 0 ? 1 : number < 0 ? -1 : 0;
}

bool cross_inside(const Nodes& nodes, const Segment& s, const Segment& t) {
  const GridPoint sp = nodes[s.p], sq = nodes[s.q], tp = nodes[t.p], tq = nodes[t.q];
  if (std::max(sp.b, sq.b) < std::min(tp.b, tq.b) || std::max(tp.b, tq.b) < std::min(sp.b, sq.b))
    return false;
  return sign(cross(sp, sq, tp)) * sign(cross(sp, sq, tq)) < 0 &&
         sign(cross(tp, tq, sp)) * sign(cross(tp, tq, sq)) < 0;
}

/// On the first segment. The share is exact but for one rounding, however flat the crossing.
GridPoint crossing(const Nodes& nodes, const Segment& on, const Segment& other) {
  const GridPoint p = nodes[on.p], q = nodes[on.q], op = nodes[other.p], oq = nodes[other.q];
  const double before = std::fabs(static_cast<double>(cross(op, oq, p)));
  const double after = std::fabs(static_cast<double>(cross(op, oq, q)));
  const double share = before / (before + after);
  return {p.a + std::llround(share * static_cast<double>(q.a - p.a)),
          p.b + std::llround(share * static_cast<double>(q.b - p.b))};
}

std::vector<Insertion> crossings(Nodes& nodes, const std::vector<Segment>& segments) {
  struct Extent {
    std::int64_t left, right;
    std::uint32_t segment;
  };
  std::vector<Insertion> result;
  std::vector<Extent> extents;
  const auto cut = [&](std::uint32_t s, std::uint32_t t) {
    const bool on_t = segments[t].kind == EdgeKind::lattice;
    const std::uint32_t node = nodes.near(crossing(nodes, segments[on_t ? t : s], segments[on_t ? s : t]));
    for (const std::uint32_t segment : {s, t}) {
      if (node != segments[segment].p && node != segments[segment].q) result.push_back({segment, node});
    }
  };
  visit_crowded_cells(nodes, segments, [&](std::span<const Registration> cell) {
    extents.clear();
    for (const Registration& entry : cell) {
      const Segment& segment = segments[entry.segment];
      const auto [left, right] = std::minmax({nodes[segment.p].a, nodes[segment.q].a});
      extents.push_back({left, right, entry.segment});
    }
    std::sort(extents.begin(), extents.end(), [](const Extent& m, const Extent& n) {
      return m.left != n.left ? m.left < n.left : m.segment < n.segment;
    });
    for (std::size_t k = 0; k < extents.size(); ++k) {
      for (std::size_t l = k + 1; l < extents.size() && extents[l].left <= extents[k].right; ++l) {
        const auto [s, t] = std::minmax({extents[k].segment, extents[l].segment});
        if (!is_curve(segments[s]) && !is_curve(segments[t])) continue;
        if (cross_inside(nodes, segments[s], segments[t])) cut(s, t);
      }
    }
  });
  return result;
}

/// Returns whether anything was split.
bool split(const Nodes& nodes, std::vector<Segment>& segments, std::vector<Insertion> insertions) {
  if (insertions.empty()) return false;
  std::sort(insertions.begin(), insertions.end());
  insertions.erase(std::unique(insertions.begin(), insertions.end()), insertions.end());
  std::vector<Segment> pieces;
  auto insertion = insertions.begin();
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const auto first = insertion;
    while (insertion != insertions.end() && insertion->segment == s) ++insertion;
    const GridPoint p = nodes[segments[s].p], q = nodes[segments[s].q];
    std::sort(first, insertion, [&](const Insertion& m, const Insertion& n) {
      const Wide at_m = dot(p, q, nodes[m.node]), at_n = dot(p, q, nodes[n.node]);
      return at_m != at_n ? at_m < at_n : m.node < n.node;
    });
    Segment rest = segments[s];
    for (auto node = first; node != insertion; ++node) {
      Segment piece = rest;
      piece.q = rest.p = node->node;
      pieces.push_back(piece);
    }
    pieces.push_back(rest);
  }
  segments = std::move(pieces);
  return true;
}

}  // namespace

std::size_t Nodes::Hash::operator()(const GridPoint& square) const {
  std::uint64_t mixed = static_cast<std::uint64_t>(square.a) * 0x9E3779B97F4A7C15u;
  mixed = (mixed ^ (mixed >> 29) ^ static_cast<std::uint64_t>(square.b)) * 0xBF58476D1CE4E5B9u;
  return static_cast<std::size_t>(mixed ^ (mixed >> 32));
}

std::uint32_t Nodes::add(GridPoint at) {
  const std::uint32_t node = size();
  at_.push_back(at);
  const auto [entry, is_new] = square_.try_emplace({at.a >> square_bits, at.b >> square_bits}, node);
  next_.push_back(is_new ? no_node : entry->second);
  entry->second = node;
  return node;
}

std::uint32_t Nodes::nearest(GridPoint at, std::int64_t reach) const {
  std::uint32_t found = no_node;
  std::int64_t closest = reach + 1;
  for (std::int64_t a = (at.a - reach) >> square_bits; a <= (at.a + reach) >> square_bits; ++a) {
    for (std::int64_t b = (at.b - reach) >> square_bits; b <= (at.b + reach) >> square_bits; ++b) {
      const auto square = square_.find({a, b});
      std::uint32_t node = square != square_.end() ? square->second : no_node;
      for (; node != no_node; node = next_[node]) {
        const std::int64_t apart = std::max(std::abs(at_[node].a - at.a), std::abs(at_[node].b - at.b));
        if (apart > closest || (apart == closest && node > found)) continue;
        closest = apart;
        found = node;
      }
    }
  }
  return closest <= reach ? found : no_node;
}

std::uint32_t Nodes::vertex(GridPoint at) {
  const std::uint32_t found = nearest(at, 0);
  return found != no_node ? found : add(at);
}

std::uint32_t Nodes::near(GridPoint at) {
  at = onto_lattice(at, tolerance_);
  const std::uint32_t found = nearest(at, tolerance_);
  return found != no_node ? found : add(at);
}

void node_segments(Nodes& nodes, std::vector<Segment>& segments) {
  // Passing through a node bends a segment by no more than the tolerance, but that may close another gap.
  constexpr int most_rounds = 50;
  for (int round = 0; round < most_rounds; ++round) {
    const bool bent = split(nodes, segments, nodes_near_segments(nodes, segments));
    const bool cut = split(nodes, segments, crossings(nodes, segments));
    if (!bent && !cut) return;
  }
  throw TooClose();
}

}  // namespace talus::hexagonal
