// The normal part of the overlap-area law alone. See README.md beside.

#include <talus/library.hpp>
#include <talus/overlap/distributed_contact.hpp>

#include <memory>

namespace {

using namespace talus;

constexpr Parameter interface_parameters[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded, "Pressure per metre of penetration, α_N."),
    number("normal_damping", "-", required, 0, 10, "Dashpot across the contact, share of critical."),
};

class Frictionless final : public ContactModel {
 public:
  static constexpr bool frictional = false;

  explicit Frictionless(const double* /*values*/) {}

  std::uint32_t doubles_per_contact() const noexcept override { return 0; }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    static thread_local const auto contact = std::make_unique<overlap::DistributedContact<Frictionless>>();
    contact->evaluate(*this, batch, loads);
  }

  ContactStiffness stiffness(const double* values, double length) const noexcept override {
    return {values[0] * length, 0, values[1], 0};
  }

  static overlap::InterfaceParameters interface(const double* values) {
    return {.normal_stiffness = values[0], .normal_damping = values[1]};
  }
};

constexpr Component components[] = {contact_model<Frictionless>(
    "frictionless", "The overlap-area law without its tangential part: no friction, no history.", {},
    interface_parameters, trait::has_potential | trait::spread_springs)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("frictionless", "0.1.0", "the talus authors", components);
