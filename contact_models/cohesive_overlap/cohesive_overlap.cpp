// The overlap-area law, and bonds in parallel that soften and break. See README.md beside.

#include "bonds.hpp"

#include <talus/library.hpp>
#include <talus/overlap/distributed_contact.hpp>

#include <memory>

namespace {

using namespace talus;
using namespace talus::cohesive_overlap;

constexpr Parameter interface_parameters[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded,
           "Pressure per metre of penetration, tension per metre of opening of a bond, α_N."),
    number("tangential_stiffness", "Pa/m", required, 0, unbounded,
           "Shear traction per metre of slip, of friction in stick and of a bond each, α_T."),
    number("friction_angle", "deg", required, 0, 89.99995, "Friction angle φ, μ = tan φ."),
    number("normal_damping", "-", required, 0, 10, "Dashpot across the contact, share of critical."),
    number("tangential_damping", "-", required, 0, 10,
           "Dashpot along the contact while it sticks, share of critical."),
    number("cohesion", "Pa", 0, 0, unbounded, "Shear strength of a bond, c; without it nothing is bonded."),
    number("tensile_strength", "Pa", 0, 0, unbounded, "Tension a bond bears, σ_t, at most c/tan φ."),
    number("softening_opening", "m", 0, 0, unbounded,
           "Opening over which a bond loses its strength in tension."),
    number("softening_slip", "m", 0, 0, unbounded, "Slip over which a bond loses its strength in shear."),
};

/// A slot holds the friction of an overlap or a bond; its last number tells which.
constexpr std::uint32_t slot_doubles = overlap::friction_doubles + 1;
constexpr double is_overlap = 0, is_bond = 1;
static_assert(bond_doubles < slot_doubles);

class CohesiveOverlap final : public ContactModel {
 public:
  static constexpr bool frictional = true;

  explicit CohesiveOverlap(const double* /*values*/) {}

  std::uint32_t doubles_per_contact() const noexcept override { return slot_doubles; }

