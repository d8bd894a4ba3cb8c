#include "commands.hpp"
#include "exit_code.hpp"
#include "kept_run.hpp"
#include "running.hpp"
#include "scene_options.hpp"

namespace talus {

namespace {

namespace po = boost::program_options;

}  // namespace

Usage usage_of_resume() {
  Usage usage{
      "resume", "FOLDER|CHECKPOINT [options]",
      "Goes on with a run that was broken off, from the checkpoint in its folder, as if it had never been:\n"
      "the results are the same to the last bit. What was written after the checkpoint is written anew.",
      "CHECKPOINT", "  talus resume out/incline\n"};
  usage.options.add_options()("threads", po::value<std::string>()->value_name("N"),
                              "threads to use (default: as before; same bits for any number)")(
      "plugin-path", po::value<std::vector<std::string>>()->value_name("DIR"),
      "look for plugins here before the folders that the run was started with");
  add_allow_plugins(usage);
  add_running_options(usage);
  return usage;
}

int resume_command(const Words& words) {
  const Usage usage = usage_of_resume();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const Log log = log_of(usage, *given);
  const std::filesystem::path file = checkpoint_to_go_on_from(text_option(*given, "CHECKPOINT"));
  const Checkpoint checkpoint = read_checkpoint(file);

  RunOrder order;
  order.folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  order.overrides = checkpoint.overrides;
  order.scene_hash = checkpoint.scene_hash;
  order.settings.threads = threads_of(usage, *given, checkpoint.threads);
  order.settings.neighbour_skin = checkpoint.neighbour_skin;
  order.from = &checkpoint;
  order.checkpoints = CheckpointOrder{checkpoint, {}, {}};
  order.checkpoints->run.state.clear();
  order.checkpoints->run.continued.push_back(checkpoint.settling ? 0 : checkpoint.time);
  order.checkpoints->run.allow_plugins = given->count("allow-plugins") != 0;
  read_running_options(usage, *given, order);
  KeptRun kept(checkpoint, order.settings, plugin_folders_of(usage, *given),
               given->count("allow-plugins") != 0, log);
  return conduct(kept.simulation, order, *given, log);
}

}  // namespace talus
