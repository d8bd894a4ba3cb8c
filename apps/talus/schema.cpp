#include "schema/json_schema.hpp"

#include "commands.hpp"
#include "exit_code.hpp"
#include "files/whole_file.hpp"
#include "scene_options.hpp"
#include "schema/reference.hpp"

#include <fmt/format.h>

namespace talus {

namespace {

namespace po = boost::program_options;

}  // namespace

Usage usage_of_schema() {
  Usage usage{
      "schema", "[options]",
      "Writes a JSON Schema of scenes to the standard output, with the parameters of every library found.\n"
      "Editors complete and check a scene with it that says \"$schema\": \"talus.schema.json\".",
      "",
      "  talus schema > talus.schema.json\n"
      "  talus schema --plugin-path ./my-laws > talus.schema.json\n"
      "  talus schema --reference docs/scenes.md\n"};
  usage.options.add_options()("reference", po::value<std::string>()->value_name("FILE.md"),
                              "write no schema, but the tables between the markers of a Markdown file anew");
  add_plugin_path(usage);
  return usage;
}

int schema_command(const Words& words) {
  const Usage usage = usage_of_schema();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const Registry registry = load_registry(usage, *given);
  if (const std::string file = text_option(*given, "reference"); !file.empty()) {
    write_whole_file(file, with_reference(read_whole_file(file), registry));
  } else {
    fmt::print("{}\n", scene_schema(registry).dump(1));
  }
  return exit_code::ok;
}

}  // namespace talus
