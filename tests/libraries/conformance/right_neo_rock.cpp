// Nothing is wrong with it: compressible neo-Hookean, whose energy is a small difference of large terms.
#include "elastic_rock.hpp"

namespace {

using namespace spoilt;

class RightNeoRock final : public ElasticRock {
 public:
  explicit RightNeoRock(const double* values)
      : ElasticRock(values), shear_(values[0] / 2.4), other_(values[0] * 0.2 / (1.2 * 0.6)) {}

  void evaluate(const talus::MaterialBatch& batch,
                const talus::MaterialResponse& response) const noexcept override {
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      const talus::TwoPointTensor f = talus::tensor_at(batch.deformation, i);
      const double volume = f.xx * f.yy - f.xy * f.yx, growth = std::log(volume);
      // F⁻ᵀ
      const double xx = f.yy / volume, xy = -f.yx / volume, yx = -f.xy / volume, yy = f.xx / volume;
      const double pressing = other_ * growth - shear_;
      response.stress[0][i] = shear_ * f.xx + pressing * xx;
      response.stress[1][i] = shear_ * f.xy + pressing * xy;
      response.stress[2][i] = shear_ * f.yx + pressing * yx;
      response.stress[3][i] = shear_ * f.yy + pressing * yy;
      const double trace = f.xx * f.xx + f.xy * f.xy + f.yx * f.yx + f.yy * f.yy;
      response.energy[i] = shear_ / 2 * (trace - 2 - 2 * growth) + other_ / 2 * growth * growth;
      response.dissipated[i] = 0;
    }
  }

 private:
  double shear_, other_;  ///< Pa, Lamé's moduli
};

constexpr talus::Component components[] = {rock<RightNeoRock>("right_neo_rock")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
