#include "allocations/counted.hpp"
#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <deque>

using namespace talus;
using namespace talus::figures;

namespace {

/// How often anybody asked for memory between two output times.
struct Observed {
  std::uint64_t steps, searches, allocations;
};

Observed observe(Simulation& simulation, double until) {
  const RunSummary before = simulation.summary();
  const CountedAllocations counted;
  while (simulation.time() < until) simulation.advance();
  const std::uint64_t allocations = counted.so_far();
  const RunSummary after = simulation.summary();
  return {after.steps - before.steps, after.pair_searches - before.pair_searches, allocations};
}

/// After a warm-up in which contacts have come to be and all arrays have found their size. A thread has its
/// own to find when it first takes part, which may be late where its core is taken: then the next interval
/// counts.
Observed observe(const Scene& scene, const RunSettings& settings, double warm_up, double until) {
  Simulation simulation(scene, settings);
  while (simulation.time() < warm_up) simulation.advance();
  Observed seen = observe(simulation, until);
  for (int late = 1; late < settings.threads + 3 && settings.threads > 1 && seen.allocations > 0; ++late)
    seen = observe(simulation, until + late * (until - warm_up));
  return seen;
}

struct Stack {
  std::string name, scene;  ///< a shipped one, or its text
  std::string cover{};      ///< of a shipped one
};

/// Two bodies of many elements, one with slivers and a support, and one block; all sides press on sides.
constexpr const char* lattices = R"({"talus": 1, "gravity": [0, -10],
  "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}},
  "contact": {"model": "overlap_area"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                  "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}],
  "bodies": [
    {"name": "base", "polygon": [[-2, -1], [4, -1], [4, 0], [-2, 0]], "material": "rock", "fixed": true,
     "cover": {"model": "block"}},
    {"name": "low", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "material": "rock", "fix": ["x", "rotation"],
     "cover": {"model": "hexagonal", "size": 0.17, "angle": 17}},
    {"name": "middle", "polygon": [[0.2, 1], [1.8, 1], [1.8, 1.7], [0.2, 1.7]], "material": "rock",
     "cover": {"model": "hexagonal", "size": 0.21, "offset_x": 0.05}},
    {"name": "top", "polygon": [[0.4, 1.7], [1.4, 1.7], [1.4, 2.2], [0.4, 2.2]], "material": "rock",
     "cover": {"model": "block"}}],
  "damping": 50,
  "time": {"end": 1}, "output": {"history": 0.01}})";

/// A wall of twelve bricks of many elements: more pairs than one thread has for itself.
std::string lattice_wall() {
  std::string bodies =
      R"({"name": "base", "polygon": [[-1, -1], [6, -1], [6, 0], [-1, 0]], "material": "rock", "fixed": true,
          "cover": {"model": "block"}})";
  for (int course = 0; course < 3; ++course) {
    for (int i = 0; i < 4; ++i) {
      const double left = i + 0.5 * (course % 2), low = 0.5 * course;
      bodies += fmt::format(R"(, {{"name": "c{0}b{1}", "material": "rock",
                                   "polygon": [[{2}, {3}], [{4}, {3}], [{4}, {5}], [{2}, {5}]]}})",
                            course, i, left, low, left + 1, low + 0.5);
    }
  }
  return fmt::format(R"({{"talus": 1, "gravity": [0, -10],
    "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}}}},
    "cover": {{"model": "hexagonal", "size": 0.4, "angle": 11}}, "contact": {{"model": "overlap_area"}},
    "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                    "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}}],
    "bodies": [{}], "damping": 50, "time": {{"end": 1}}, "output": {{"history": 0.01}}}})",
                     bodies);
}

Scene scene_of(const Stack& stack, const char* law) {
  std::vector<Override> overrides{
      {"/contact/model", law}, {"/time/safety", "0.2"}, {"/output/history", "0.0005"}};
  if (stack.scene.starts_with("{")) return from_text(stack.scene, overrides);
  overrides.push_back({"/cover/model", stack.cover});
  return shipped(stack.scene, overrides);
}

Scene allocating_scene() {
  static std::deque<Registry> registries;  // scenes point into them
  Registry& all = registries.emplace_back(registry());
  load_library(all, TALUS_ALLOCATING_LAW);
  return read_scene(std::filesystem::path(TALUS_SCENES) / "column.json", all,
                    {{{"/contact/model", "allocating"}, {"/time/dt", "1e-5"}}});
}

}  // namespace

TEST_CASE("Memory that a library loaded at run time asks for is counted", "[allocations]") {
  const Observed seen = observe(allocating_scene(), {}, 0.005, 0.01);
  CHECK(seen.steps == 500);
  CHECK(seen.allocations == 3 * seen.steps);  // ten pairs are one batch
}

TEST_CASE("Steps ask for no memory, nor does a search for neighbours", "[allocations]") {
  const Stack stack =
      GENERATE(Stack{"blocks", "brick_wall", "block"}, Stack{"rigid bodies", "brick_wall", "rigid"},
               Stack{"bodies of many elements", lattices}, Stack{"a wall of many elements", lattice_wall()});
  const char* law = GENERATE("overlap_area", "vertex_edge", "frictionless");
  const RunSettings settings = GENERATE(RunSettings{1, true}, RunSettings{1, false}, RunSettings{2, true});
  CAPTURE(stack.name, law, settings.threads, settings.neighbour_skin);
  // Laws lay out what they clip polygons with when the first pair needs it: in the wall after 7 ms.
  const Observed seen = observe(scene_of(stack, law), settings, 0.01, 0.014);
  CHECK(seen.steps > 40);
  CHECK(seen.searches == (settings.neighbour_skin ? 0 : seen.steps));
  CHECK(seen.allocations == 0);
}
