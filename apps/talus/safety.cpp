#include "safety/safety.hpp"

#include "commands.hpp"
#include "exit_code.hpp"
#include "files/folder_lock.hpp"
#include "files/hash.hpp"
#include "files/whole_file.hpp"
#include "interrupt.hpp"
#include "output/output_folder.hpp"
#include "output/series.hpp"
#include "picture/chart.hpp"
#include "preview_rows.hpp"
#include "safety/collapse.hpp"
#include "safety/mechanism.hpp"
#include "safety/strength.hpp"
#include "scene/section.hpp"
#include "scene_options.hpp"
#include "terminal.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace talus {

namespace {

namespace po = boost::program_options;

std::vector<ReducedRun> by_factor(std::vector<ReducedRun> runs) {
  std::sort(runs.begin(), runs.end(),
            [](const ReducedRun& p, const ReducedRun& q) { return p.factor < q.factor; });
  return runs;
}

bool was_stopped(const ReducedRun& run) {
  return !run.trouble.empty();
}

std::vector<std::string> names_of(const Scene& scene, const std::vector<std::size_t>& bodies) {
  std::vector<std::string> names;
  for (const std::size_t body : bodies) names.push_back(scene.bodies[body].name);
  return names;
}

/// A run that was stopped says nothing of how far what moved. Names of bodies hold no slash.
std::string safety_csv(const Scene& scene, const Safety& safety) {
  std::string text =
      "factor,collapsed,displacement [m],body,kinetic [J/m],failing bodies,stopped by,lasted [s],still "
      "moving\n";
  for (const ReducedRun& run : by_factor(safety.runs)) {
    const auto names = [&](const std::vector<std::size_t>& bodies) {
      return fmt::format("{}", fmt::join(names_of(scene, bodies), "/"));
    };
    const bool stopped = was_stopped(run);
    const std::string fields[] = {fmt::format("{}", run.factor),
                                  run.collapsed ? "1" : "0",
                                  stopped ? "" : fmt::format("{}", run.displacement),
                                  stopped ? "" : scene.bodies[run.body].name,
                                  stopped ? "" : fmt::format("{}", run.kinetic),
                                  names(run.moving),
                                  run.trouble,
                                  stopped ? "" : fmt::format("{}", run.lasted),
                                  names(run.moving_little)};
    text += csv_line(fields) + "\n";
  }
  return text;
}

std::string safety_svg(const Safety& safety) {
  Curve curve{"largest displacement of a body", {}, {}, 0, ""};
  for (const ReducedRun& run : by_factor(safety.runs)) {
    if (was_stopped(run)) continue;
    curve.x.push_back(run.factor);
    curve.y.push_back(run.displacement);
  }
  const auto factor = safety.factor();
  const bool found = factor && !safety.interrupted;
  return chart_svg(found ? fmt::format("factor of safety {:.3g}", *factor) : "strength reduction", "factor",
                   "displacement [m]", {curve});
}

void say_try(const Scene& scene, const ReducedRun& run) {
  if (was_stopped(run)) {
    fmt::print("{:>10.5g}  {:<10}{:>18}  {:<20}{:>15}\n", run.factor, "stopped", "-", "-", "-");
  } else {
    fmt::print("{:>10.5g}  {:<10}{:>18.4g}  {:<20}{:>15.4g}\n", run.factor,
               run.collapsed ? "collapses" : "stands", run.displacement, scene.bodies[run.body].name,
               run.kinetic);
  }
  std::fflush(stdout);
}

void say_bounds(const Safety& safety) {
  const auto known = [](const std::optional<double>& factor) {
    return factor ? fmt::format("{:.4g}", *factor) : "no factor yet";
  };
  fmt::print("interrupted: found to stand at {}, to collapse at {}\n", known(safety.stands),
             known(safety.falls));
}

const ReducedRun& run_at(const Safety& safety, double factor) {
  return *std::ranges::find(safety.runs, factor, &ReducedRun::factor);
}

bool has_loads_in_time(const Scene& scene) {
  return varies_in_time(scene.base_acceleration) ||
         std::ranges::any_of(scene.loads, [](const PointLoad& load) { return varies_in_time(load.force); }) ||
         std::ranges::any_of(scene.surface_loads, [](const SurfaceLoad& load) {
           return varies_in_time(load.traction) || load.pressure.varies_in_time();
         });
}

std::vector<std::string> warnings_of_scene(const Scene& scene) {
  std::vector<std::string> warnings;
  if (!scene.stages.empty())
    warnings.emplace_back("the stages of the scene are left out: strength is reduced from the start");
  if (scene.sleep) warnings.emplace_back("the sleep of the scene is left out: what creeps counts");
  if (!scene.settle)
    warnings.emplace_back("the scene has no settle stage: what it does to come to rest counts as motion");
  question_bonds(scene, warnings);
  std::vector<std::string> moving, driven;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    if (body.velocity.x != 0 || body.velocity.y != 0 || body.angular_velocity != 0)
      moving.push_back(body.name);
    if (is_driven(scene, i)) driven.push_back(body.name);
  }
  if (has_loads_in_time(scene))
    warnings.emplace_back(
        "loads or a motion of the ground vary in time: a body that they move on for a while and that comes "
        "to rest has failed once it has come a twentieth of its width; how far it comes is for `talus run`. "
        "Runs that go on past /time/end keep the loads that they have then; a motion of the ground goes on");
  if (!moving.empty())
    warnings.push_back(fmt::format("velocities at the start are left out: {}", listed(moving)));
  if (!driven.empty())
    warnings.push_back(
        fmt::format("motion along axes along which the scene drives a body does not count, that of others "
                    "that it takes with it does: {}",
                    listed(driven)));
  return warnings;
}

