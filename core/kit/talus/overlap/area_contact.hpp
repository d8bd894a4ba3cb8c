#pragma once

#include <talus/overlap/cell_loads.hpp>
#include <talus/overlap/grouping.hpp>

#include <cmath>
#include <span>
#include <vector>

namespace talus::overlap {

/// An edge of an overlap that lies on the boundary of a body.
struct LoadedEdge {
  const Overlap* overlap;
  std::uint32_t body;  ///< 0: body a, 1: body b
  std::uint32_t side;  ///< of that body's piece
  Point middle;
  Point outward;  ///< m, outward normal of the body times the length of the edge
};

/// A contact: overlaps that belong together, as one area.
struct AreaContact {
  double area = 0;
  double penetration = 0;  ///< m, largest extent of an overlap across the contact, or 2A/perimeter
  std::uint32_t edge_start, edge_end;  ///< in AreaFinder::edges
  Point chord_normal{0, 0};            ///< m, b n: out of body a, of the length of the chord
  double chord() const { return length(chord_normal); }
};

/// Finds the contacts of a pair and their loaded edges.
class AreaFinder {
 public:
  std::uint32_t find(const ContactBatch& batch, const BodyPair& pair) {
    overlaps_.find(batch, pair);
    overlaps_.group();
    contacts_.clear();
    edges_.clear();
    if (overlaps_.overlaps().empty()) return 0;
    const Overlap& first = overlaps_.overlaps()[0];
    among_strips_ = first.piece[0].is_strip() || first.piece[1].is_strip();
    const std::uint32_t count = number_contacts();
    for (std::uint32_t c = 0; c < count; ++c) measure(c);
    return count;
  }

  std::span<const AreaContact> contacts() const { return contacts_; }
  std::span<const LoadedEdge> edges() const { return edges_; }
  std::span<const LoadedEdge> edges_of(const AreaContact& contact) const {
    return std::span(edges_).subspan(contact.edge_start, contact.edge_end - contact.edge_start);
  }
  bool among_strips() const { return among_strips_; }

  /// Calls visit(overlap) for each overlap of a contact.
  template <class Visit>
  void overlaps_of(std::uint32_t contact, const Visit& visit) const {
    const std::span<const Overlap> all = overlaps_.overlaps();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (number_[i] == contact) visit(all[i]);
    }
  }

 private:
  /// Strips of one body have division lines of their own instead of common cuts: neighbours are known by the
  /// corner that they share. One pressure must act on either side of such a line, or it would be missing
  /// there.
  std::uint32_t number_contacts() {
    const std::span<const Overlap> all = overlaps_.overlaps();
    number_.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) number_[i] = all[i].cluster;
    if (!among_strips_) return overlaps_.clusters();
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (number_[i] == number_[j] || !beside(all[i].piece[0], all[j].piece[0]) ||
            !beside(all[i].piece[1], all[j].piece[1]))
          continue;
        const std::uint32_t low = std::min(number_[i], number_[j]), high = std::max(number_[i], number_[j]);
        std::replace(number_.begin(), number_.end(), high, low);
      }
    }
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < overlaps_.clusters(); ++c) {  // numbers without gaps
      if (std::find(number_.begin(), number_.end(), c) == number_.end()) continue;
      std::replace(number_.begin(), number_.end(), c, count++);
    }
    return count;
  }

  static bool beside(const Piece& p, const Piece& q) {
    if (p.first_corner() == q.first_corner()) return true;
    if (!p.is_strip() || !q.is_strip()) return false;
    const double near = 1e-9 * std::min(p.length(0), q.length(0));
    return length(p.at(1) - q.at(0)) <= near || length(q.at(1) - p.at(0)) <= near;
  }

  void measure(std::uint32_t number) {
    AreaContact contact;
    contact.edge_start = static_cast<std::uint32_t>(edges_.size());
    const std::span<const Overlap> all = overlaps_.overlaps();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (number_[i] != number) continue;
      const double area = area_centroid(all[i].polygon).area;
      contact.area += area;
      double around = 0;
      const Point normal = add_edges(all[i], around);
      // Edges that close on themselves have no chord, but for rounding, which points anywhere.
      const bool measurable = length(normal) > 1e-9 * around;
      if (measurable) contact.chord_normal = contact.chord_normal + normal;
      const double penetration = measurable   ? depth_along(all[i], normal)
                                 : around > 0 ? 2 * area / around
                                              : 0;
      contact.penetration = std::max(contact.penetration, penetration);
    }
    contact.edge_end = static_cast<std::uint32_t>(edges_.size());
    contacts_.push_back(contact);
  }

  /// Edges as the overlap's own corners give them, not the sides they lie on: so they close however thin the
  /// overlap is. Returns b n of this overlap, the mean of both arcs; adds their lengths to `around`.
  Point add_edges(const Overlap& overlap, double& around) {
    Point normal{0, 0};
    const Polygon& polygon = overlap.polygon;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const SideLabel label = polygon[i].side;
      if (!overlap.piece[label.body].real(label.index)) continue;
      const Point start = polygon[i].at, along = polygon[polygon.next(i)].at - start;
      const Point outward{along.y, -along.x};
      edges_.push_back({&overlap, label.body, label.index, start + 0.5 * along, outward});
      normal = normal + (label.body == 0 ? 0.5 : -0.5) * outward;
      around += length(outward);
    }
    return normal;
  }

  /// m, how far an overlap extends along its normal. Where a cut or the end of a strip bounds it one arc
  /// lacks that stretch and the normal is askew: along those of the sides that face about as it does it is
  /// less.
  static double depth_along(const Overlap& overlap, Point normal) {
    constexpr double about = 0.7;  // cosine
    const Polygon& polygon = overlap.polygon;
    double least = extent(polygon, normal);
    bool divided = false;
    for (const Corner& corner : polygon)
      divided = divided || !overlap.piece[corner.side.body].real(corner.side.index);
    for (std::size_t i = 0; i < polygon.size() && divided; ++i) {
      const Point along = polygon[polygon.next(i)].at - polygon[i].at, outward{along.y, -along.x};
      if (overlap.piece[polygon[i].side.body].real(polygon[i].side.index) &&
          std::abs(dot(outward, normal)) >= about * length(outward) * length(normal))
        least = std::min(least, extent(polygon, outward));
    }
    return least;
  }

  static double extent(const Polygon& polygon, Point across) {
    const double size = length(across);
    if (!(size > 0)) return 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Corner& corner : polygon) {
      const double height = dot(across, corner.at - polygon[0].at) / size;
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return high - low;
  }

  OverlapGroups overlaps_;
  std::vector<std::uint32_t> number_;  ///< [overlap] its contact
  std::vector<AreaContact> contacts_;
  std::vector<LoadedEdge> edges_;
  bool among_strips_ = false;
};

