// Isotropic linear elasticity in the frame that turns with the body. See README.md beside.

#include <talus/library.hpp>

#include <cmath>

namespace {

using namespace talus;

constexpr Parameter parameters[] = {
    number("young_modulus", "Pa", required, 1e-300, unbounded, "Young's modulus E."),
    number("poisson_ratio", "-", required, 0, 0.499, "Poisson's ratio ν."),
    choice("plane", "strain|stress", 0,
           "Plane strain (a slice of something long) or plane stress (a free plate)."),
};

/// Total corotational form: F = R U by polar decomposition from the reference, Biot strain U − I, σ̂ = D ε̂
/// (Eq. 2, 7). No rate is integrated, so a spinning block gathers no strain. Π = ½ ε̂ᵀ D ε̂ per reference
/// volume.
class LinearElastic final : public Material {
 public:
  explicit LinearElastic(const double* values) {
    const double young = values[0], poisson = values[1];
    if (values[2] == 0) {
      const double factor = young / ((1 + poisson) * (1 - 2 * poisson));
      along_ = factor * (1 - poisson);
      across_ = factor * poisson;
    } else {
      along_ = young / (1 - poisson * poisson);
      across_ = poisson * along_;
    }
    shear_ = young / (2 * (1 + poisson));
  }

  std::uint32_t doubles_per_element() const noexcept override { return 0; }

  void evaluate(const MaterialBatch& batch, const MaterialResponse& response) const noexcept override {
    const double* const* f = batch.deformation;
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      // Rotation of the plane polar decomposition: (cos, sin) ∝ (F_xx + F_yy, F_yx − F_xy).
      const double trace = f[0][i] + f[3][i], skew = f[2][i] - f[1][i];
      const double size = std::sqrt(trace * trace + skew * skew);
      const double c = trace / size, s = skew / size;
      const double xx = c * f[0][i] + s * f[2][i] - 1;
      const double yy = -s * f[1][i] + c * f[3][i] - 1;
      const double xy = (c * f[1][i] + s * f[3][i] - s * f[0][i] + c * f[2][i]) / 2;
      const double txx = along_ * xx + across_ * yy, tyy = across_ * xx + along_ * yy, txy = 2 * shear_ * xy;
      response.stress[0][i] = c * txx - s * txy;
      response.stress[1][i] = c * txy - s * tyy;
      response.stress[2][i] = s * txx + c * txy;
      response.stress[3][i] = s * txy + c * tyy;
      response.energy[i] = (txx * xx + tyy * yy + 2 * txy * xy) / 2;
      response.dissipated[i] = 0;
    }
  }

  void stiffest_tangent(double tangent[9]) const noexcept override {
    const double values[9] = {along_, across_, 0, across_, along_, 0, 0, 0, shear_};
    for (int i = 0; i < 9; ++i) tangent[i] = values[i];
  }

 private:
  double along_, across_, shear_;  ///< Pa: D_11 = D_22, D_12, D_33
};

constexpr Component components[] = {material<LinearElastic>(
    "linear_elastic", "Isotropic linear elasticity, corotational: exact under any rotation.", parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("linear_elastic", "0.1.0", "the talus authors", components);
