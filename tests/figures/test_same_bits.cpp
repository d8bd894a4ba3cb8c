#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <deque>

using namespace talus;
using namespace talus::figures;

namespace {

struct Short {
  const char* scene;
  std::vector<Override> overrides;
};

Scene at_level(const Short& what, SimdLevel level) {
  static std::deque<Registry> registries;  // scenes point into them
  Registry& registry = registries.emplace_back();
  registry.simd = level;
  const std::filesystem::path folder = TALUS_PLUGINS;
  load_folders(registry, {&folder, 1});
  return read_scene(std::filesystem::path(TALUS_SCENES) / (std::string(what.scene) + ".json"), registry,
                    {what.overrides});
}

}  // namespace

TEST_CASE("Same bits with any number of threads, without the skin, and with any instruction set",
          "[figures][same_bits]") {
  const Short what =
      GENERATE(Short{"vaiont", {{"/time/end", "0.05"}, {"/settle/duration", "0.02"}}},
               Short{"brick_wall", {{"/time/end", "0.003"}}},
               Short{"contact_patch", {{"/time/end", "0.0001"}, {"/settle/duration", "0.001"}}});
  CAPTURE(what.scene);
  const Scene best = at_level(what, best_simd_level());
  const std::string due = hash_after(best, {1, true});
  CHECK(hash_after(best, {2, true}) == due);
  CHECK(hash_after(best, {4, true}) == due);
  CHECK(hash_after(best, {1, false}) == due);
  for (int level = 0; level < static_cast<int>(best_simd_level()); ++level) {
    CAPTURE(level);
    CHECK(hash_after(at_level(what, static_cast<SimdLevel>(level)), {1, true}) == due);
  }
}
