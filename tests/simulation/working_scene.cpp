#include "working_scene.hpp"

#include "scene/read.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace talus {

Registry& shipped_registry() {
  static Registry registry = [] {
    Registry all;
    load_folders(all, std::array{std::filesystem::path(TALUS_PLUGINS)});
    return all;
  }();
  return registry;
}

std::string box(const std::string& name, double left, double bottom, double right, double top,
                const std::string& more) {
  return fmt::format(
      R"({{"name": "{0}", "material": "rock", "polygon": [[{1:.17g}, {2:.17g}], [{3:.17g}, {2:.17g}],
          [{3:.17g}, {4:.17g}], [{1:.17g}, {4:.17g}]]{5}{6}}})",
      name, left, bottom, right, top, more.empty() ? "" : ", ", more);
}

Scene WorkingScene::read(Registry& registry) const {
  const std::string text = fmt::format(
      R"({{"talus": 1, "gravity": {}, "materials": {{"rock": {{{}}}}}, "cover": {{"model": "{}"}},
          "contact": {{"model": "{}"}}, "interfaces": [{{"between": ["*", "*"], {}}}], {}
          "bodies": [{}], "monitors": [{}], "time": {}, "output": {}}})",
      gravity, material, cover, law, interface, rest, bodies, monitors, time, output);
  return read_scene_text(text, "working.json", registry);
}

WorkingScene resting_block() {
  WorkingScene text;
  text.cover = "block";
  text.gravity = "[0, -10]";
  text.bodies = box("base", -1, -1, 3, 0, R"("fixed": true)") + ", " + box("a", 0, 0, 2, 1);
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.time = R"({"end": 0.1})";
  return text;
}

Simulation run_to_end(const WorkingScene& text) {
  Simulation simulation(text.read(), {});
  while (simulation.advance()) {
  }
  return simulation;
}

Simulation settle_and_run(const WorkingScene& text) {
  Simulation simulation(text.read(), {});
  if (!simulation.settle()) throw std::runtime_error("the scene did not settle to its end");
  while (simulation.advance()) {
  }
  return simulation;
}

double residual_share(const EnergyLedger& ledger) {
  return std::abs(ledger.residual) / ledger.throughput;
}

}  // namespace talus
