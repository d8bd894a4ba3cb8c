#pragma once

#include "strips.hpp"
#include "vertex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace talus::vertex_edge {

/// A vertex of one body against a side of the other.
struct CornerContact {
  std::uint32_t entry;        ///< which piece pair of the pair
  std::uint32_t vertex_body;  ///< 0: the vertex belongs to body a, 1: to body b
  std::uint32_t vertex;       ///< corner of its piece
  std::uint32_t key;          ///< the vertex, known again at the next step
  std::uint32_t side;         ///< of the other body's piece
  double depth;               ///< m, behind the side; negative across an intact bond
  double lever;               ///< foot of the vertex along the side, 0 to 1 on it
  double tributary;           ///< m, length of boundary whose load the vertex carries
  double filled;        ///< share of half of force times depth that its spring holds: less than 1 where the
                        ///< tributary grows with the depth
  double in_corner;     ///< m, that length where it shares a reflex corner
  double slack;         ///< m, how far past the end of the side the vertex may be and still stand on it
  double share;         ///< of its spring: half where two corners that bear alike meet on each other's edges,
                        ///< see also `share_in_corner`; else 1
  bool meets_corner;    ///< two corners meet, and each stands on the other's edge
  bool past_cut;        ///< past the cut at the end of the side, where its piece cannot see it any more
  bool stands;          ///< on this side, not only on others that the same vertex was found at
  bool idle;            ///< neither of the sides of its body that meet in it faces the side
  bool bonded;          ///< by what has not broken yet
  Point before, after;  ///< tangents of the edges that meet in the vertex
};

/// Whether an edge is no more than a corner cut off, or rounding, between two others. The end of a thin plate
/// is none: its neighbours run back beside each other.
inline bool is_short(const Piece& piece, std::uint32_t edge) {
  constexpr double share = 1e-3, runs_back = -0.98;
  const std::uint32_t before = piece.previous(edge), after = piece.next(edge);
  const auto turns = [&](std::uint32_t other) {
    return dot(piece.tangent(other), piece.tangent(edge)) < straight;
  };
  return piece.length(edge) < share * std::max(piece.length(before), piece.length(after)) && turns(before) &&
         turns(after) && dot(piece.tangent(before), piece.tangent(after)) > runs_back;
}

/// Of the edges that meet in a vertex, the one that lies flatter on a side along `along`; a short one only
/// beside another. Where a cut ends in the vertex, the one that the piece has.
inline std::uint32_t flatter_edge(const Piece& own, std::uint32_t v, Point along) {
  if (own.is_strip()) return 0;
  const std::uint32_t before = own.previous(v);
  if (own.is_cut(before) != own.is_cut(v)) return own.is_cut(v) ? before : v;
  if (is_short(own, before) != is_short(own, v)) return is_short(own, v) ? before : v;
  return dot(own.tangent(before), along) < dot(own.tangent(v), along) ? before : v;
}

/// Share of its edges by which a corner may stand past the end of an edge and still be carried by it.
inline constexpr double flush = 0.01;

/// Share of a side of a body of many elements up to which its ends are near by another side.
inline constexpr double near_by = 0.1;

/// Sine of the angle from which on an edge does not lie flat on a side, and from which on it goes into it: 10
/// degrees.
inline constexpr double leaning = 0.17;

/// Entrance condition of DDA: a vertex stands on no side that its own edges go into, or that it hardly looks
/// at, if there is another. For those no deeper than this share of the shorter edge, as at rest, it holds as
/// it stands; deeper, as in hits, a side counts as further by this share per sine of the angle beyond
/// `leaning`.
inline constexpr double resting = 0.003, further = 4;

/// By how much the tributary of a vertex that lies flat on a side grows with its depth, m per m, as far as
/// `least_tributary`. Deep corners bear as those that lean do; one that slides over a joint hits the flank
/// behind that softly.
inline constexpr double grows = 20;

/// m, up to how deep behind a side the end of another counts as on it, though a flank is nearer. Lattices cut
/// off sides shorter than any overlap, so that of the side below counts as well.
inline double shallow(double own, double met) {
  return near_by * std::max(own, met / 2);
}

/// How far above a side a vertex still stands on it, m: held by a bond, and with what a step may have torn
/// that off, so that it is seen to break.
struct BondReach {
  double held, seen;
  bool intact = false;
};

