#include "help.hpp"

#include "commands.hpp"
#include "exit_code.hpp"

#include <fmt/format.h>

#include <array>

namespace talus {

namespace {

constexpr std::array codes{
    Explained{"0", "all is well"},
    Explained{"1", "an error within the program; a check of check-plugin failed, verify missed a figure"},
    Explained{"2", "bad input: the scene or the command line"},
    Explained{
        "3",
        "a library that was named was refused, its stiffness is no number, or a scene names libraries and "
        "--allow-plugins is missing"},
    Explained{"4", "numerical trouble stopped a run"},
    Explained{"5", "a file could not be read or written"},
    Explained{"6",
              "a tolerance that the scene states was broken, or had nothing to be held against; advise: no "
              "run kept "
              "the error"},
    Explained{"130",
              "interrupted or out of wall time; what was done so far is written: `talus resume` goes on with "
              "a run, "
              "the same words with study and advise, and compare and safety begin anew"},
};

constexpr std::array variables{
    Explained{"TALUS_PLUGIN_PATH", "folders of plugins, separated by colons"},
    Explained{"NO_COLOR", "no colours in the terminal where it is set and not empty"},
};

constexpr std::array calls{
    "talus run scenes/collision.json",
    "talus run scenes/incline.json --set /contact/model=vertex_edge --out out/two-corners",
    "talus compare scenes/incline.json --vary /contact/model=overlap_area,vertex_edge --at 2.95",
    "talus describe overlap_area",
};

}  // namespace

std::span<const Explained> exit_codes() {
  return codes;
}

std::span<const Explained> environment() {
  return variables;
}

std::span<const char* const> examples() {
  return calls;
}

std::string help_text() {
  std::string text = "talus " TALUS_VERSION
                     ": the explicit numerical manifold method in 2D, contact laws as plugins\n\n"
                     "Usage: talus COMMAND [arguments]\n\nCommands:\n";
  for (const Command& command : commands()) {
    const Usage usage = command.usage();
    text += fmt::format("  {:<12} {}\n               {}\n", usage.command, usage.synopsis, command.summary);
  }
  text +=
      "\n`talus COMMAND --help` lists the options of a command; --version prints the version.\n"
      "Results go to out/<scene name> unless --out says otherwise; nothing is overwritten without "
      "--overwrite.\n"
      "\nExamples:\n";
  for (const char* call : examples()) text += fmt::format("  {}\n", call);
  text += "\nExit codes:\n";
  for (const Explained& code : exit_codes()) text += fmt::format("  {:<4} {}\n", code.name, code.meaning);
  text += "\nEnvironment:\n";
  for (const Explained& variable : environment())
    text += fmt::format("  {:<18} {}\n", variable.name, variable.meaning);
  return text;
}

Usage usage_of_help() {
  Usage usage{
      "help", "[COMMAND] [options]",
      "Prints what `talus --help` or `talus COMMAND --help` prints, or the manual page of the program.",
      "[COMMAND]", "  talus help compare\n  talus help --man > talus.1 && man -l talus.1\n"};
  usage.options.add_options()("man", "write the manual page, as roff");
  return usage;
}

int help_command(const Words& words) {
  const Usage usage = usage_of_help();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::string wanted = text_option(*given, "COMMAND");
  if (given->count("man") != 0) {
    if (!wanted.empty())
      throw UsageError(usage.command, "the manual page holds all commands: give --man alone");
    fmt::print("{}", manual_page());
    return exit_code::ok;
  }
  if (wanted.empty()) {
    fmt::print("{}", help_text());
    return exit_code::ok;
  }
  std::vector<std::string> names;
  for (const Command& command : commands()) {
    names.push_back(command.usage().command);
    if (wanted == names.back()) return command.run({"--help"});
  }
  throw UsageError(usage.command, fmt::format("there is no command '{}'{}", wanted, guess(wanted, names)));
}

}  // namespace talus
