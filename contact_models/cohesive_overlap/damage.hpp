#pragma once

#include <algorithm>
#include <cmath>

namespace talus::cohesive_overlap {

/// What a joint bears, per metre of its length.
struct Strength {
  double normal_stiffness;      ///< α_N, Pa/m, across the open joint
  double tangential_stiffness;  ///< α_T, Pa/m
  double friction;              ///< μ = tan φ
  double cohesion;              ///< c, Pa
  double tensile;               ///< σ_t, Pa
  double softening_opening;     ///< m, from the strength in tension to nothing
  double softening_slip;        ///< m, from the strength in shear to nothing
};

/// How far the two faces of a joint have moved from where they were bonded.
struct Separation {
  double opening;  ///< m, negative where the faces overlap
  double slip;     ///< m

  double open() const { return std::max(0.0, opening); }
};

/// Share of the bond that is gone at a separation that is reached for the first time: 0 within the strength,
/// 1 when broken. The strength is Mohr and Coulomb's with a tension cut-off, in the tractions σ and τ that an
/// intact bond would carry: r = max(σ/σ_t, (|τ| + μσ)/c). Beyond r = 1 what is left falls linearly over the
/// softening lengths; between tension and shear these count by their shares of the elastic energy. `least` m
/// is an opening that is only rounding.
inline double damage_at(const Strength& strength, const Separation& at, double least) {
  const double tension = strength.normal_stiffness * at.open();
  const double shear = strength.tangential_stiffness * std::abs(at.slip);
  const double bearable = std::max(strength.tensile, strength.normal_stiffness * least);
  const double r = std::max(bearable > 0 ? tension / bearable : 0,
                            (shear + strength.friction * tension) / strength.cohesion);
  if (!(r > 1)) return 0;
  const double across = tension * at.open(), along = shear * std::abs(at.slip), both = across + along;
  if (!(both > 0) || std::isinf(r)) return 1;  // nothing to pass where a stage took the cohesion
  // Separation after the strength is passed, as a multiple of that where it was passed.
  const double softening = (across * strength.softening_opening + along * strength.softening_slip) / both;
  const double passed = (across * at.open() + along * std::abs(at.slip)) / both / r;
  return softening > 0 ? std::min(1.0, 1 - (1 - (r - 1) * passed / softening) / r) : 1;
}

}  // namespace talus::cohesive_overlap
