// The contact law of DDA: penalty springs between a vertex and an edge. See README.md beside.

#include "acting_corner.hpp"
#include "corner_finder.hpp"
#include "reflex_corners.hpp"
#include "springs.hpp"
#include "strip_ends.hpp"
#include "tributary.hpp"

#include <talus/library.hpp>

#include <limits>
#include <memory>
#include <stdexcept>

namespace {

using namespace talus;
using namespace talus::vertex_edge;

constexpr Parameter parameters[] = {
    choice("calibration", "per_area|springs", 0,
           "Springs from the interface's stiffness per area times the length each vertex carries, or given "
           "directly."),
    number("normal_spring", "N/m per m", 0, 0, unbounded,
           "Normal spring of a vertex, with calibration 'springs'."),
    number("tangential_spring", "N/m per m", 0, 0, unbounded,
           "Shear spring of a vertex, with calibration 'springs'."),
};

constexpr Parameter interface_parameters[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded, "Pressure per metre of penetration."),
    number("tangential_stiffness", "Pa/m", required, 0, unbounded,
           "Shear traction per metre of slip in stick."),
    number("friction_angle", "deg", required, 0, 89.99995, "Friction angle φ, μ = tan φ."),
    number("normal_damping", "-", required, 0, 10, "Dashpot across the contact, share of critical."),
    number("tangential_damping", "-", required, 0, 10,
           "Dashpot along the contact while it sticks, share of critical."),
    number("cohesion", "Pa", 0, 0, unbounded,
           "Cohesion of contacts that exist at the start, until they slip or open."),
    number("tensile_strength", "Pa", 0, 0, unbounded,
           "Tension such a contact bears before it opens for good."),
};

class VertexEdge final : public ContactModel {
 public:
  explicit VertexEdge(const double* values)
      : direct_(values[0] == 1), normal_spring_(values[1]), tangential_spring_(values[2]) {
    if (direct_ && !(normal_spring_ > 0)) {
      throw std::invalid_argument("calibration 'springs' needs a normal_spring above 0");
    }
  }

  std::uint32_t doubles_per_contact() const noexcept override { return spring_doubles; }

