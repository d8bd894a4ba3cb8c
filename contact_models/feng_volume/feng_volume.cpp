// Contact by the area of the overlap as a whole: one pressure over both arcs of its boundary. See README.md
// beside.

#include <talus/library.hpp>
#include <talus/overlap/area_contact.hpp>

#include <memory>

namespace {

using namespace talus;

constexpr Parameter parameters[] = {
    number(
        "least_penetration", "-", 1e-4, 1e-8, 1,
        "Penetration, as a share of the contact's length, from which on the declared stiffness is a bound."),
};

constexpr Parameter interface_parameters[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded,
           "Pressure per square root of the overlap's area, κ."),
    number("normal_damping", "-", required, 0, 10, "Dashpot across the contact, share of critical."),
};

class FengVolume final : public ContactModel {
 public:
  explicit FengVolume(const double* values) : least_penetration_(values[0]) {}

  std::uint32_t doubles_per_contact() const noexcept override { return 0; }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    static thread_local const auto finder = std::make_unique<overlap::AreaFinder>();
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const std::uint32_t i = batch.active[k];
      evaluate_pair(batch, loads, batch.pairs[i], loads.pairs[i], *finder);
    }
  }

  /// dF/dd = p' b² with p = κ√A and A = b d: κ b/2 √(b/d), which falls as the contact gets deeper.
  ContactStiffness stiffness(const double* values, double length) const noexcept override {
    return {values[0] * length / (2 * std::sqrt(least_penetration_)), 0, values[1], 0};
  }

 private:
  void evaluate_pair(const ContactBatch& batch, const ContactLoads& loads, const BodyPair& pair,
                     PairReport& report, overlap::AreaFinder& finder) const {
    report = {};
    report.contact_count = finder.find(batch, pair);
    if (report.contact_count == 0) return;
    const overlap::LoadSink sink{loads.corner};
    sink.clear(batch, pair);
    overlap::Balance balance;
    for (std::uint32_t c = 0; c < report.contact_count; ++c) {
      const overlap::AreaContact& contact = finder.contacts()[c];
      const std::span<const overlap::LoadedEdge> edges = finder.edges_of(contact);
      double interface[std::size(interface_parameters)];
      overlap::mean_interface(batch.interfaces, edges, interface);
      const double chord = contact.chord(), area = bearing_area(contact.area, chord);
      const double elastic = interface[0] * std::sqrt(area);
      const double root = std::max(std::sqrt(area), std::sqrt(least_penetration_) * chord);
      const double stiffness = chord > 0 ? interface[0] / (2 * root) * chord * chord : 0;
      const double pressure =
          elastic + overlap::viscous_pressure(edges, chord, interface[1], stiffness, pair.reduced_mass,
                                              elastic, batch.dt, report);
      overlap::load_edges(sink, edges, pressure, balance);
      report.stored += 2 * elastic * area / 3;
      report.penetration = std::max(report.penetration, contact.penetration);
      if (c < pair.slot_capacity && loads.reports != nullptr) {
        const overlap::Point at = overlap::middle_of(contact, edges), force = pressure * contact.chord_normal;
        loads.reports[pair.slot_start + c] = {
            at.x, at.y, force.x, force.y, 0, 0, contact.penetration, 0, moment_on_b(edges, pressure, at)};
      }
    }
    if (finder.among_strips()) overlap::close_balance(sink, balance, finder.edges());
  }

  /// √A would make a force of overlaps that are rounding: of 26 N/m on 3e-14 m where two elements meet.
  static double bearing_area(double area, double chord) {
    constexpr double rounding = 1e-11;  // depth over length
    return area > rounding * chord * chord ? area : 0;
  }

  /// N, of a pressure on all edges.
  static double moment_on_b(std::span<const overlap::LoadedEdge> edges, double pressure,
                            overlap::Point about) {
    double moment = 0;
    for (const overlap::LoadedEdge& edge : edges) {
      if (edge.body == 1) moment -= pressure * cross(edge.middle - about, edge.outward);
    }
    return moment;
  }

  double least_penetration_;
};

constexpr Component components[] = {contact_model<FengVolume>(
    "feng_volume",
    "Contact by the area of the overlap as a whole: one pressure, a force along the normal of its chord.",
    parameters, interface_parameters, trait::has_potential)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("feng_volume", "0.1.0", "the talus authors", components);