/// Vertices that stand on (or, within `bond_reach`, just above) a side of the other piece. A corner against a
/// corner is resolved to an edge as in DDA: only sides that face the corner can carry it, and of those the
/// one it is least deep behind; where both corners then stand on each other's edges they share a spring.
class CornerFinder {
 public:
  /// Of one of the piece pairs of a pair of bodies; no bond reaches further than `farthest` m.
  template <class ReachOf>
  void find(std::span<const PiecePairGeometry> pieces, std::uint32_t entry, const ReachOf& bond_reach,
            double farthest, std::vector<CornerContact>& found) {
    const PiecePairGeometry& geometry = pieces[entry];
    const std::size_t first = found.size();
    for (std::uint32_t body = 0; body < 2; ++body) {
      const Piece& own = geometry.piece[body];
      const Piece& other = geometry.piece[1 - body];
      const Vertices vertices(pieces, body);
      const double margin = own.is_strip() ? 0 : margin_around(own, farthest);
      for (std::uint32_t v = 0; v < own.size(); ++v) {
        const std::optional<Vertex> vertex = own.is_strip()                     ? end_of_strip(own, v)
                                             : may_stand(own, other, v, margin) ? vertices.at(own, v)
                                                                                : std::nullopt;
        if (!vertex) continue;
        const std::uint32_t key = 2 * vertex->name + body;
        stand(pieces, own, other, *vertex, bond_reach(key),
              {entry, body, v, key, 0, 0, 0, 0, 1, 0, 0, 1, false, false, true, false, false, vertex->before,
               vertex->after},
              found);
      }
    }
    leave_to_ends(geometry, found, first);
    for (std::size_t i = first; i < found.size(); ++i) {
      for (std::size_t j = i + 1; j < found.size(); ++j) {
        if (!mutual(geometry, found[i], found[j])) continue;
        // One that bears next to nothing is no half of the other.
        const double more = std::max(found[i].tributary, found[j].tributary),
                     alike = more > 0 ? std::min(found[i].tributary, found[j].tributary) / more : 1;
        found[i].share = found[j].share = 1 - alike * alike / 2;
        found[i].meets_corner = found[j].meets_corner = true;
      }
    }
  }

 private:
  /// A body of many elements bends at every corner, and each side brings both of its ends.
  static std::optional<Vertex> end_of_strip(const Piece& own, std::uint32_t v) {
    if (v >= 2 || !own.real(0)) return std::nullopt;
    return Vertex{own.normal(0), {0, 0}, own.length(0), own.first_corner() + v, false};
  }

  /// m, further outside the other piece no corner stands on it.
  static double margin_around(const Piece& own, double farthest) {
    double around = 0;
    for (std::uint32_t i = 0; i < own.size(); ++i) around += own.length(i);
    return std::max(farthest, flush * around);
  }

  /// Most corners of a pair are far from the other body: what they look like is worth a look only where
  /// something may be stood on. Past a cut of the other piece a corner may stand by its own edges.
  static bool may_stand(const Piece& own, const Piece& other, std::uint32_t v, double margin) {
    const bool at_cut = own.is_cut(v) != own.is_cut(own.previous(v));
    if (!at_cut && own.is_cut(v)) return false;
    if (!at_cut && !other.is_strip() && has_cuts(other)) return true;
    for (std::uint32_t k = 0; k < other.size(); ++k) {
      if (other.depth(k, own.at(v)) < -margin) return false;
    }
    return true;
  }

  static bool has_cuts(const Piece& piece) {
    for (std::uint32_t k = 0; k < piece.size(); ++k) {
      if (piece.is_cut(k)) return true;
    }
    return false;
  }

