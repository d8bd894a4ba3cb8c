// The contact law my_component. See README.md beside.

#include <talus/library.hpp>
#include <talus/overlap/distributed_contact.hpp>

#include <memory>

namespace {

constexpr talus::Parameter interface_parameters[] = {
    talus::number("normal_stiffness", "Pa/m", talus::required, 0, talus::unbounded,
                  "Pressure per metre of depth."),
    talus::number("tangential_stiffness", "Pa/m", talus::required, 0, talus::unbounded,
                  "Shear traction per metre of slip in stick."),
    talus::number("friction_angle", "deg", talus::required, 0, 89.9, "Friction angle φ, μ = tan φ."),
    talus::number("normal_damping", "-", talus::required, 0, 10,
                  "Dashpot across the contact, share of critical."),
    talus::number("tangential_damping", "-", talus::required, 0, 10,
                  "Dashpot along the contact while it sticks, share of critical."),
};

class MyComponent final : public talus::ContactModel {
 public:
  // ---- the law: these lines are yours
  // ------------------------------------------------------------------------
  /// Normal pressure [Pa] at a depth [m] behind the side of the master, and its slope [Pa/m].
  static talus::overlap::Pressure pressure(const talus::overlap::InterfaceParameters& at, double depth) {
    return {at.normal_stiffness * depth, at.normal_stiffness};
  }
  /// The largest slope [Pa/m] that bodies may meet: the time step is made for it.
  static double stiffest(const double* values) { return values[0]; }
  // ---- the rest: overlaps, friction, damping and loads come from the kit
  // ---------------------------------------

  static constexpr bool frictional = true;

  explicit MyComponent(const double* /*values*/) {}

  std::uint32_t doubles_per_contact() const noexcept override { return talus::overlap::friction_doubles; }

  void prepare_interface(double* values) const noexcept override { values[2] = std::tan(values[2]); }

  void evaluate(const talus::ContactBatch& batch, const talus::ContactLoads& loads) const noexcept override {
    static thread_local const auto contact =
        std::make_unique<talus::overlap::DistributedContact<MyComponent>>();
    contact->evaluate(*this, batch, loads);
  }

  talus::ContactStiffness stiffness(const double* values, double length) const noexcept override {
    const double tangential = values[2] > 0 ? values[1] * length : 0;
    return {stiffest(values) * length, tangential, values[3], values[2] > 0 ? values[4] : 0};
  }

  static talus::overlap::FrictionRule rule() { return talus::overlap::FrictionRule::return_mapping; }

  static talus::overlap::InterfaceParameters interface(const double* values) {
    return {values[0], values[1], values[2], values[3], values[4]};
  }
};

constexpr talus::Component components[] = {
    talus::contact_model<MyComponent>("my_component", "Pressure proportional to depth, friction per overlap.",
                                      {}, interface_parameters, talus::trait::has_potential)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("my_component", "0.1.0", "its author", components);