/// Of what may flutter once the scene runs undamped.
std::vector<std::string> warnings_of_stiffness(const Simulation& simulation) {
  Preview foreseen;
  compare_stiffness(simulation, foreseen);
  const std::string words = words_of_flutter(simulation.scene(), foreseen);
  if (words.empty()) return {};
  return {words + ", and without it the factor may come out some per cent low"};
}

/// What makes a factor that was found less sure than it looks.
std::vector<std::string> warnings_of_runs(const Scene& scene, const Safety& safety) {
  std::vector<std::string> warnings = safety.warnings;
  if (safety.stands) {
    const ReducedRun& stood = run_at(safety, *safety.stands);
    if (!stood.came_to_rest.empty())
      warnings.push_back(fmt::format(
          "at {:.4g} these stand only after they moved by a hundredth of their width, or of the size of "
          "their elements, or more: where they met something that stops them, what they slide on bears less "
          "than the factor says; where they lean on contacts that give, it bears more, and stiffer ones show "
          "how much: {}",
          stood.factor, listed(names_of(scene, stood.came_to_rest))));
    if (!stood.moving_little.empty())
      warnings.push_back(
          fmt::format("at {:.4g} still moving after {:.4g} s, too slowly to call it a collapse: {}; "
                      "the factor may be less: give it a longer /time/end",
                      stood.factor, stood.lasted, listed(names_of(scene, stood.moving_little))));
  }
  if (!safety.factor()) {
    const auto stopped = std::ranges::count_if(safety.runs, was_stopped);
    if (stopped > 0)
      warnings.push_back(
          fmt::format("{} of {} runs count as collapses because they were stopped: safety.csv "
                      "says by what",
                      stopped, safety.runs.size()));
    return warnings;
  }
  const ReducedRun& fallen = run_at(safety, *safety.falls);
  if (was_stopped(fallen))
    warnings.push_back(fmt::format("the run at {:.4g} counts as a collapse because it was stopped: {}",
                                   fallen.factor, fallen.trouble));
  if (fallen.stands_again)
    warnings.push_back(
        fmt::format("what failed at {:.4g} came {:.3g} m and stands again: the factor is that of a "
                    "twentieth of its width, of the size of its elements where it has many, and no collapse "
                    "that goes on",
                    fallen.factor, fallen.displacement));
  return warnings;
}

/// The answer with all that was said of it, for scripts and for those who find the folder later.
std::string safety_json(const Scene& scene, const SceneFile& source, const std::vector<Override>& overrides,
                        const SafetySettings& settings, const Safety& safety,
                        const std::vector<std::string>& warnings) {
  OrderedJson json;
  json["talus"] = TALUS_VERSION;
  json["scene"] = source.file.string();
  json["scene_hash"] = hash_of_bytes(source.text);
  json["set"] = OrderedJson::array();
  for (const Override& change : overrides)
    json["set"].push_back({{"pointer", change.pointer}, {"value", change.value}});
  json["end"] = safety.interrupted ? "interrupted" : "finished";
  const auto put = [&](const char* key, const std::optional<double>& value) {
    json[key] = value ? OrderedJson(*value) : OrderedJson(nullptr);
  };
  put("factor", safety.interrupted ? std::nullopt : safety.factor());
  put("stands", safety.stands);
  put("collapses", safety.falls);
  json["tolerance"] = settings.tolerance;
  json["failing bodies"] = safety.factor() && !safety.interrupted
                               ? names_of(scene, run_at(safety, *safety.falls).moving)
                               : std::vector<std::string>{};
  json["warnings"] = warnings;
  return json.dump(2) + "\n";
}