  [[gnu::always_inline]] static void stand(std::span<const PiecePairGeometry> pieces, const Piece& own,
                                           const Piece& other, const Vertex& vertex, BondReach bond_reach,
                                           CornerContact contact, std::vector<CornerContact>& found) {
    const std::uint32_t v = contact.vertex;
    const Edges edges = edges_at(own, vertex, v);
    const Point at = own.at(v), outward = edges.before - edges.after;
    // A strip knows one side of its corner. At right angles to what it stands on, rounding would have it
    // stand on the far side of the other body instead.
    const double looks_away = own.is_strip() ? upright : 0;
    double nearest = std::numeric_limits<double>::infinity(), least = nearest;
    bool entered = false;
    for (std::uint32_t k = 0; k < other.size(); ++k) {
      const double faced = dot(outward, other.normal(k));
      if (!other.real(k) || faced >= looks_away) continue;
      const double depth = other.depth(k, at);
      if (depth <= 0 && depth <= -bond_reach.seen) return;
      // Collinear neighbours are equally deep; the vertex stands on the one its foot lies on.
      const double along = other.lever(k, at);
      const double distance = depth + other.length(k) * std::max({0.0, -along, along - 1});
      const double into = own.is_strip() ? 0 : edges.into(other.normal(k)),
                   weighed = distance * (1 + further * std::max(0.0, into - leaning));
      const bool idle = own.is_strip() && is_idle(own, v, other.normal(k));
      const bool beside = idle != contact.idle && std::isfinite(nearest) &&
                          (idle ? nearest : distance) <= near_by * own.length(0);
      const bool enters = into > leaning ||
                          (into > 0 && faced * faced < leaning * leaning * dot(outward, outward)),
                 in_reach = (enters ? nearest : distance) <= resting * vertex.shorter;
      const bool ranks = enters != entered && in_reach && std::isfinite(nearest);
      if (beside ? idle : ranks ? enters : weighed >= least) continue;  // what edges go into comes last
      contact.idle = idle;
      nearest = distance;
      least = weighed;
      entered = enters;
      contact.side = k;
      contact.depth = depth;
    }
    const double sought = std::max(contact.depth, bond_reach.held);
    double edge = vertex.shorter;
    if (!vertex.divided && (nearest > edge || sought > flush * edge))
      edge = shorter_edge(own, v);  // or it need not be known
    // Beyond its own edges a vertex sees the far side, but a strip ends before that.
    if (!(nearest <= (other.is_strip() ? std::max(edge, other.length(0)) : edge))) return;
    // Sides that look away bound the stretch of the edge; a corner flush with the end of the edge still
    // stands on it.
    contact.slack = std::min(sought, flush * edge);
    contact.bonded = bond_reach.intact;
    bool at_cut = false;
    for (std::uint32_t k = 0; k < other.size(); ++k) {
      if (k == contact.side || other.length(k) == 0) continue;
      // Behind a reflex corner a vertex is past the end of either face by its depth behind the other, over
      // the cut: as far as its edges reach, since a face lets go of it where it is no longer deep behind it.
      const bool ends_side = !other.is_strip() && other.is_cut(k) &&
                             (other.next(k) == contact.side || other.next(contact.side) == k);
      const double past = -other.depth(k, at);
      at_cut = at_cut || (other.is_cut(k) && past >= -1e-9 * edge);
      if (!(past > contact.slack)) continue;
      if (own.is_strip() && other.is_strip() && stays_before(own, other, contact, k)) continue;
      if (!ends_side || past > edge || !(contact.depth > 0)) return;
      contact.past_cut = true;
    }
    const std::array<Bound, 2> tips = tips_at_cuts(pieces, other, contact, at);
    if (tips[0].past > contact.slack || tips[1].past > contact.slack) return;
    if (vertex.divided && !has_flatter_edge(own, vertex, v, other.tangent(contact.side))) return;
    contact.lever = other.lever(contact.side, at);
    // Past the end of a strip only one that comes back over it stands there: the other lies on what follows,
    // and need not be listed with this one.
    const bool past_end = contact.lever < 0 || contact.lever > 1;
    if (past_end && own.is_strip() && other.is_strip() && (contact.lever > 0.5) != (contact.vertex == 0))
      return;
    if (at_cut && !contact.past_cut && is_before_another(pieces, at, outward, contact)) return;
    contact.tributary = tributary_length(pieces, contact);
    if (contact.depth > bond_reach.held && !own.is_strip()) {
      const double bears = share_that_bears(own, other, vertex, contact, tips);
      if (!(bears > 0)) return;
      contact.tributary *= bears;
    }
    // Both bodies bring the ends of all their sides: each does half.
    if (own.is_strip() && other.is_strip()) contact.share = 0.5;
    found.push_back(contact);
  }

