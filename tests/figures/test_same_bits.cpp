#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <deque>

using namespace talus;
using namespace talus::figures;

namespace {

struct Short {
  std::string name, scene;  ///< a file, or the text of a scene
  std::vector<Override> overrides;
};

std::string shipped_file(const std::string& name) {
  return TALUS_SCENES "/" + name + ".json";
}

std::string generated_file(const std::string& name) {
  return TALUS_GENERATED_SCENES "/" + name + ".json";
}

/// A free body of some ten thousand elements in several subdomains, struck at a corner.
constexpr const char* struck_lattice = R"({"talus": 1,
  "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}},
  "cover": {"model": "hexagonal", "size": 0.15},
  "bodies": [{"name": "a", "polygon": [[0, 0], [10, 0], [10, 10], [0, 10]], "material": "rock"}],
  "loads": [{"body": "a", "point": [10, 10], "force": [-1e6, -2e5]}],
  "time": {"end": 0.0003}})";

Scene at_level(const Short& what, SimdLevel level) {
  static std::deque<Registry> registries;  // scenes point into them
  Registry& registry = registries.emplace_back();
  registry.simd = level;
  const std::filesystem::path folder = TALUS_PLUGINS;
  load_folders(registry, {&folder, 1});
  if (what.scene.starts_with("{")) return read_scene_text(what.scene, what.name, registry, {what.overrides});
  return read_scene(what.scene, registry, {what.overrides});
}

/// Triangles and quadrilaterals in one group, on a floor.
constexpr const char* mixed_shapes = R"({"talus": 1, "gravity": [0, -10],
  "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.25}},
  "cover": {"model": "block"}, "contact": {"model": "overlap_area"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "tangential_stiffness": 5e7,
                  "friction_angle": 20, "normal_damping": 0.1, "tangential_damping": 0.1}],
  "bodies": [{"name": "floor", "polygon": [[-3, -1], [9, -1], [9, 0], [-3, 0]], "material": "rock", "fixed": true},
             {"name": "a", "polygon": [[0.7, 0], [1, 0.6], [0.3, 0.9]], "material": "rock"},
             {"name": "b", "polygon": [[1.2, 0.1], [2, 0.01], [2.1, 0.7], [1.3, 0.8]], "material": "rock"},
             {"name": "c", "polygon": [[2.3, 0.02], [3.1, 0.04], [2.7, 0.7]], "material": "rock"},
             {"name": "d", "polygon": [[3.3, 0.3], [3.9, 0], [4.3, 0.8], [3.6, 0.9]], "material": "rock"}],
  "time": {"end": 0.3}})";

/// What is told of all contacts in a run.
std::vector<double> told_of_contacts(const Short& what, SimdLevel level) {
  Simulation simulation(at_level(what, level), {});
  std::vector<double> told;
  while (simulation.advance()) {
    for (const Contact& contact : simulation.contacts()) {
      told.insert(told.end(), {contact.point.x, contact.point.y, contact.normal_force.x,
                               contact.normal_force.y, contact.tangential_force.x, contact.tangential_force.y,
                               contact.penetration, contact.moment});
    }
  }
  return told;
}

void check_bits(const Short& what) {
  CAPTURE(what.name);
  const SimdLevel best_level = best_simd_level();
  const Scene best = at_level(what, best_level);
  const std::string due = hash_after(best, {1, true});
  for (const RunSettings& other : {RunSettings{2, true}, RunSettings{4, true}, RunSettings{1, false}}) {
    CAPTURE(other.threads, other.neighbour_skin);
    CHECK(hash_after(best, other) == due);
  }
  for (int level = 0; level < static_cast<int>(best_level); ++level) {
    const Scene scene = at_level(what, static_cast<SimdLevel>(level));
    for (const RunSettings& other : {RunSettings{1, true}, RunSettings{2, true}, RunSettings{4, false}}) {
      CAPTURE(level, other.threads, other.neighbour_skin);
      CHECK(hash_after(scene, other) == due);
    }
  }
}

}  // namespace

TEST_CASE("Same bits with any number of threads, without the skin, and with any instruction set",
          "[figures][same_bits][slow_sanitised]") {
  check_bits(
      GENERATE(Short{"vaiont", shipped_file("vaiont"), {{"/time/end", "0.02"}, {"/settle/duration", "0.01"}}},
               Short{"brick_wall", shipped_file("brick_wall"), {{"/time/end", "0.0015"}}},
               Short{"brick_wall with heavy strain",
                     shipped_file("brick_wall"),
                     {{"/time/end", "0.0015"}, {"/cover", R"({"model": "block", "strain_mass_scale": 9})"}}},
               Short{"contact_patch",
                     shipped_file("contact_patch"),
                     {{"/time/end", "0.0001"}, {"/settle/duration", "0.0005"}}}));
}

TEST_CASE("What is told of contacts has the same bits with any instruction set", "[figures][same_bits]") {
  const Short what{"mixed shapes", mixed_shapes, {{"/output", R"({"history": 0.005})"}}};
  const std::vector<double> due = told_of_contacts(what, SimdLevel::scalar);
  REQUIRE(due.size() > 100);
  for (int level = 1; level <= static_cast<int>(best_simd_level()); ++level)
    CHECK(told_of_contacts(what, static_cast<SimdLevel>(level)) == due);
}

TEST_CASE("Same bits in all scenes that are measured", "[slow][figures][same_bits]") {
  const std::vector<Override> sliding{{"/time/end", "0.003"}, {"/time/safety", "0.4"}};
  check_bits(GENERATE_COPY(
      Short{"column", shipped_file("column"), {{"/time/end", "0.02"}}},
      Short{"wall of vertex_edge",
            shipped_file("brick_wall"),
            {{"/time/end", "0.001"}, {"/contact/model", "vertex_edge"}}},
      Short{"sliding, symmetric", generated_file("sliding_symmetric"), sliding},
      Short{"sliding, one-sided", generated_file("sliding_one_sided"), sliding},
      Short{"sliding, rigid", generated_file("sliding_rigid"), sliding},
      Short{"pile", generated_file("pile"), {{"/time/end", "0.002"}}}, Short{"lattice", struck_lattice, {}},
      Short{"sliding, of many elements",
            generated_file("sliding_symmetric"),
            {{"/cover", R"({"model": "hexagonal", "size": 0.4})"}, {"/time/end", "0.0002"}}}));
}

TEST_CASE("Same bits after neighbours have been sought anew", "[figures][same_bits][slow_sanitised]") {
  // Bodies that move by 1 to 2 m/s against each other use up what the skin leaves to each, 0.05 m.
  const Scene scene = at_level(
      {"sliding", generated_file("sliding_symmetric"), {{"/time/end", "0.066"}, {"/time/safety", "0.4"}}},
      best_simd_level());
  Simulation simulation(scene, {});
  while (simulation.advance()) {
  }
  REQUIRE(simulation.summary().pair_searches > 1);
  CHECK(hash_after(scene, {2, true}) == simulation.state_hash());
  CHECK(hash_after(scene, {1, false}) == simulation.state_hash());
}
