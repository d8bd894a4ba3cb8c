// A law, a material and a cover that do next to nothing and count how often they are asked.
#include "counting.hpp"

#include "descriptor.hpp"

extern "C" __attribute__((visibility("default"))) AskedSoFar talus_test_asked;
AskedSoFar talus_test_asked;

namespace {

/// Finds no contact, and does not say how far bodies are apart: so it is asked about each pair in each step.
class CountingLaw : public SilentLaw {
 public:
  using SilentLaw::SilentLaw;

  void evaluate(const talus::ContactBatch& batch, const talus::ContactLoads& loads) const noexcept override {
    ++talus_test_asked.law;
    talus_test_asked.pairs += batch.active_count;
    for (std::uint32_t i = 0; i < batch.active_count; ++i) loads.pairs[batch.active[i]] = {};
  }
};

/// Finds all bodies a millimetre apart.
class DistantLaw : public CountingLaw {
 public:
  using CountingLaw::CountingLaw;

  void evaluate(const talus::ContactBatch& batch, const talus::ContactLoads& loads) const noexcept override {
    CountingLaw::evaluate(batch, loads);
    for (std::uint32_t i = 0; i < batch.active_count; ++i) loads.pairs[batch.active[i]].gap = 1e-3;
  }
};

/// Bears nothing.
class CountingMaterial : public talus::Material {
 public:
  explicit CountingMaterial(const double* /*values*/) {}

  std::uint32_t doubles_per_element() const noexcept override { return 0; }
  bool needs_previous_deformation() const noexcept override { return false; }
  void evaluate(const talus::MaterialBatch& batch,
                const talus::MaterialResponse& response) const noexcept override {
    ++talus_test_asked.material;
    talus_test_asked.elements += batch.count;
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      for (double* stress : response.stress) stress[i] = 0;
      response.energy[i] = response.dissipated[i] = 0;
    }
  }
  void stiffest_tangent(double tangent[9]) const noexcept override {
    for (int i = 0; i < 9; ++i) tangent[i] = i % 4 == 0 ? 1e9 : 0;
  }
};

class CountingCover : public talus::CoverBuilder {
 public:
  explicit CountingCover(const double* /*values*/) {}

  void build(const talus::BodyShape& /*body*/, talus::CoverSink& sink) const noexcept override {
    ++talus_test_asked.cover;
    sink.make_rigid();
  }
};

constexpr talus::Component components[] = {law<CountingLaw>("counting"), law<DistantLaw>("distant"),
                                           talus::material<CountingMaterial>("counting", "Counts.", {}),
                                           talus::cover_builder<CountingCover>("counting", "Counts.", {})};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 4);
