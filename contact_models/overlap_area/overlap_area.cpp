// The overlap-area law: pressure proportional to the distance to the nearest side of the master, friction on
// the tangential displacement of the whole overlap. See README.md beside.

#include <talus/library.hpp>
#include <talus/overlap/distributed_contact.hpp>

#include <memory>
#include <new>

namespace {

using namespace talus;

constexpr Parameter parameters[] = {
    choice("friction_rule", "return_mapping|paper", 0,
           "Elastic trial and return to the Coulomb limit, or Table 1 of the paper to the letter (V := 0 at "
           "slip, no tangential dashpot)."),
};

constexpr Parameter interface_parameters[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded, "Pressure per metre of penetration, α_N."),
    number("tangential_stiffness", "Pa/m", required, 0, unbounded,
           "Shear traction per metre of slip in stick, α_T."),
    number("friction_angle", "deg", required, 0, 89.99995, "Friction angle φ, μ = tan φ."),
    number("normal_damping", "-", required, 0, 10, "Dashpot across the contact, share of critical."),
    number("tangential_damping", "-", required, 0, 10,
           "Dashpot along the contact while it sticks, share of critical."),
};

class OverlapArea final : public ContactModel {
 public:
  static constexpr bool frictional = true;

  explicit OverlapArea(const double* values)
      : rule_(values[0] == 1 ? overlap::FrictionRule::paper : overlap::FrictionRule::return_mapping) {}

  std::uint32_t doubles_per_contact() const noexcept override { return overlap::friction_doubles; }

  void prepare_interface(double* values) const noexcept override { values[2] = std::tan(values[2]); }

  BatchPlan* make_plan() const noexcept override { return new (std::nothrow) overlap::LanePlan; }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    static thread_local const auto contact = std::make_unique<overlap::DistributedContact<OverlapArea>>();
    contact->evaluate(*this, batch, loads);
  }

  ContactStiffness stiffness(const double* values, double length) const noexcept override {
    return {values[0] * length, values[2] > 0 ? values[1] * length : 0, values[3],
            values[2] > 0 ? values[4] : 0};
  }

  overlap::FrictionRule rule() const { return rule_; }

  static overlap::InterfaceParameters interface(const double* values) {
    return {values[0], values[1], values[2], values[3], values[4]};
  }

 private:
  overlap::FrictionRule rule_;
};

constexpr Component components[] = {contact_model<OverlapArea>(
    "overlap_area",
    "Contact by overlap area: pressure by distance to the nearest master side, friction per overlap.",
    parameters, interface_parameters, trait::has_potential | trait::spread_springs)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("overlap_area", "0.1.0", "the talus authors", components);