  void prepare_interface(double* values) const noexcept override { values[2] = std::tan(values[2]); }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    static thread_local const auto work = std::make_unique<Workspace>();
    evaluate_overlaps(batch, loads, *work);
    for (std::uint32_t k = 0; k < batch.active_count; ++k) evaluate_bonds(batch, loads, k, *work);
  }

  /// Where a joint is closed bonds and friction are springs side by side. Where it is open in part only, the
  /// dashpots of both parts come to at most 5/4 of that of one, for √x + (1 − x) ≤ 5/4.
  ContactStiffness stiffness(const double* values, double length) const noexcept override {
    const bool bonds = values[5] > 0, rubs = values[2] > 0;
    const double springs = (bonds ? 1 : 0) + (rubs ? 1 : 0);
    return {values[0] * length, springs * values[1] * length, (bonds ? 1.25 : 1) * values[3],
            std::sqrt(springs) * values[4]};
  }

  static overlap::FrictionRule rule() { return overlap::FrictionRule::return_mapping; }
  static overlap::InterfaceParameters interface(const double* values) {
    return {values[0], values[1], values[2], values[3], values[4]};
  }

 private:
  struct Workspace {
    overlap::DistributedContact<CohesiveOverlap> overlaps;
    std::vector<BodyPair> pairs;  ///< [k] of the active pairs, with slots of their own
    std::vector<double> history, next_history;
    std::vector<ContactReport> reports;
    std::vector<PairReport> pair_reports;
    std::vector<std::uint32_t> active;
    BondFinder finder;
    std::vector<Bond> bonds;
  };

  /// The overlap-area law on the same pairs, with its own slots only.
  void evaluate_overlaps(const ContactBatch& batch, const ContactLoads& loads, Workspace& work) const {
    constexpr std::uint32_t doubles = overlap::friction_doubles;
    work.pairs.clear();
    work.active.clear();
    std::uint32_t slots = 0;
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      BodyPair pair = batch.pairs[batch.active[k]];
      const double* from = batch.history + std::size_t{pair.slot_start} * slot_doubles;
      std::uint32_t count = 0;
      while (count < pair.contact_count && from[count * slot_doubles + slot_doubles - 1] == is_overlap)
        ++count;
      work.history.resize(std::size_t{slots + pair.slot_capacity} * doubles);
      for (std::uint32_t i = 0; i < count; ++i)
        std::copy_n(from + i * slot_doubles, doubles, work.history.data() + std::size_t{slots + i} * doubles);
      pair.slot_start = slots;
      pair.contact_count = count;
      slots += pair.slot_capacity;
      work.pairs.push_back(pair);
      work.active.push_back(k);
    }
    work.next_history.resize(work.history.size());
    work.reports.resize(slots);
    work.pair_reports.resize(work.pairs.size());
    ContactBatch inner = batch;
    inner.pairs = work.pairs.data();
    inner.history = work.history.data();
    inner.active = work.active.data();
    work.overlaps.evaluate(
        *this, inner,
        {loads.corner, work.next_history.data(), loads.reports != nullptr ? work.reports.data() : nullptr,
         work.pair_reports.data()});
  }

  static void evaluate_bonds(const ContactBatch& batch, const ContactLoads& loads, std::uint32_t k,
                             Workspace& work) {
    const BodyPair& pair = batch.pairs[batch.active[k]];
    PairReport& report = loads.pairs[batch.active[k]];
    report = work.pair_reports[k];
    const std::uint32_t overlaps = report.contact_count;
    copy_overlaps(loads, pair, k, work);

    read_bonds(batch, pair, work.pairs[k].contact_count, work.bonds);
    if (work.bonds.empty() && !batch.bonds_form) return;
    work.finder.take(batch, pair);
    if (batch.bonds_form) form_bonds(batch, work);
    const LoadSink sink{loads.corner};
    if (overlaps == 0 && !work.bonds.empty()) sink.clear(batch, pair);
    double joint = 0;
    for (const Bond& bond : work.bonds) joint += bond.length;
    for (Bond& bond : work.bonds) {
      ContactReport seen{};
      if (!act(batch, pair, sink, work.finder, joint, bond, seen, report)) continue;
      const std::uint32_t slot = report.contact_count++;
      report.gap = 0;
      if (slot >= pair.slot_capacity) continue;
      double* to = loads.history + std::size_t{pair.slot_start + slot} * slot_doubles;
      std::fill_n(to, slot_doubles, 0.0);
      write_bond(bond, to);
      to[slot_doubles - 1] = is_bond;
      if (loads.reports != nullptr) loads.reports[pair.slot_start + slot] = seen;
    }
  }

  static void copy_overlaps(const ContactLoads& loads, const BodyPair& pair, std::uint32_t k,
                            const Workspace& work) {
    const std::uint32_t count = std::min(work.pair_reports[k].contact_count, pair.slot_capacity);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::size_t inner = work.pairs[k].slot_start + i, outer = pair.slot_start + i;
      double* to = loads.history + outer * slot_doubles;
      std::copy_n(work.next_history.data() + inner * overlap::friction_doubles, overlap::friction_doubles,
                  to);
      to[slot_doubles - 1] = is_overlap;
      if (loads.reports != nullptr) loads.reports[outer] = work.reports[inner];
    }
  }

  static void read_bonds(const ContactBatch& batch, const BodyPair& pair, std::uint32_t from,
                         std::vector<Bond>& bonds) {
    bonds.clear();
    for (std::uint32_t i = from; i < pair.contact_count; ++i)
      bonds.push_back(read_bond(batch.history + std::size_t{pair.slot_start + i} * slot_doubles));
  }

  static const double* values_of(const ContactBatch& batch, const Bond& bond) {
    const auto surface = [&](double side) {
      return batch.boundaries.corner[static_cast<std::uint32_t>(side - 1)].surface;
    };
    const Interfaces& interfaces = batch.interfaces;
    const std::uint32_t row =
        interfaces.row[surface(bond.side_a) * interfaces.surface_count + surface(bond.side_b)];
    return interfaces.value + row * interfaces.parameter_count;
  }

  static Strength strength_of(const double* v) { return {v[0], v[1], v[2], v[5], v[6], v[7], v[8]}; }

  static void form_bonds(const ContactBatch& batch, Workspace& work) {
    const std::size_t known = work.bonds.size();
    work.finder.find_touching(
        [&](const Faces& faces, double lever_a, double lever_b, double beside, double length) {
          Bond bond{1.0 + faces.a.first_corner() + faces.side_a,
                    1.0 + faces.b.first_corner() + faces.side_b,
                    lever_a,
                    lever_b,
                    length,
                    0,
                    0,
                    0};
          // A joint that closes from one end on has one of its two bonds before the other.
          int of_these_sides = 0;
          for (std::size_t i = 0; i < known; ++i) {
            const Bond& old = work.bonds[i];
            if (old.side_a != bond.side_a || old.side_b != bond.side_b) continue;
            const bool is_this = std::abs(old.lever_a - lever_a) <= std::abs(old.lever_a - beside);
            if (is_this || ++of_these_sides == 2) return;
          }
          if (!(strength_of(values_of(batch, bond)).cohesion > 0)) return;
          const Separation separation = state_of(faces, bond).separation;
          bond.opening = separation.opening;
          bond.slip = separation.slip;
          work.bonds.push_back(bond);
        });
  }

  /// Applies one bond. False when nothing is left of it.
  static bool act(const ContactBatch& batch, const BodyPair& pair, const LoadSink& sink,
                  const BondFinder& finder, double joint, Bond& bond, ContactReport& seen,
                  PairReport& report) {
    const double* values = values_of(batch, bond);
    const Strength strength = strength_of(values);
    const Separation before{bond.opening, bond.slip};
    const double old_damage = bond.damage;
    Faces faces;
    if (!finder.find(bond, faces)) {  // no neighbours any more
      report.slip_loss += (1 - old_damage) * bond.length / 2 *
                          (strength.normal_stiffness * before.open() * before.open() +
                           strength.tangential_stiffness * before.slip * before.slip);
      return false;
    }
    const BondState now = state_of(faces, bond);
    const Separation here = now.separation;
    if (!batch.hold_stick)
      bond.damage = std::max(old_damage, damage_at(strength, here, BondFinder::touching(faces)));
    // Work of the mean of both forces less the change of what is stored.
    report.slip_loss += (bond.damage - old_damage) * bond.length / 2 *
                        (strength.normal_stiffness * before.open() * here.open() +
                         strength.tangential_stiffness * before.slip * here.slip);
    bond.opening = here.opening;
    bond.slip = here.slip;
    // Only while bonds form must be known what has broken already.
    if (bond.damage == 1) return batch.bonds_form;

    const double left = (1 - bond.damage) * bond.length;
    const double tension = left * strength.normal_stiffness * here.open();
    const double shear = left * strength.tangential_stiffness * here.slip;
    report.stored += (tension * here.open() + shear * here.slip) / 2;
    const auto dashpot = [&](double ratio, double stiffness, double rate) {
      return left * 2 * ratio * std::sqrt(stiffness * pair.reduced_mass / joint) * rate;
    };
    const double viscous_tension =
        here.opening > 0 ? dashpot(values[3], strength.normal_stiffness, now.opening_rate) : 0;
    const double viscous_shear = dashpot(values[4], strength.tangential_stiffness, now.slip_rate);
    report.damping_power += (viscous_tension * now.opening_rate + viscous_shear * now.slip_rate) * batch.dt;
    report.damping_force += static_cast<float>(std::abs(viscous_tension) + std::abs(viscous_shear));

    const Point across = -(tension + viscous_tension) * now.normal;
    const Point along = -(shear + viscous_shear) * now.tangent;
    load_bond(sink, faces, bond, now, across + along);
    const Point middle = 0.5 * (now.at_a + now.at_b);
    seen = {middle.x, middle.y, across.x, across.y, along.x, along.y, 0, bond.damage > 0 ? 1.0 : 0.0, 0};
    return true;
  }
};

constexpr Component components[] = {contact_model<CohesiveOverlap>(
    "cohesive_overlap",
    "The overlap-area law with bonds that bear tension and shear, soften and break for good.", {},
    interface_parameters, trait::has_potential)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("cohesive_overlap", "0.1.0", "the talus authors", components);
