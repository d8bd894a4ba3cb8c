#include "diagnosis/diagnosis.hpp"

#include "archive/archive.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

WorkingScene falling(const std::string& time) {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("base", -4, -2, 4, 0, R"("fixed": true)") + "," + box("block", 0, 0.001, 1, 1.001);
  text.time = time;
  return text;
}

}  // namespace

TEST_CASE("A step above the stable one is found out, with the step that shows it first", "[diagnosis]") {
  const std::string law = GENERATE("overlap_area", "vertex_edge");
  WorkingScene text = falling(R"({"end": 1, "dt": 2e-3})");
  text.law = law;
  Simulation simulation(text.read(), {});
  simulation.advance();
  const Diagnosis diagnosis = diagnose(simulation, 1000);
  INFO(diagnosis_text(simulation.scene(), diagnosis));
  REQUIRE(diagnosis.first_bad);
  const DiagnosedStep &bad = diagnosis.steps[*diagnosis.first_bad],
                      &before = diagnosis.steps[*diagnosis.first_bad - 1];
  CHECK(bad.share > 0.05);
  CHECK(before.share <= 0.05);
  CHECK_FALSE(diagnosis.trouble.empty());
  REQUIRE_FALSE(diagnosis.advice.empty());
  CHECK_THAT(diagnosis.advice[0], Contains("times the stable step") && Contains("less than"));
  const bool told =
      diagnosis.advice.back().find("'vertex_edge', which has no potential") != std::string::npos;
  CHECK(told == (law == "vertex_edge"));
  CHECK_THAT(diagnosis_text(simulation.scene(), diagnosis), Contains("worst contact 'base' and 'block'"));
}

TEST_CASE("Too soft a contact is found out, with the stiffness that would do", "[diagnosis]") {
  WorkingScene text = falling(R"({"end": 1})");
  text.interface =
      R"("normal_stiffness": 1e5, "tangential_stiffness": 1e5, "friction_angle": 30, "normal_damping": 0,
                      "tangential_damping": 0)";
  Simulation simulation(text.read(), {});
  simulation.advance();
  const Diagnosis diagnosis = diagnose(simulation, 100000);
  INFO(diagnosis_text(simulation.scene(), diagnosis));
  REQUIRE(diagnosis.first_bad);
  CHECK(diagnosis.steps[*diagnosis.first_bad].depth > 0.01);
  CHECK(diagnosis.steps[*diagnosis.first_bad - 1].depth <= 0.01);
  CHECK_THAT(diagnosis.trouble, Contains("too deep an overlap"));
  REQUIRE(diagnosis.advice.size() == 1);
  CHECK_THAT(diagnosis.advice[0],
             Contains("raise the normal_stiffness of their interface, by some 30 times"));
}

TEST_CASE("A run that nothing is wrong with gets no advice", "[diagnosis]") {
  Simulation simulation(falling(R"({"end": 0.05})").read(), {});
  simulation.advance();
  const Diagnosis diagnosis = diagnose(simulation, 100000);
  CHECK_FALSE(diagnosis.first_bad);
  CHECK(diagnosis.trouble.empty());
  CHECK(diagnosis.advice.empty());
}

TEST_CASE("A state of a run that kept no contacts is looked at like any other", "[diagnosis]") {
  const WorkingScene text = falling(R"({"end": 0.05})");
  Simulation seen(text.read(), {}), spare(text.read(), {.contacts_as_recorded = true});
  for (Simulation* each : {&seen, &spare}) {
    while (each->deepest_overlap().penetration == 0) REQUIRE(each->advance());
  }
  REQUIRE(seen.contacts().size() == 1);
  CHECK(spare.contacts().empty());
  CHECK(spare.state_hash() == seen.state_hash());
  Archive kept;
  spare.exchange(kept);
  Simulation again(text.read(), {});
  Archive taken(kept.bytes());
  again.exchange(taken);
  const Diagnosis diagnosis = diagnose(again, 3), wanted = diagnose(seen, 3);
  REQUIRE(diagnosis.steps.size() == wanted.steps.size());
  for (std::size_t i = 0; i < wanted.steps.size(); ++i) {
    CHECK(diagnosis.steps[i].depth == wanted.steps[i].depth);
    CHECK(diagnosis.steps[i].body_b == wanted.steps[i].body_b);
  }
  CHECK(again.contacts().size() == 1);
}
