#include "commands.hpp"
#include "exit_code.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "picture/scene_picture.hpp"
#include "report/figures.hpp"
#include "scene_options.hpp"
#include "terminal.hpp"

#include <fmt/format.h>

namespace talus {

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

}  // namespace

Usage usage_of_view() {
  Usage usage{
      "view", "SCENE|FOLDER [-o FILE] [options]",
      "Draws a scene before anything moves: bodies, covers, joints, named surfaces, supports, loads, "
      "monitors.\n"
      "Of a folder of results it draws each curve and the first and the last state, as figures for a paper.\n"
      "All are SVG files: SCENE.svg in the present folder unless -o says otherwise, or FOLDER/figures.",
      "SCENE",
      "  talus view scenes/beams.json -o beams.svg\n"
      "  talus view out/incline\n"};
  usage.options.add_options()("output,o", po::value<std::string>()->value_name("FILE"),
                              "file for the picture of a scene, which is replaced");
  add_scene_options(usage);
  return usage;
}

int view_command(const Words& words) {
  const Usage usage = usage_of_view();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const fs::path what = here_or_shipped(text_option(*given, "SCENE"));
  if (fs::is_directory(what)) {
    if (given->count("output") != 0 || given->count("set") != 0)
      throw UsageError(usage.command, "-o and --set are for scenes; figures of results go to FOLDER/figures");
    for (const fs::path& file : write_figures(what)) fmt::print("{}\n", file.string());
    return exit_code::ok;
  }
  Registry registry = offered_registry(usage, *given);
  Scene scene = read_scene_of({what, read_whole_file(what)}, registry, overrides_of(usage, *given),
                              given->count("allow-plugins") != 0);
  for (const std::string& warning : scene.warnings) print_warning(warning);
  const std::string named = text_option(*given, "output");
  const fs::path out = named.empty() ? fs::path(what.stem()).replace_extension(".svg") : fs::path(named);
  if (named.empty() && fs::exists(out)) {
    throw InputError(
        fmt::format("'{0}' is there already: give -o {0} to replace it, or another file", out.string()));
  }
  refuse_to_replace_what_is_read(scene, out);
  if (fs::is_directory(out)) throw InputError(fmt::format("'{}' is a folder: name a file", out.string()));
  write_whole_file(out, scene_svg(Simulation(std::move(scene), RunSettings{})));
  fmt::print("{}\n", out.string());
  return exit_code::ok;
}

}  // namespace talus