  /// Whether the end of a strip, and its neighbour there, is at right angles to a side or looks away from it.
  /// Beside a side that one of them faces, such a one bears nothing: where equal bodies lie flush, a corner
  /// of the one is less deep behind the flank of the other than behind the face that it presses on.
  static bool is_idle(const Piece& own, std::uint32_t v, Point normal) {
    if (dot(own.normal(0), normal) < -upright) return false;
    const Point beyond = tangent_beyond(own, v);
    return !(dot(Point{beyond.y, -beyond.x}, normal) < -upright);
  }

  /// Whether the end of a strip, not deep behind the side that its foot lies on, stands there also past where
  /// the strip behind that ends, since the boundary turns outward: the strip behind the corner bears nothing
  /// of it.
  static bool stays_before(const Piece& own, const Piece& other, const CornerContact& contact,
                           std::uint32_t bisector) {
    if (!(dot(own.normal(0), other.normal(0)) < -upright) ||
        contact.depth > shallow(own.length(0), other.length(0)))
      return false;
    const double lever = other.lever(0, own.at(contact.vertex)), slack = contact.slack / other.length(0);
    if (!(lever >= -slack && lever <= 1 + slack)) return false;
    const Point beyond = tangent_across(other, bisector);
    return is_idle(own, contact.vertex, {beyond.y, -beyond.x});
  }

  /// An edge beside a side, and how far past it a vertex is, m; negative: behind it.
  struct Bound {
    Point normal{0, 0};
    double past = 0;
  };

  /// Of the corners at the ends of a side that point outward, and in which a cut of the body ends, the edges
  /// that other pieces have.
  static std::array<Bound, 2> tips_at_cuts(std::span<const PiecePairGeometry> pieces, const Piece& other,
                                           const CornerContact& contact, Point at) {
    std::array<Bound, 2> bounds;
    if (other.is_strip()) return bounds;
    const std::uint32_t start = contact.side, end = other.next(contact.side);
    for (const std::uint32_t corner : {start, end}) {
      if (!other.is_cut(corner == start ? other.previous(start) : end)) continue;
      const std::optional<Vertex> tip = Vertices(pieces, 1 - contact.vertex_body).at(other, corner);
      if (!tip) continue;
      const Point along = corner == start ? tip->before : tip->after, normal{along.y, -along.x};
      bounds[corner == start ? 0 : 1] = {normal, dot(at - other.at(corner), normal)};
    }
    return bounds;
  }

  /// A vertex that is past the end of its side bears only where an edge of its own goes on into the other
  /// body: by how deep that comes in, over its own depth. At a sharp tip it does not come in at all.
  static double share_that_bears(const Piece& own, const Piece& other, const Vertex& vertex,
                                 const CornerContact& contact, const std::array<Bound, 2>& tips) {
    const std::uint32_t v = contact.vertex;
    const Point at = own.at(v), edges[] = {-1.0 * vertex.before, vertex.after};
    const double lengths[] = {vertex.divided ? vertex.shorter : own.length(own.previous(v)),
                              vertex.divided ? vertex.shorter : own.length(v)};
    double least = 1;
    const auto lessen = [&](const Bound& bound) {
      if (!(bound.past > 0)) return;
      double most = 0;
      for (int i = 0; i < 2; ++i) {
        const double inward = -dot(edges[i], bound.normal);
        if (!(inward * lengths[i] > bound.past)) continue;
        const double depth = other.depth(contact.side, at + bound.past / inward * edges[i]);
        most = std::max(most, std::min(1.0, depth / contact.depth));
      }
      least = std::min(least, most);
    };
    for (std::uint32_t k = 0; k < other.size(); ++k) {
      if (k != contact.side && other.real(k)) lessen({other.normal(k), -other.depth(k, at)});
    }
    for (const Bound& tip : tips) lessen(tip);
    return least;
  }