  void prepare_interface(double* values) const noexcept override { values[2] = std::tan(values[2]); }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    static thread_local const auto work = std::make_unique<Workspace>();
    work->bonds = strongest_bonds(batch.interfaces, batch.hold_stick);
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const std::uint32_t i = batch.active[k];
      evaluate_pair(batch, loads, batch.pairs[i], loads.pairs[i], *work);
    }
  }

  ContactStiffness stiffness(const double* values, double length) const noexcept override {
    const Interface interface = read(values);
    const double tangential = interface.friction > 0 || interface.cohesion > 0 ? 1 : 0;
    if (direct_) {
      return {normal_spring_, tangential * tangential_spring_, interface.normal_damping,
              interface.tangential_damping};
    }
    return {interface.normal_stiffness * length, tangential * interface.tangential_stiffness * length,
            interface.normal_damping, interface.tangential_damping};
  }

 private:
  /// A gap that is only rounding, as a share of lengths beside it.
  static constexpr double rounding_gap = 1e-9;

  /// Of all interfaces.
  struct BondStrength {
    double reach;   ///< m, the widest gap an intact bond can span: σ_t over the stiffness; any while it is
                    ///< held. Of springs that are given directly, per metre of tributary length
    bool cohesive;  ///< there is cohesion, which survives gaps of rounding
  };

  struct Workspace {
    std::vector<PiecePairGeometry> pieces;
    std::vector<CornerContact> found;
    std::vector<SpringHistory> old;
    std::vector<CornerOnSide> corners;
    BondStrength bonds{};
    CornerFinder finder;
  };

  static Interface read(const double* v) { return {v[0], v[1], v[2], v[3], v[4], v[5], v[6]}; }

  void evaluate_pair(const ContactBatch& batch, const ContactLoads& loads, const BodyPair& pair,
                     PairReport& report, Workspace& work) const {
    read_history(batch, pair, work.old);
    find_contacts(batch, pair, work);
    const overlap::LoadSink sink{loads.corner};
    if (!work.found.empty()) sink.clear(batch, pair);
    report = {};
    for (const SpringHistory& old : work.old) {
      // What the contacts that live on still hold is taken off again below.
      report.slip_loss += old.stored + old.pulled;
    }
    std::uint32_t count = 0;
    for (const CornerContact& contact : work.found) {
      const PiecePairGeometry& geometry = work.pieces[contact.entry];
      const Interface interface = interface_of(batch.interfaces, geometry, contact);
      SpringHistory history = born(batch, contact, work);
      const SpringParameters spring = springs(interface, contact.tributary, history.intact == 1);
      ActingCorner corner(batch, pair, geometry, contact, interface, spring);
      if (!corner.act(history, direct_ ? 1 : contact.filled, report)) continue;
      const ContactReport seen = corner.push(sink);
      if (count < pair.slot_capacity) {
        write(history, loads.history + (pair.slot_start + count) * spring_doubles);
        if (loads.reports != nullptr) loads.reports[pair.slot_start + count] = seen;
      }
      ++count;
    }
    report.contact_count = count;
  }

  static void read_history(const ContactBatch& batch, const BodyPair& pair, std::vector<SpringHistory>& old) {
    old.clear();
    for (std::uint32_t i = 0; i < pair.contact_count; ++i) {
      const double* h = batch.history + (pair.slot_start + i) * spring_doubles;
      old.push_back({h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8], h[9]});
    }
  }

  static void write(const SpringHistory& history, double* to) {
    to[0] = history.key, to[1] = history.elastic, to[2] = history.stored, to[3] = history.intact;
    to[4] = history.applied, to[5] = history.pulled, to[6] = history.side, to[7] = history.viscous,
    to[8] = history.lent, to[9] = history.stretch;
  }

  void find_contacts(const ContactBatch& batch, const BodyPair& pair, Workspace& work) const {
    const std::uint32_t entries = pair.piece_pair_count();
    if (work.pieces.size() < entries) work.pieces.resize(entries);
    work.found.clear();
    for (std::uint32_t e = 0; e < entries; ++e) {
      const PiecePair pieces = batch.piece_pairs.at(pair, e);
      PiecePairGeometry& geometry = work.pieces[e];
      geometry.piece[0] = Piece(batch.boundaries, pieces.a, {0, 0}, pieces.load_start);
      geometry.piece[1] = Piece(batch.boundaries, pieces.b, {pair.offset_x, pair.offset_y},
                                pieces.load_start + geometry.piece[0].size());
    }
    const std::span<const PiecePairGeometry> all(work.pieces.data(), entries);
    for (std::uint32_t e = 0; e < entries; ++e) {
      const double touching = batch.bonds_form ? touching_gap(all[e]) : 0.0;
      const double longest = std::max(longest_side(all[e].piece[0]), longest_side(all[e].piece[1])),
                   bonded = std::max(direct_ ? work.bonds.reach * longest : work.bonds.reach,
                                     work.bonds.cohesive ? rounding_gap * longest : 0);
      const double seen = bonded > touching ? bonded + batch.dt * fastest_apart(all[e]) : touching;
      const auto bond_reach = [&, bonded, touching, seen](std::uint32_t key) {
        if (bonded == touching) return BondReach{touching, touching};  // no need to know who is bonded
        const bool intact = std::ranges::any_of(
            work.old, [&](const SpringHistory& old) { return old.key == 1.0 + key && old.intact == 1; });
        return intact ? BondReach{bonded, std::max(bonded, seen), true} : BondReach{touching, touching};
      };
      work.finder.find(all, e, bond_reach, std::max(seen, touching), work.found);
    }
    drop_repeated(all, work.old, work.found);
    CoveredSides(all, work.found, work.corners).share();
  }

  /// m/s, no two corners part faster.
  static double fastest_apart(const PiecePairGeometry& pair) {
    const Point of = pair.piece[0].velocity(0);
    double fastest = 0;
    for (const Piece& piece : pair.piece) {
      for (std::uint32_t i = 0; i < piece.size(); ++i)
        fastest = std::max(fastest, length(piece.velocity(i) - of));
    }
    return 2 * fastest;
  }

  /// m, a gap across which bonds form, since rounding makes such where bodies are drawn flush.
  static double touching_gap(const PiecePairGeometry& pair) {
    return rounding_gap * std::max(longest_side(pair.piece[0]), longest_side(pair.piece[1]));
  }

  static double longest_side(const Piece& piece) {
    double longest = 0;
    for (std::uint32_t i = 0; i < piece.size(); ++i) longest = std::max(longest, piece.length(i));
    return longest;
  }

  BondStrength strongest_bonds(const Interfaces& interfaces, bool held) const {
    BondStrength bonds{};
    const std::size_t pairs = std::size_t{interfaces.surface_count} * interfaces.surface_count;
    std::uint32_t rows = 0;  // that were looked at: many surfaces share few
    for (std::size_t i = 0; i < pairs; ++i) {
      for (; rows <= interfaces.row[i]; ++rows) {
        const Interface interface = read(interfaces.value + std::size_t{rows} * interfaces.parameter_count);
        const double stiffness = direct_ ? normal_spring_ : interface.normal_stiffness;
        if (stiffness > 0) bonds.reach = std::max(bonds.reach, interface.tensile / stiffness);
        bonds.cohesive = bonds.cohesive || interface.cohesion > 0;
      }
    }
    if (held && (bonds.reach > 0 || bonds.cohesive)) bonds.reach = std::numeric_limits<double>::infinity();
    return bonds;
  }

  static const SpringHistory* find_old(const std::vector<SpringHistory>& old, std::uint32_t key) {
    for (const SpringHistory& history : old) {
      if (history.key == 1.0 + key) return &history;
    }
    return nullptr;
  }

  /// What the vertex had on this side; or on another, if it stands there no more and nowhere else.
  static const SpringHistory* find_own(const CornerContact& contact, double side, const Workspace& work) {
    const auto held = [&](double on) {
      return std::ranges::find_if(
          work.old, [&](const SpringHistory& old) { return old.key == 1.0 + contact.key && old.side == on; });
    };
    if (const auto own = held(side); own != work.old.end()) return &*own;
    for (const CornerContact& other : work.found) {
      if (&other != &contact && other.key == contact.key) return nullptr;
    }
    return find_old(work.old, contact.key);
  }

  /// The history of a contact: its own, on whichever side that was, or that of the corner it meets or of its
  /// other face in a reflex corner (the two share one spring), or a new one.
  static SpringHistory born(const ContactBatch& batch, const CornerContact& contact, const Workspace& work) {
    const double side = side_number(work.pieces, contact);
    if (const SpringHistory* old = find_own(contact, side, work)) {
      SpringHistory own = *old;
      own.side = side;
      own.lent = contact.lent;
      return own;
    }
    // A vertex that is bonded to one face of a corner is not to the other across a gap.
    const bool bonds = batch.bonds_form && contact.depth >= -touching_gap(work.pieces[contact.entry]);
    SpringHistory history{1.0 + contact.key, 0, 0, bonds ? 1.0 : 0.0, 0, 0, side, 0, contact.lent, 0};
    if (contact.share < 1 && !contact.meets_corner) {
      if (const SpringHistory* old = find_old(work.old, contact.key)) {
        history.elastic = old->elastic;
        history.intact = old->intact;
      }
    }
    if (!contact.meets_corner) return history;
    for (const CornerContact& other : work.found) {
      if (!other.meets_corner || other.entry != contact.entry || other.vertex_body == contact.vertex_body)
        continue;
      const Piece &own = own_piece(work.pieces, contact), &met = other_piece(work.pieces, contact);
      // Both ends of the side may meet corners; the partner is the one at this end.
      if (other.vertex != (contact.lever < 0.5 ? contact.side : met.next(contact.side))) continue;
      if (const SpringHistory* old = find_old(work.old, other.key)) {
        const double turned = dot(own.tangent(other.side), met.tangent(contact.side));
        history.elastic = -std::copysign(old->elastic, old->elastic * turned);
        history.intact = old->intact;
      }
    }
    return history;
  }

  SpringParameters springs(const Interface& interface, double tributary, bool intact) const {
    const double normal = direct_ ? normal_spring_ : interface.normal_stiffness * tributary;
    const double tangential = direct_ ? tangential_spring_ : interface.tangential_stiffness * tributary;
    return {normal,
            tangential,
            interface.friction,
            intact ? interface.cohesion * tributary : 0,
            intact ? interface.tensile * tributary : 0,
            direct_ ? 1 : tributary,
            intact && interface.cohesion > 0 ? normal * rounding_gap * tributary : 0};
  }

  /// The interface of the edge with the flatter of the vertex's own edges.
  static Interface interface_of(const Interfaces& interfaces, const PiecePairGeometry& geometry,
                                const CornerContact& contact) {
    const Piece& own = geometry.piece[contact.vertex_body];
    const Piece& other = geometry.piece[1 - contact.vertex_body];
    const std::uint32_t edge = flatter_edge(own, contact.vertex, other.tangent(contact.side));
    const std::uint32_t row =
        interfaces.row[own.surface(edge) * interfaces.surface_count + other.surface(contact.side)];
    return read(interfaces.value + row * interfaces.parameter_count);
  }

  bool direct_;
  double normal_spring_, tangential_spring_;
};

constexpr Component components[] = {contact_model<VertexEdge>(
    "vertex_edge",
    "The contact of DDA: springs between vertices and edges, Mohr-Coulomb with tension cut-off.", parameters,
    interface_parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("vertex_edge", "0.1.0", "the talus authors", components);
