#include "working_scene.hpp"

#include <talus/material.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <string>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// What is wrong with a material that bears nothing.
enum class Fault { none, stress, energy, many_states, viscous_time, tangent };

Fault fault = Fault::none;  // a material has no other way to be told

class FaultyMaterial final : public Material {
 public:
  std::uint32_t doubles_per_element() const noexcept override {
    return fault == Fault::many_states ? 4097 : 0;
  }
  void evaluate(const MaterialBatch& batch, const MaterialResponse& response) const noexcept override {
    for (double* stress : response.stress) std::fill_n(stress, batch.count, value(Fault::stress));
    std::fill_n(response.energy, batch.count, value(Fault::energy));
    std::fill_n(response.dissipated, batch.count, 0.0);
  }
  void stiffest_tangent(double tangent[9]) const noexcept override {
    for (int i = 0; i < 9; ++i) tangent[i] = i % 4 == 0 ? 1e9 : 0;
    if (fault == Fault::tangent) tangent[8] = 0;
  }
  double viscous_time() const noexcept override { return fault == Fault::viscous_time ? -1 : 0; }

 private:
  static double value(Fault one) { return fault == one ? std::numeric_limits<double>::quiet_NaN() : 0; }
};

const Component faulty_component = [] {
  Component component{};
  component.kind = ComponentKind::material;
  component.name = "faulty";
  component.sentence = "Bears nothing.";
  component.create = [](const double*, char*, std::size_t) noexcept -> void* {
    return static_cast<Material*>(new FaultyMaterial);
  };
  component.destroy = [](void* made) noexcept { delete static_cast<Material*>(made); };
  return component;
}();

/// Takes a free block of the material through some steps.
void run_with(Fault one, const std::string& cover) {
  static const RegisteredComponent component{&faulty_component, nullptr, "/plugins/libfaulty.so"};
  WorkingScene text;
  text.cover = "block";
  text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [1, 0], "cover": )" + cover);
  text.time = R"({"end": 0.01})";
  Scene scene = text.read();
  scene.materials[0].model = {&component, {}};
  fault = one;
  Simulation simulation(scene, {});
  while (simulation.advance()) {
  }
}

}  // namespace

TEST_CASE("A material that gives no numbers stops the run and is named", "[simulation][trouble]") {
  const std::string cover = GENERATE(R"({"model": "block"})", R"({"model": "hexagonal", "size": 0.5})");
  CAPTURE(cover);
  CHECK_NOTHROW(run_with(Fault::none, cover));
  for (const auto& [one, words] :
       {std::pair{Fault::stress, "the kinetic energy of 'a' at (0.5, 0.5) m is no longer a number"},
        {Fault::energy, "the strain energy is no longer a number"}}) {
    CHECK_THROWS_WITH(run_with(one, cover),
                      Contains(words) && Contains("or mend the material: 'faulty' of /plugins/libfaulty.so"));
  }
}

TEST_CASE("A material that asks for what no run can give is refused by name", "[simulation][plugin]") {
  for (const auto& [one, words] :
       {std::pair{Fault::many_states, "gave 4097 as the doubles it keeps per element; wanted 4096 at most"},
        {Fault::viscous_time, "gave -1 as its viscous time"},
        {Fault::tangent, "gave 0 as an entry of its stiffest tangent"}}) {
    CHECK_THROWS_WITH(run_with(one, R"({"model": "block"})"),
                      Contains("/plugins/libfaulty.so: material 'faulty' ") && Contains(words));
  }
}