  /// Whether a vertex at the cut of a piece, not flush with the end of its side, is before a side that faces
  /// it of the piece beyond: where a cut ends near a corner, the one sees the far side, the other the near.
  static bool is_before_another(std::span<const PiecePairGeometry> pieces, Point at, Point outward,
                                const CornerContact& contact) {
    const double touching = 1e-6 * contact.depth;
    const std::uint32_t met = 1 - contact.vertex_body;
    const Piece& side_of = pieces[contact.entry].piece[met];
    const double past_end = side_of.length(contact.side) * std::max(-contact.lever, contact.lever - 1);
    // At the corner itself rounding alone tells the two apart, and bonds form to both.
    if (contact.depth <= 1e-12 * side_of.length(contact.side)) return false;
    if (past_end > 0 && past_end <= contact.slack) return false;  // flush with it
    return std::ranges::any_of(pieces, [&](const PiecePairGeometry& pair) {
      const Piece& piece = pair.piece[met];
      if (piece.first_corner() == side_of.first_corner() || piece.is_strip()) return false;
      bool before = false;
      for (std::uint32_t k = 0; k < piece.size(); ++k) {
        const double depth = piece.depth(k, at);
        if (depth < -contact.slack) return false;
        before = before || (piece.real(k) && depth <= touching && dot(outward, piece.normal(k)) < 0);
      }
      return before;
    });
  }

  /// Tangents of the edges that meet in a vertex; of a short one what lies beyond it, for it says nothing of
  /// where the body is.
  struct Edges {
    Point before, after;

    /// How far either of them goes into a side: the sine of the angle, 0 where both stay before it.
    double into(Point normal) const { return std::max({0.0, dot(before, normal), -dot(after, normal)}); }
  };

  static Edges edges_at(const Piece& own, const Vertex& vertex, std::uint32_t v) {
    Edges edges{vertex.before, vertex.after};
    if (own.is_strip() || vertex.divided) return edges;
    const std::uint32_t before = own.previous(v), two_before = own.previous(before), after = own.next(v);
    if (is_short(own, before) && own.real(two_before) && !is_short(own, two_before))
      edges.before = own.tangent(two_before);
    else if (is_short(own, v) && own.real(after) && !is_short(own, after))
      edges.after = own.tangent(after);
    return edges;
  }

  /// Of the pieces that share a vertex the one with the edge that lies flatter on a side has the contact.
  static bool has_flatter_edge(const Piece& own, const Vertex& vertex, std::uint32_t v, Point along) {
    const double before = dot(vertex.before, along), after = dot(vertex.after, along);
    return own.is_cut(v) ? before <= after : after < before;
  }

  /// Corners that meet: one is past the end of its side where the other is, so that it stands there by its
  /// slack alone; or they are no further along the sides than they are deep, or than bonds reach that hold
  /// both.
  static bool mutual(const PiecePairGeometry& geometry, const CornerContact& p, const CornerContact& q) {
    if (p.past_cut || q.past_cut) return false;  // it stands on the other face of a reflex corner, or nowhere
    if (p.vertex_body == q.vertex_body || geometry.piece[0].is_strip() || geometry.piece[1].is_strip())
      return false;
    const auto at_start = [&](const CornerContact& contact, const CornerContact& other) {
      return contact.side == other.vertex;
    };
    const auto at_end = [&](const CornerContact& contact, const CornerContact& other) {
      return geometry.piece[1 - contact.vertex_body].next(contact.side) == other.vertex;
    };
    const auto past = [&](const CornerContact& contact, const CornerContact& other) {
      return (contact.lever < 0 && at_start(contact, other)) || (contact.lever > 1 && at_end(contact, other));
    };
    const auto near = [&](const CornerContact& contact, const CornerContact& other) {
      const Piece& piece = geometry.piece[1 - contact.vertex_body];
      const Point apart = geometry.piece[0].at(contact.vertex_body == 0 ? contact.vertex : other.vertex) -
                          geometry.piece[1].at(contact.vertex_body == 1 ? contact.vertex : other.vertex);
      const double along = std::abs(dot(apart, piece.tangent(contact.side)));
      return along <= std::max({contact.depth, other.depth, contact.slack, other.slack});
    };
    const auto ends_at = [&](const CornerContact& contact, const CornerContact& other) {
      return at_start(contact, other) || at_end(contact, other);
    };
    if (!ends_at(p, q) || !ends_at(q, p)) return false;
    return past(p, q) || past(q, p) || (near(p, q) && near(q, p));
  }

