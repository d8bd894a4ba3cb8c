#pragma once

#include "corner_contact.hpp"
#include "past_ends.hpp"
#include "shared_springs.hpp"
#include "strips.hpp"
#include "tributary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace talus::vertex_edge {

/// Entrance condition of DDA: a vertex stands on no side that its own edges go into, or that it hardly looks
/// at, if there is another. For those no deeper than this share of the shorter edge, as at rest, it holds as
/// it stands; deeper, as in hits, a side counts as further by this share per sine of the angle beyond
/// `leaning`.
inline constexpr double resting = 0.003, further = 4;

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
    share_springs(geometry, found, first);
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
};

}  // namespace talus::vertex_edge