/// Parameters of a contact, to `mean`: of all sides of a that bound it with all of b, by length. All zero
/// where only one body bounds it, which then lies within the other.
inline void mean_interface(const Interfaces& interfaces, std::span<const LoadedEdge> edges, double* mean) {
  const auto surface = [](const LoadedEdge& edge) {
    return edge.overlap->piece[edge.body].surface(edge.side);
  };
  std::fill_n(mean, interfaces.parameter_count, 0.0);
  double total = 0;
  for (const LoadedEdge& on_a : edges) {
    for (const LoadedEdge& on_b : edges) {
      if (on_a.body != 0 || on_b.body != 1) continue;
      const std::uint32_t row = interfaces.row[surface(on_a) * interfaces.surface_count + surface(on_b)];
      const double weight = length(on_a.outward) * length(on_b.outward);
      for (std::uint32_t p = 0; p < interfaces.parameter_count; ++p)
        mean[p] += weight * interfaces.value[row * interfaces.parameter_count + p];
      total += weight;
    }
  }
  for (std::uint32_t p = 0; p < interfaces.parameter_count && total > 0; ++p) mean[p] /= total;
}

/// Puts a pressure on all edges of a contact; `balance` adds up the loads.
inline void load_edges(const LoadSink& sink, std::span<const LoadedEdge> edges, double pressure,
                       Balance& balance) {
  for (const LoadedEdge& edge : edges) {
    const Piece& piece = edge.overlap->piece[edge.body];
    const Point force = -pressure * edge.outward;
    sink.on_side(piece, edge.side, piece.lever(edge.side, edge.middle), force);
    balance.add(edge.middle, force);
  }
}

/// Rate of a contact's area, m²/s: what a uniform pressure works on.
inline double area_rate(std::span<const LoadedEdge> edges) {
  double rate = 0;
  for (const LoadedEdge& edge : edges) {
    const Piece& piece = edge.overlap->piece[edge.body];
    rate += dot(edge.outward, piece.velocity_at(edge.side, piece.lever(edge.side, edge.middle)));
  }
  return rate;
}

/// Pressure of a dashpot across a contact, Pa: `ratio` of critical for a spring of `stiffness` N/m per metre
/// on `mass`, spread over the chord. It goes with the rate of the area, so it only takes energy, and comes to
/// no more than `most` Pa where it pulls.
inline double viscous_pressure(std::span<const LoadedEdge> edges, double chord, double ratio,
                               double stiffness, double mass, double most, double dt, PairReport& report) {
  if (!(ratio > 0) || !(chord > 0)) return 0;
  const double rate = area_rate(edges);
  const double pressure = std::max(2 * ratio * std::sqrt(stiffness * mass) * rate / (chord * chord), -most);
  report.damping_power += pressure * rate * dt;
  report.damping_force += static_cast<float>(std::abs(pressure) * chord);
  return pressure;
}

/// Strips end at lines of their own and at a depth of their own: what that leaves over goes to the longest
/// edge.
inline void close_balance(const LoadSink& sink, const Balance& balance, std::span<const LoadedEdge> edges) {
  if (edges.empty()) return;
  const LoadedEdge* at = &edges[0];
  for (const LoadedEdge& edge : edges) {
    if (length(edge.outward) > length(at->outward)) at = &edge;
  }
  const Piece& piece = at->overlap->piece[at->body];
  sink.on_side(piece, at->side, piece.lever(at->side, at->middle), -1.0 * balance.force);
  sink.couple(piece, at->side, -balance.moment_about(at->middle));
}

/// Middle of the chord: along it the mean of its edges' middles, each by its projection.
inline Point middle_of(const AreaContact& contact, std::span<const LoadedEdge> edges) {
  if (edges.empty()) return {0, 0};
  const Point origin = edges[0].middle;
  Point moment{0, 0};
  double total = 0;
  for (const LoadedEdge& edge : edges) {
    const double facing = (edge.body == 0 ? 1 : -1) * dot(edge.outward, contact.chord_normal);
    moment = moment + facing * (edge.middle - origin);
    total += facing;
  }
  return total > 0 ? origin + (1 / total) * moment : origin;
}

}  // namespace talus::overlap
