#include "arguments.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "kept_run.hpp"

#include <fmt/format.h>

namespace talus {

Usage usage_of_info() {
  return {"info", "FOLDER|CHECKPOINT", "Says what a checkpoint holds, after checking that it is whole.",
          "CHECKPOINT", "  talus info out/incline/checkpoint.talus\n"};
}

int info_command(const Words& words) {
  const Usage usage = usage_of_info();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::filesystem::path file = checkpoint_to_go_on_from(text_option(*given, "CHECKPOINT"));
  const Checkpoint checkpoint = read_checkpoint(file);
  fmt::print("{}: a whole checkpoint of {} bytes\n", file.string(), std::filesystem::file_size(file));
  fmt::print("written because {}\n", checkpoint.reason);
  fmt::print("state at      t = {} s{}, after {} steps\n", checkpoint.time,
             checkpoint.settling ? " of settling" : "", checkpoint.steps);
  for (const double time : checkpoint.continued) fmt::print("continued at  t = {} s\n", time);
  fmt::print("scene         {}\n", checkpoint.scene_file.string());
  for (const Override& change : checkpoint.overrides)
    fmt::print("set           {}={}\n", change.pointer, change.value);
  fmt::print("instructions  {}\nthreads       {}\n", name_of(checkpoint.simd), checkpoint.threads);
  for (const auto& library : checkpoint.libraries)
    fmt::print("library       {}  {}\n", library.hash, library.file);
  return exit_code::ok;
}

}  // namespace talus
