#include "commands.hpp"
#include "exit_code.hpp"
#include "files/hash.hpp"
#include "output/output_folder.hpp"
#include "output/run_record.hpp"
#include "running.hpp"
#include "scene_options.hpp"

#include <fmt/format.h>

#include <utility>

namespace talus {

namespace {

namespace po = boost::program_options;

/// Whatever another program needs to make the same simulation.
Checkpoint as_started(const SceneFile& source, const RunOrder& order, const Scene& scene, const Usage& usage,
                      const po::variables_map& given) {
  Checkpoint run;
  run.scene_file = std::filesystem::absolute(source.file);
  run.scene_text = source.text;
  run.scene_hash = order.scene_hash;
  run.files = scene.files;
  run.overrides = order.overrides;
  run.allow_plugins = given.count("allow-plugins") != 0;
  run.plugin_folders = chosen_folders(plugin_folders_of(usage, given));
  run.libraries = hashed_libraries(scene);
  run.simd = scene.simd;
  run.neighbour_skin = order.settings.neighbour_skin;
  run.threads = order.settings.threads;
  return run;
}

}  // namespace

Usage usage_of_run() {
  Usage usage{
      "run", "SCENE [options]",
      "Runs a scene and writes history.csv, energy.csv, frames.pvd with frames/ (if the scene asks for\n"
      "frames), resolved.json, run.json and report.html to a folder: out/<scene name> unless --out says\n"
      "otherwise.",
      "SCENE",
      "  talus run scenes/incline.json --set /time/end=3 --out out/incline-3s\n"
      "  talus run scenes/brick_wall.json --threads 2 --overwrite\n"};
  usage.options.add_options()("out,o", po::value<std::string>()->value_name("DIR"),
                              "folder for the results (default: out/<scene name>)")(
      "overwrite", "replace results that the folder holds already")(
      "threads", po::value<std::string>()->value_name("N"),
      "threads to use (default: 1; same bits for any number)");
  add_scene_options(usage);
  add_running_options(usage);
  usage.options.add_options()(
      "no-skin", "seek contact candidates anew at every step: slow, for checking; motion keeps its bits");
  return usage;
}

int run_command(const Words& words) {
  const Usage usage = usage_of_run();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const Log log = log_of(usage, *given);

  RunOrder order;
  order.overrides = overrides_of(usage, *given);
  order.settings.threads = threads_of(usage, *given, 1);
  order.settings.neighbour_skin = given->count("no-skin") == 0;
  Registry registry = offered_registry(usage, *given);
  const SceneFile source = scene_file_of(*given);
  const std::filesystem::path& file = source.file;
  order.folder = output_folder(*given, source);

  Scene read = read_scene_of(source, registry, order.overrides, given->count("allow-plugins") != 0, log);
  for (const std::string& warning : read.warnings) log.warning(warning);
  order.scene_hash = hash_of_bytes(source.text);
  // A pipe cannot be read twice, so that nobody could go on from a state.
  if (std::filesystem::is_regular_file(file)) {
    order.checkpoints = CheckpointOrder{as_started(source, order, read, usage, *given), {}, {}};
  } else if (given->count("checkpoint-every") + given->count("wall-time") > 0) {
    throw UsageError(usage.command,
                     fmt::format("{} is a pipe, and a run from a pipe leaves no checkpoint: write "
                                 "the scene to a file",
                                 file.string()));
  }
  read_running_options(usage, *given, order);
  const std::vector<std::filesystem::path> files = read.files_read();
  Simulation simulation(std::move(read), order.settings);
  prepare_output_folder(order.folder, given->count("overwrite") != 0, files);

  return conduct(simulation, order, *given, log);
}

}  // namespace talus
