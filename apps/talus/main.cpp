#include "arguments.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "model/laid_cover.hpp"
#include "output/input_error.hpp"
#include "scene/read.hpp"
#include "scene_options.hpp"
#include "simulation/simulation.hpp"
#include "terminal.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <system_error>

namespace talus {

namespace {

struct Command {
  const char* name;
  const char* synopsis;
  const char* sentence;
  int (*run)(const Words& words);
};

constexpr Command commands[] = {
    {"run", "SCENE [options]", "run a scene, write history, frames and a record of the run", run_command},
    {"compare", "SCENE --vary /pointer=a,b [options]",
     "run a scene once per value, side by side, and measure how the results part", compare_command},
    {"validate", "SCENE [options]", "say all mistakes of a scene, or what it is", validate_command},
    {"blocks", "SCENE [-o FILE] [options]", "write a scene with its generated blocks as plain bodies",
     blocks_command},
    {"plugins", "[options]", "list the libraries found, what they bring, and which were refused and why",
     plugins_command},
    {"describe", "NAME [options]", "explain a component or a section of a scene with all its parameters",
     describe_command},
};

void print_help() {
  fmt::print("talus " TALUS_VERSION
             ": the explicit numerical manifold method in 2D, contact laws as plugins\n\n"
             "Usage: talus COMMAND [arguments]\n\nCommands:\n");
  for (const Command& command : commands) {
    fmt::print("  {:<9} {}\n            {}\n", command.name, command.synopsis, command.sentence);
  }
  fmt::print(
      "\n`talus COMMAND --help` lists the options of a command; --version prints the version.\n"
      "Results go to out/<scene name> unless --out says otherwise; nothing is overwritten without "
      "--overwrite.\n"
      "\nExamples:\n"
      "  talus run scenes/collision.json\n"
      "  talus run scenes/incline.json --set /contact/model=vertex_edge --out out/two-corners\n"
      "  talus compare scenes/incline.json --vary /contact/model=overlap_area,vertex_edge --at 2.95\n"
      "  talus describe overlap_area\n"
      "\nExit codes:\n"
      "  0    all is well\n"
      "  1    an error within the program\n"
      "  2    bad input: the scene or the command line\n"
      "  3    a plugin was refused, or a scene names libraries and --allow-plugins is missing\n"
      "  4    numerical trouble stopped a run\n"
      "  5    a file could not be read or written\n"
      "  6    a tolerance that the scene states was broken\n"
      "  130  interrupted; what was done so far is written\n"
      "\nEnvironment: TALUS_PLUGIN_PATH (folders of plugins, separated by colons), NO_COLOR\n");
}

int dispatch(const Words& words) {
  if (words.empty()) {
    print_help();
    return exit_code::bad_input;
  }
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    print_help();
    return exit_code::ok;
  }
  if (words[0] == "--version") {
    fmt::print("talus " TALUS_VERSION "\n");
    return exit_code::ok;
  }
  std::vector<std::string> names{"--help", "--version"};
  for (const Command& command : commands) {
    if (words[0] == command.name) return command.run(Words(words.begin() + 1, words.end()));
    names.emplace_back(command.name);
  }
  throw UsageError("", fmt::format("unknown {} '{}'{}", words[0].starts_with('-') ? "option" : "command",
                                   words[0], guess(words[0], names)));
}

int report(const UsageError& problem) {
  if (problem.command.empty()) {
    print_error(problem.what());
    fmt::print(stderr, "`talus --help` lists the commands.\n");
  } else {
    print_error(fmt::format("talus {}: {}", problem.command, problem.what()));
    fmt::print(stderr, "`talus {} --help` lists what it takes.\n", problem.command);
  }
  return exit_code::bad_input;
}

int report(const SceneError& problem, int code) {
  for (const Mistake& mistake : problem.mistakes) print_error(mistake.text());
  fmt::print(stderr, "{} mistake{} in the scene\n", problem.mistakes.size(),
             problem.mistakes.size() == 1 ? "" : "s");
  return code;
}

int report(const std::exception& problem, int code) {
  print_error(problem.what());
  return code;
}

int guarded(const Words& words) {
  try {
    const int code = dispatch(words);
    if (std::fflush(stdout) != 0) {
      print_error("the standard output could not be written");
      return exit_code::file_trouble;
    }
    return code;
  } catch (const UsageError& problem) {
    return report(problem);
  } catch (const LibrariesNotAllowed& problem) {
    return report(problem, exit_code::plugin_refused);
  } catch (const SceneError& problem) {
    return report(problem, exit_code::bad_input);
  } catch (const InputError& problem) {
    return report(problem, exit_code::bad_input);
  } catch (const BodyRefused& problem) {
    return report(problem, exit_code::bad_input);
  } catch (const PluginError& problem) {
    return report(problem, exit_code::plugin_refused);
  } catch (const NumericalTrouble& problem) {
    return report(problem, exit_code::numerical_trouble);
  } catch (const std::system_error& problem) {
    return report(problem, exit_code::file_trouble);
  } catch (const std::exception& problem) {
    return report(problem, exit_code::internal_error);
  }
}

}  // namespace

}  // namespace talus

int main(int count, char** words) {
  return talus::guarded(talus::Words(words + 1, words + count));
}