  /// Between a body of many elements and one piece both the ends of a side and the corners above it bear,
  /// each half of what faces the other. Where both ends stand they bear the whole side, and a corner flush
  /// with one of them no more than keeps it known.
  static void leave_to_ends(const PiecePairGeometry& geometry, std::vector<CornerContact>& found,
                            std::size_t first) {
    const auto of_strip = [&](std::uint32_t body) { return geometry.piece[body].is_strip(); };
    if (of_strip(0) == of_strip(1)) return;
    const auto start = found.begin() + static_cast<std::ptrdiff_t>(first);
    const auto ends = std::count_if(
        start, found.end(), [&](const CornerContact& contact) { return of_strip(contact.vertex_body); });
    if (ends < 2) return;
    for (auto contact = start; contact != found.end(); ++contact) {
      const std::uint32_t body = contact->vertex_body;
      if (of_strip(body)) continue;
      const Piece &own = geometry.piece[body], &other = geometry.piece[1 - body];
      const std::uint32_t edge = flatter_edge(own, contact->vertex, other.tangent(contact->side));
      contact->tributary = least_tributary(own.length(edge), other.length(contact->side));
      contact->filled = 1;
    }
  }

  /// m, of the edges that meet in a vertex, each with what lies straight beyond it; short ones left out.
  static double shorter_edge(const Piece& own, std::uint32_t v) {
    if (own.is_strip()) return own.length(0);
    std::uint32_t before = own.previous(v), after = v;
    // Mostly the shorter one ends where it is.
    const bool first = own.length(before) < own.length(after);
    const std::uint32_t shorter = first ? before : after,
                        beyond = first ? own.previous(before) : own.next(after);
    if (!is_short(own, shorter) && !own.is_cut(beyond) &&
        !(dot(own.tangent(shorter), own.tangent(beyond)) >= straight))
      return own.length(shorter);
    if (is_short(own, before)) before = own.previous(before);
    if (is_short(own, after)) after = own.next(after);
    const auto length = [&](std::uint32_t edge) {
      const auto [low, high] = straight_run(own, edge);
      return high - low;
    };
    return std::min(length(before), length(after));
  }

  /// Half of the stretch over which the vertex's flatter edge faces the other body, so that the two corners
  /// of a flat contact carry α_N L together. Notes what the spring of one that grows with its depth holds.
  static double tributary_length(std::span<const PiecePairGeometry> pieces, CornerContact& contact) {
    const std::uint32_t body = contact.vertex_body, side = contact.side;
    const Piece &own = pieces[contact.entry].piece[body], &other = pieces[contact.entry].piece[1 - body];
    const Point along = other.tangent(side);
    if (own.is_strip() && other.is_strip()) return own.length(0) / 2 * std::abs(dot(own.tangent(0), along));
    const std::uint32_t edge = flatter_edge(own, contact.vertex, along);
    const auto [own_low, own_high] = straight_run(own, edge, !other.is_strip());
    const double start = dot(along, own.at(edge) + own_low * own.tangent(edge) - other.at(side));
    const double end = dot(along, own.at(edge) + own_high * own.tangent(edge) - other.at(side));
    const auto [low, high] = straight_run(other, side, true);
    const double shadow = std::min(high, std::max(start, end)) - std::max(low, std::min(start, end));
    // A side that stands upright on the other, at the end of a base, carries nothing there.
    if (own.is_strip()) return std::max(shadow, 0.0) / 2;
    // An edge that lies flat on the side bears what faces it: past the end of the side, or over a joint to
    // the next, that is next to nothing. One that leans bears the least at any depth.
    const double least = least_tributary(own_high - own_low, high - low),
                 leans = std::abs(dot(own.tangent(edge), other.normal(side))) / leaning;
    const double faces = std::max(shadow / 2, least * std::min(leans, 1.0));
    if (!(contact.depth > 0 && grows * contact.depth > faces && faces < least)) return faces;
    // With a length t that grows so its spring holds ∫ t d, not t d²/2.
    const double d = contact.depth, from = faces / grows, to = std::min(d, least / grows);
    const double held = faces * from * from / 2 + grows * (to * to * to - from * from * from) / 3 +
                        least * (d * d - to * to) / 2;
    const double length = grows * to;
    contact.filled = held / (length * d * d / 2);
    return length;
  }

  /// A twentieth of the shorter edge: for a corner that meets a corner, or comes alone.
  static double least_tributary(double own, double other) { return 0.05 * std::min(own, other); }
};

}  // namespace talus::vertex_edge
