// Munjiza's potential contact, both bodies being base by half. See README.md beside.

#include "potential.hpp"

#include <talus/library.hpp>

#include <cmath>
#include <memory>

namespace {

using namespace talus;
using namespace talus::potential_symmetric;

constexpr Parameter interface_parameters[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded,
           "Potential per metre of a piece's mean height, k: pressure per penetration of square pieces."),
    number("normal_damping", "-", required, 0, 10, "Dashpot across the contact, share of critical."),
};

class PotentialSymmetric final : public ContactModel {
 public:
  explicit PotentialSymmetric(const double* /*values*/) {}

  std::uint32_t doubles_per_contact() const noexcept override { return 0; }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    static thread_local const auto work = std::make_unique<Workspace>();
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const std::uint32_t i = batch.active[k];
      evaluate_pair(batch, loads, batch.pairs[i], loads.pairs[i], *work);
    }
  }

  /// The pressure per depth is k h̄/h. h̄ is at most the mean of h, 2 area/perimeter, which is at most the
  /// radius r of the largest circle within times 2, and h at least a third of the width, which is at least
  /// 2r: so 3 k for either body.
  ContactStiffness stiffness(const double* values, double length) const noexcept override {
    return {3 * values[0] * length, 0, values[1], 0};
  }

 private:
  /// The point nearest to the middle of a contact where its force has the moment of its loads. Dashpots act
  /// in the middle; where they leave next to no force it stays within the contact.
  static Point on_line_of_action(Point middle, const Balance& on_b, Point force, double chord) {
    const double square = dot(force, force);
    if (!(square > 0)) return middle;
    const Point arm = on_b.moment_about(middle) / square * Point{force.y, -force.x};
    const double length = std::sqrt(dot(arm, arm));
    return middle + (length > chord / 2 ? chord / (2 * length) : 1) * arm;
  }

  struct Workspace {
    overlap::AreaFinder finder;
    BaseLoads loads;
  };

  static void evaluate_pair(const ContactBatch& batch, const ContactLoads& loads, const BodyPair& pair,
                            PairReport& report, Workspace& work) {
    report = {};
    report.contact_count = work.finder.find(batch, pair);
    if (report.contact_count == 0) return;
    const LoadSink sink{loads.corner};
    sink.clear(batch, pair);
    Balance balance;
    for (std::uint32_t c = 0; c < report.contact_count; ++c) {
      const overlap::AreaContact& contact = work.finder.contacts()[c];
      const std::span<const overlap::LoadedEdge> edges = work.finder.edges_of(contact);
      double interface[std::size(interface_parameters)];
      overlap::mean_interface(batch.interfaces, edges, interface);
      Balance on_b;
      work.finder.overlaps_of(c, [&](const Overlap& overlap) {
        for (std::uint32_t base = 0; base < 2; ++base)
          report.stored += work.loads.apply(sink, overlap, base, interface[0], balance, on_b);
      });
      const double chord = contact.chord();
      const double push =
          chord > 0 ? std::max(0.0, dot(on_b.force, contact.chord_normal)) / (chord * chord) : 0;
      const double viscous = overlap::viscous_pressure(edges, chord, interface[1], interface[0] * chord,
                                                       pair.reduced_mass, push, batch.dt, report);
      if (viscous != 0) overlap::load_edges(sink, edges, viscous, balance);
      report.penetration = std::max(report.penetration, contact.penetration);
      if (c < pair.slot_capacity && loads.reports != nullptr) {
        const Point force = on_b.force + viscous * contact.chord_normal;
        const Point middle = overlap::middle_of(contact, edges),
                    at = on_line_of_action(middle, on_b, force, chord);
        const double moment = on_b.moment_about(at) + cross(middle - at, viscous * contact.chord_normal);
        loads.reports[pair.slot_start + c] = {at.x, at.y,  force.x, force.y, 0, 0, contact.penetration,
                                              0,    moment};
      }
    }
    if (work.finder.among_strips()) overlap::close_balance(sink, balance, work.finder.edges());
  }
};

constexpr Component components[] = {contact_model<PotentialSymmetric>(
    "potential_symmetric",
    "Munjiza's potential contact: a potential from the boundary to the centroid, both bodies by half.", {},
    interface_parameters, trait::has_potential)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("potential_symmetric", "0.1.0", "the talus authors", components);