void say_result(const Scene& scene, const Safety& safety) {
  if (safety.interrupted) {
    say_bounds(safety);
    return;
  }
  const std::string what = safety.of_what_is_left ? "what was left after settling" : "it";
  if (const auto factor = safety.factor()) {
    fmt::print("factor of safety {:.4g}: {}stands at {:.4g}, collapses at {:.4g}\n", *factor,
               safety.of_what_is_left ? what + " " : "", *safety.stands, *safety.falls);
    const ReducedRun& fallen = run_at(safety, *safety.falls);
    if (!fallen.moving.empty())
      fmt::print("failing at {:.4g}: {}\n", fallen.factor, listed(names_of(scene, fallen.moving)));
  } else if (safety.falls) {
    fmt::print("{} collapses even with {:.3g} times its strength: look whether it can stand at all{}\n", what,
               1 / *safety.falls, scene.settle ? ", and whether it was at rest when it had settled" : "");
  } else if (safety.stands) {
    fmt::print("{} stands even with its strength divided by {:.3g}\n", what, *safety.stands);
  }
}

}  // namespace

Usage usage_of_safety() {
  Usage usage{
      "safety", "SCENE [options]",
      "Factor of safety by strength reduction: tan φ, cohesion and tensile strength of all interfaces, and\n"
      "of materials that have them, are divided by a factor until the scene collapses, by bisection, each\n"
      "time from the same settled geometry (where bonds may form from where bodies are drawn) and for as\n"
      "long as the scene lasts, or up to eight times as long where that does not tell. Writes\n"
      "safety.json (the factor and all warnings), safety.csv (the runs), safety.svg and how it fails,\n"
      "mechanism.svg, to a folder: out/<scene name>-safety unless --out says otherwise. Stages of the scene\n"
      "are left out; pore pressure and bolts are not modelled.",
      "SCENE",
      "  talus safety scenes/stick_31deg.json\n"
      "  talus safety slope.json --tolerance 0.002 --set /time/end=5\n"};
  usage.options.add_options()("tolerance", po::value<double>()->value_name("SHARE"),
                              "how near the factor is to be found (default: 0.01)")(
      "out,o", po::value<std::string>()->value_name("DIR"), "folder for the results")(
      "overwrite", "replace results that the folder holds already")(
      "threads", po::value<std::string>()->value_name("N"),
      "threads to use (default: 1; same bits for any number)");
  add_scene_options(usage);
  return usage;
}

int safety_command(const Words& words) {
  const Usage usage = usage_of_safety();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  SafetySettings settings;
  if (given->count("tolerance") != 0) settings.tolerance = (*given)["tolerance"].as<double>();
  if (!(settings.tolerance >= 1e-6 && settings.tolerance < 1))
    throw UsageError(usage.command,
                     fmt::format("--tolerance {}: allowed are 1e-6 to less than 1", settings.tolerance));
  settings.threads = threads_of(usage, *given, 1);
  Registry registry = offered_registry(usage, *given);
  const SceneFile source = scene_file_of(*given);
  const std::filesystem::path folder = output_folder(*given, source, "-safety");
  const std::vector<Override> overrides = overrides_of(usage, *given);
  const Scene scene = read_scene_of(source, registry, overrides, given->count("allow-plugins") != 0);
  std::vector<std::string> warnings;
  const auto warn = [&](const std::vector<std::string>& more) {
    for (const std::string& warning : more) print_warning(warning);
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  warn(scene.warnings);
  warn(warnings_of_scene(scene));
  const Simulation sound(with_reduced_strength(scene, 1), {});  // or throws, before anything is lost
  warn(warnings_of_stiffness(sound));
  prepare_output_folder(folder, given->count("overwrite") != 0, scene.files_read());
  const FolderLock mine(folder);

  const std::atomic<bool>* asked_to_stop = watch_for_interrupts();
  settings.interrupted = [asked_to_stop] { return asked_to_stop->load(); };
  fmt::print("{:>10}  {:<10}{:>18}  {:<20}{:>15}\n", "factor", "", "displacement [m]", "of", "kinetic [J/m]");
  settings.tried = [&](const ReducedRun& run) { say_try(scene, run); };
  const Safety safety = factor_of_safety(scene, settings);
  if (!safety.trouble.empty()) {
    warn(safety.warnings);
    throw NumericalTrouble(safety.trouble);
  }
  warn(safety.interrupted ? safety.warnings : warnings_of_runs(scene, safety));
  write_whole_file(folder / "safety.csv", safety_csv(scene, safety));
  write_whole_file(folder / "safety.svg", safety_svg(safety));
  write_whole_file(folder / "safety.json", safety_json(scene, source, overrides, settings, safety, warnings));
  if (const std::string mechanism = mechanism_svg(scene, safety); !mechanism.empty())
    write_whole_file(folder / "mechanism.svg", mechanism);
  say_result(scene, safety);
  fmt::print("results in {}\n", folder.string());
  return safety.interrupted ? exit_code::interrupted : exit_code::ok;
}

}  // namespace talus
