#include "commands.hpp"
#include "exit_code.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "scene_options.hpp"
#include "terminal.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace talus {

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

/// Tables, meshes and libraries are sought from the folder of a scene: elsewhere they may be others, or none.
void check_reads_alike(const std::string& plain, const fs::path& out, const fs::path& file,
                       Registry& registry, const std::string& resolved, bool allow_plugins) {
  try {
    if (read_scene_text(plain, out.string(), registry, {{}, allow_plugins}).resolved == resolved) return;
  } catch (const SceneError&) {
  }
  throw InputError(fmt::format(
      "'{}' names files by paths that lead elsewhere from there: write the result to the folder of '{}'",
      out.string(), file.string()));
}

}  // namespace

Usage usage_of_blocks() {
  Usage usage{
      "blocks", "SCENE [-o FILE] [options]",
      "Writes the scene with every generator in \"blocks\" replaced by plain polygons in \"bodies\".\n"
      "The result reads and runs as the scene itself does.",
      "SCENE",
      "  talus blocks scenes/vaiont.json -o scenes/vaiont_plain.json\n"
      "  talus blocks scenes/vaiont.json --set /blocks/0/split/seed=2 | less\n"};
  usage.options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                              "file for the result, which is replaced (default: the standard output)");
  add_scene_options(usage);
  return usage;
}

int blocks_command(const Words& words) {
  const Usage usage = usage_of_blocks();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  Registry registry = offered_registry(usage, *given);
  const SceneFile source = scene_file_of(*given);
  const fs::path& file = source.file;
  const bool allow_plugins = given->count("allow-plugins") != 0;
  const std::string out = text_option(*given, "output");
  const std::vector<Override> overrides = overrides_of(usage, *given);
  const Scene scene = read_scene_of(source, registry, overrides, allow_plugins);
  refuse_to_replace_what_is_read(scene, out);
  for (const std::string& warning : scene.warnings) print_warning(warning);
  const std::string plain =
      plain_scene_text(source.text, file.string(), registry, {overrides, allow_plugins});
  if (out.empty()) {
    fmt::print("{}", plain);
    return exit_code::ok;
  }
  if (fs::is_directory(out)) throw InputError(fmt::format("'{}' is a folder: name a file", out));
  check_reads_alike(plain, out, file, registry, scene.resolved, allow_plugins);
  write_whole_file(out, plain);
  return exit_code::ok;
}

}  // namespace talus
