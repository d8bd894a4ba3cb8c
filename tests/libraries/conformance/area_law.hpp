#pragma once

// A small law that is right in every respect, for others to spoil in one: pressure p = c A over the whole
// overlap, A its area, so that Π = ½ c A² and the force is its derivative; a friction spring per pair of
// bodies, held within μ P. Each virtual function is a place where a law can go wrong.

#include <talus/library.hpp>
#include <talus/overlap/piece.hpp>

#include <cmath>
#include <limits>

namespace spoilt {

using talus::BodyPair;
using talus::ContactBatch;
using talus::ContactLoads;
using talus::overlap::Piece;
using talus::overlap::Point;

inline constexpr talus::Parameter interface_parameters[] = {
    talus::number("area_stiffness", "Pa/m2", 1e9, 0, talus::unbounded, "Pressure per area of overlap, c."),
    talus::number("tangential_spring", "N/m2", 7e8, 0, talus::unbounded, "Friction force per metre of slip."),
    talus::number("friction_angle", "deg", talus::required, 0, 89.99995, "Friction angle φ, μ = tan φ."),
};

/// What is known of a pair in contact.
struct Seen {
  const ContactBatch* batch = nullptr;
  const BodyPair* pair = nullptr;
  std::uint32_t position = 0;  ///< in the list of active pairs
  Piece first[2];              ///< the first piece of each body
  double stiffness = 0, spring = 0, friction = 0;
  double area = 0;
  Point centre{0, 0};   ///< of the overlap
  Point outward{0, 0};  ///< Σ n dl of the sides of a: the way b is pushed
  Point normal{0, 0};   ///< its direction
  Point tangent{0, 0};
  std::uint32_t stretches = 0;                                ///< of sides that bound the overlap
  double shortest = std::numeric_limits<double>::infinity();  ///< side of a piece that overlaps, m
  Piece longest[2];                                           ///< with the longest stretch of each body
  std::uint32_t longest_side[2] = {0, 0};
  double longest_stretch[2] = {0, 0};
};

inline Point mean_velocity(const Piece& piece) {
  Point sum{0, 0};
  for (std::uint32_t i = 0; i < piece.size(); ++i) sum = sum + piece.velocity(i);
  return (1.0 / piece.size()) * sum;
}

/// Whether a body b of a batch begins at a place that is no number.
inline bool has_no_number(const ContactBatch& batch) {
  for (std::uint32_t k = 0; k < batch.active_count; ++k) {
    const talus::PiecePair pieces = batch.piece_pairs.at(batch.pairs[batch.active[k]], 0);
    if (std::isnan(batch.boundaries.corner[batch.boundaries.piece_start[pieces.b]].x)) return true;
  }
  return false;
}

class AreaLaw : public talus::ContactModel {
 public:
  explicit AreaLaw(const double* /*values*/) {}
  std::uint32_t doubles_per_contact() const noexcept override { return 1; }
  void prepare_interface(double* values) const noexcept override { values[2] = std::tan(values[2]); }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    begin(batch, loads);
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const std::uint32_t i = batch.active[k];
      evaluate_pair(batch, loads, k, batch.pairs[i], loads.pairs[i]);
    }
  }

  talus::ContactStiffness stiffness(const double* values, double length) const noexcept override {
    // Half of what a side of twice the length meets: c (2 l)² / 2.
    return {2 * values[0] * length * length, values[2] > 0 ? values[1] : 0, 0, 0};
  }

 protected:
  virtual void begin(const ContactBatch&, const ContactLoads&) const {}
  virtual std::uint32_t row(const talus::Interfaces& interfaces) const { return interfaces.row[0]; }
  virtual double pressure(const Seen& seen) const { return seen.stiffness * seen.area; }
  virtual double slip_velocity(const Seen& seen) const {
    return seen.longest[1].working_velocity(seen.longest_side[1], friction_point(seen, 1), seen.tangent) -
           seen.longest[0].working_velocity(seen.longest_side[0], friction_point(seen, 0), seen.tangent);
  }
  virtual double time_step(const ContactBatch& batch) const { return batch.dt; }
  virtual double slipping(bool slips) const { return slips ? 1 : 0; }
  virtual double shear_energy(const Seen& seen, double force) const {
    return seen.spring > 0 ? force * force / (2 * seen.spring) : 0;
  }
  virtual double trial(const Seen& seen, double old, double slip) const { return old - seen.spring * slip; }
  virtual double limit(const Seen& seen, double /*trial*/, double load) const { return seen.friction * load; }
  virtual Point friction_point(const Seen& seen, int /*body*/) const { return seen.centre; }
  virtual double kept(const ContactBatch& batch, const BodyPair& pair) const {
    return pair.contact_count > 0 ? batch.history[pair.slot_start] : 0;
  }
  virtual bool bears(const Piece& piece, std::uint32_t side) const { return piece.real(side); }
  virtual bool holds_stick(const ContactBatch& batch) const { return batch.hold_stick; }
  virtual double depth(double measured) const { return measured; }
  virtual double stored(const Seen&, double energy) const { return energy; }
  virtual double squeeze() const { return 0; }  ///< share of the load, along the longest stretch
  virtual double loss(const Seen&, double work, double stored_more) const { return work - stored_more; }
  virtual bool apart(const ContactBatch&, const ContactLoads&, const Seen&, talus::PairReport&) const {
    return false;
  }
  virtual void tell_dashpots(const Seen&, talus::PairReport&) const {}

 private:
  /// `visit(piece a, piece b, overlap)` of all piece pairs.
  template <class Visit>
  static void each_overlap(const ContactBatch& batch, const BodyPair& pair, const Visit& visit) {
    talus::overlap::Clipper clipper;
    talus::overlap::Polygon polygon;
    for (const talus::PiecePair pieces : batch.piece_pairs.of(pair)) {
      const Piece a(batch.boundaries, pieces.a, {0, 0}, pieces.load_start);
      const Piece b(batch.boundaries, pieces.b, {pair.offset_x, pair.offset_y}, pieces.load_start + a.size());
      polygon.clear();
      polygon.make_room(b.size());
      for (std::uint32_t i = 0; i < b.size(); ++i) polygon.append({b.at(i), {1, i}});
      for (std::uint32_t side = 0; side < a.size() && !polygon.empty(); ++side)
        clipper.clip(polygon, {0, side}, [&](Point p) { return -a.depth(side, p); });
      visit(a, b, polygon);
    }
  }

  /// `visit(body, piece, side, middle, Σ n dl)` of the stretches of boundary that bound an overlap.
  template <class Visit>
  void each_stretch(const Piece& a, const Piece& b, const talus::overlap::Polygon& overlap,
                    const Visit& visit) const {
    for (std::size_t i = 0; i < overlap.size(); ++i) {
      const auto [body, side] = overlap[i].side;
      const Piece& piece = body == 0 ? a : b;
      const Point from = overlap[i].at, to = overlap[overlap.next(i)].at;
      if (!bears(piece, side) || !(length(to - from) > 0)) continue;
      visit(body, piece, side, 0.5 * (from + to), length(to - from) * piece.normal(side));
    }
  }

  Seen look(const ContactBatch& batch, const BodyPair& pair, std::uint32_t position) const {
    Seen seen;
    seen.batch = &batch, seen.pair = &pair, seen.position = position;
    Point moment{0, 0};
    bool is_first = true;
    each_overlap(batch, pair, [&](const Piece& a, const Piece& b, const talus::overlap::Polygon& overlap) {
      if (is_first) seen.first[0] = a, seen.first[1] = b;
      is_first = false;
      if (overlap.empty()) return;
      const auto region = area_centroid(overlap);
      seen.area += region.area;
      moment = moment + region.area * region.centroid;
      for (const Piece* piece : {&a, &b}) {
        for (std::uint32_t i = 0; i < piece->size(); ++i)
          seen.shortest = std::min(seen.shortest, piece->length(i));
      }
      each_stretch(a, b, overlap,
                   [&](std::uint32_t body, const Piece& piece, std::uint32_t side, Point, Point n) {
                     if (body == 0) seen.outward = seen.outward + n;
                     if (!(length(n) > seen.longest_stretch[body])) return;
                     seen.longest_stretch[body] = length(n);
                     seen.longest[body] = piece, seen.longest_side[body] = side;
                   });
    });
    if (seen.area > 0) seen.centre = (1 / seen.area) * moment;
    const double size = length(seen.outward);
    if (size > 0) seen.normal = (1 / size) * seen.outward;
    seen.tangent = {-seen.normal.y, seen.normal.x};
    const talus::Interfaces& interfaces = batch.interfaces;  // one surface class is enough here
    const double* values = interfaces.value + row(interfaces) * interfaces.parameter_count;
    seen.stiffness = values[0], seen.spring = values[1], seen.friction = values[2];
    return seen;
  }

  void evaluate_pair(const ContactBatch& batch, const ContactLoads& loads, std::uint32_t position,
                     const BodyPair& pair, talus::PairReport& report) const {
    report = {};
    const Seen seen = look(batch, pair, position);
    const double old = kept(batch, pair), held = shear_energy(seen, old);
    if (!(seen.area > 0)) {
      report.slip_loss = loss(seen, 0, -held);
      apart(batch, loads, seen, report);
      return;
    }
    report.contact_count = 1;
    const talus::overlap::LoadSink sink{loads.corner};
    sink.clear(batch, pair);
    const double p = pressure(seen);
    each_overlap(batch, pair, [&](const Piece& a, const Piece& b, const talus::overlap::Polygon& overlap) {
      each_stretch(a, b, overlap,
                   [&](std::uint32_t, const Piece& piece, std::uint32_t side, Point at, Point n) {
                     sink.on_side(piece, side, piece.lever(side, at), -p * n);
                   });
    });
    report.stored = stored(seen, p * seen.area / 2);
    tell_dashpots(seen, report);
    report.penetration = depth(seen.area / seen.longest_stretch[seen.longest_stretch[0] > 0 ? 0 : 1]);

    const double load = p * length(seen.outward);
    double force = 0;
    bool slips = false;
    if (load > 0 && seen.longest_stretch[0] > 0 && seen.longest_stretch[1] > 0 && seen.friction > 0) {
      const double slip = slip_velocity(seen) * time_step(batch);
      force = trial(seen, old, slip);
      const double most = limit(seen, force, load);
      if (!holds_stick(batch)) {
        slips = std::fabs(force) > most;
        force = std::fmax(-most, std::fmin(most, force));
      }
      for (int body = 0; body < 2; ++body) {
        sink.at_point(seen.longest[body], seen.longest_side[body], friction_point(seen, body),
                      (body == 1 ? force : -force) * seen.tangent);
      }
      const double stored = shear_energy(seen, force);
      report.stored += stored;
      report.slip_loss = loss(seen, -(old + force) / 2 * slip, stored - held);
    } else {
      report.slip_loss = loss(seen, 0, -held);
    }
    for (int body = 0; body < 2 && seen.longest_stretch[body] > 0; ++body) {
      const Piece& piece = seen.longest[body];
      const std::uint32_t side = seen.longest_side[body];
      sink.at_corner(piece, side, squeeze() * load * piece.tangent(side));
      sink.at_corner(piece, piece.next(side), -squeeze() * load * piece.tangent(side));
    }
    if (pair.slot_capacity == 0) return;
    loads.history[pair.slot_start] = force;
    if (loads.reports != nullptr) {
      const Point push = load * seen.normal, rub = force * seen.tangent;
      loads.reports[pair.slot_start] = {seen.centre.x,
                                        seen.centre.y,
                                        push.x,
                                        push.y,
                                        rub.x,
                                        rub.y,
                                        report.penetration,
                                        slipping(slips),
                                        moment_on_b(batch, pair, loads, seen.centre)};
    }
  }

  /// N, about a point, of all that the corners of body b bear.
  static double moment_on_b(const talus::ContactBatch& batch, const BodyPair& pair,
                            const talus::ContactLoads& loads, Point about) {
    double moment = 0;
    for (const talus::PiecePair pieces : batch.piece_pairs.of(pair)) {
      const Piece a(batch.boundaries, pieces.a, {0, 0}, pieces.load_start);
      const Piece b(batch.boundaries, pieces.b, {pair.offset_x, pair.offset_y}, pieces.load_start + a.size());
      for (std::uint32_t i = 0; i < b.size(); ++i) {
        const talus::CornerLoad& at = loads.corner[b.load_start + i];
        moment += cross(b.at(i) - about, {at.x, at.y});
      }
    }
    return moment;
  }
};

template <class Law>
constexpr talus::Component area_law(const char* name, std::uint32_t traits = talus::trait::has_potential) {
  return talus::contact_model<Law>(name, "A law for tests.", {}, interface_parameters, traits);
}

template <std::size_t count>
constexpr talus::Library library(const talus::Component (&components)[count]) {
  return talus::library("spoilt", "1.0", "the tests of talus", components);
}

}  // namespace spoilt
