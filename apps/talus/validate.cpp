#include "commands.hpp"
#include "exit_code.hpp"
#include "output/history.hpp"
#include "output/run_record.hpp"
#include "preview_rows.hpp"
#include "scene_options.hpp"
#include "simulation/simulation.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace talus {

namespace {

constexpr double trial_seconds = 0.25;

std::string bodies_text(const Scene& scene) {
  std::map<std::string, int> covers;
  int fixed = 0;
  for (const SceneBody& body : scene.bodies) {
    if (body.fixed) {
      ++fixed;
    } else if (body.cover.component != nullptr) {
      ++covers[body.cover.component->component->name];
    }
  }
  std::string text = fmt::format("{}", scene.bodies.size());
  if (fixed > 0) text += fmt::format(", {} fixed", fixed);
  for (const auto& [name, count] : covers) text += fmt::format(", {} with cover {}", count, name);
  return text;
}

std::string materials_text(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneMaterial& material : scene.materials) {
    const RegisteredComponent* model = material.model.component;
    names.push_back(model == nullptr ? material.name
                                     : fmt::format("{} ({})", material.name, model->component->name));
  }
  return listed(names);
}

std::string damping_text(const Damping& damping) {
  if (damping.kind == Damping::Kind::adaptive) return "adaptive damping";
  if (damping.kind == Damping::Kind::kinetic) return "kinetic damping";
  return fmt::format("damping {:.6g} 1/s", damping.constant);
}

/// Covers of many elements, and what was done about their slivers.
void print_covers(const Scene& scene, const Simulation& simulation) {
  print_row("cover",
            fmt::format("{} patches, {} elements", simulation.patch_count(), simulation.element_count()));
  for (const SliverEffect& effect : simulation.slivers()) {
    print_row(
        "slivers",
        fmt::format("body '{}': {} patches merged, {} with inertia added; critical step without contacts "
                    "{:.4g} s, untreated {:.4g} s",
                    scene.bodies[effect.body].name, effect.tied, effect.heavier, effect.dt,
                    effect.untreated_dt));
  }
}

void print_time(const Scene& scene, const Simulation& simulation) {
  const double critical = simulation.critical_dt();
  const double dt = scene.time.dt.value_or(simulation.automatic_dt());
  const std::string step =
      std::isfinite(dt) ? fmt::format("step {:.6g} s ({})", dt, scene.time.dt ? "as given" : "automatic")
                        : "steps up to outputs or what speed allows";
  const std::string bound = std::isfinite(critical)
                                ? fmt::format("{:.3g} of critical, {:.6g} s", dt / critical, critical)
                                : "nothing swings, so none is critical";
  print_row("time", fmt::format("to {:.6g} s, {}: {}", scene.time.end, step, bound));
  if (!scene.time.dt && std::isfinite(dt)) print_row("limited by", simulation.automatic_limiter());
  if (scene.settle) {
    print_row("settle",
              fmt::format("{:.6g} s with {}", scene.settle->duration, damping_text(scene.settle->damping)));
  }
}

void print_stages(const Scene& scene, const Preview& foreseen) {
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const Stage& stage = scene.stages[i];
    const CriticalStep& bound = foreseen.stages[i];
    const double dt = scene.time.dt.value_or(automatic_step(bound, scene.time.safety));
    print_row("stage", fmt::format("'{}' from {:.6g} s{}", stage.name, stage.from,
                                   std::isfinite(dt) ? fmt::format(", step {:.6g} s", dt) : ""));
  }
}

void print_scene(Simulation& simulation, const std::vector<std::string>& libraries) {
  const Scene& scene = simulation.scene();
  fmt::print("{}: no mistake\n", scene.file);
  if (!scene.title.empty()) print_row("title", scene.title);
  print_row("bodies", bodies_text(scene));
  print_covers(scene, simulation);
  print_row("materials", materials_text(scene));
  print_row("contact",
            scene.contact.component == nullptr ? "none" : scene.contact.component->component->name);
  print_time(scene, simulation);
  const Preview foreseen = preview(simulation, trial_seconds);
  print_stages(scene, foreseen);
  print_preview(scene, foreseen);
  print_row("monitors", listed(monitor_columns(scene)));
  for (const UsedLibrary& used : used_libraries(scene)) {
    print_row("plugin", fmt::format("{} from {}", listed(used.components), used.file.string()));
  }
  print_row("libraries", libraries.empty() ? "it names none by path"
                                           : fmt::format("it names {}: loaded, as --allow-plugins says",
                                                         listed(libraries)));
  for (const std::string& warning : foreseen.warnings) print_row("warning", warning);
}

}  // namespace

Usage usage_of_validate() {
  Usage usage{"validate", "SCENE [options]",
              "Says all mistakes of a scene with file, line and column; or, if there is none, what a run of "
              "it would be:\n"
              "bodies, contacts, step, time and memory by a trial of a quarter of a second, size of the "
              "results, and what\n"
              "a reviewer would ask about.",
              "SCENE",
              "  talus validate scenes/incline.json\n"
              "  talus validate scenes/incline.json --set /contact/model=vertex_edge\n"};
  add_scene_options(usage);
  return usage;
}

int validate_command(const Words& words) {
  const Usage usage = usage_of_validate();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  Registry registry = offered_registry(usage, *given);
  const SceneFile source = scene_file_of(*given);
  const bool allow_plugins = given->count("allow-plugins") != 0;
  const std::vector<std::string> libraries = named_libraries(source.text);
  if (!libraries.empty() && !allow_plugins) {
    fmt::print(
        "{} names libraries by path: {}\nThey run with your rights; they load only with --allow-plugins.\n",
        source.file.string(), listed(libraries));
  }
  Simulation simulation(read_scene_of(source, registry, overrides_of(usage, *given), allow_plugins), {});
  print_scene(simulation, libraries);
  return exit_code::ok;
}

}  // namespace talus
