#include "arguments.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "files/input_error.hpp"
#include "help.hpp"
#include "log.hpp"
#include "scene/read.hpp"
#include "scene_options.hpp"
#include "simulation/simulation.hpp"
#include "terminal.hpp"
#include "text/thrown.hpp"

#include <fmt/format.h>

#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <system_error>

namespace talus {

namespace {

int dispatch(const Words& words) {
  if (words.empty()) {
    fmt::print("{}", help_text());
    return exit_code::bad_input;
  }
  if (words[0] == "--help" || words[0] == "-h") {
    fmt::print("{}", help_text());
    return exit_code::ok;
  }
  if (words[0] == "--version") {
    fmt::print("talus " TALUS_VERSION "\n");
    return exit_code::ok;
  }
  std::vector<std::string> names{"--help", "--version"};
  for (const Command& command : commands()) {
    const std::string name = command.usage().command;
    if (words[0] == name) return command.run(Words(words.begin() + 1, words.end()));
    names.push_back(name);
  }
  throw UsageError("", fmt::format("unknown {} '{}'{}", words[0].starts_with('-') ? "option" : "command",
                                   words[0], guess(words[0], names)));
}

int report(const UsageError& problem, const Log& log) {
  const bool program = problem.command.empty();
  log.error(program ? problem.what() : fmt::format("talus {}: {}", problem.command, problem.what()));
  if (log.in_json()) return exit_code::bad_input;
  tell(fmt::format("{}\n", program ? std::string("`talus --help` lists the commands.")
                                   : fmt::format("`talus {} --help` lists what it takes.", problem.command)));
  return exit_code::bad_input;
}

int report(const SceneError& problem, int code, const Log& log) {
  for (const std::string& words : problem.warnings) log.warning(words);
  for (const Mistake& mistake : problem.mistakes) {
    log.error(log.in_json() ? mistake.message : mistake.text(), {{"file", mistake.file},
                                                                 {"line", mistake.line},
                                                                 {"column", mistake.column},
                                                                 {"pointer", mistake.pointer}});
  }
  if (log.in_json()) return code;
  const std::size_t listed = problem.mistakes.size() - (problem.more > 0 ? 1 : 0);
  tell(fmt::format("{} mistake{} in the scene{}\n", listed + problem.more,
                   listed + problem.more == 1 ? "" : "s",
                   problem.more > 0 ? fmt::format(", the first {} of them shown", listed) : ""));
  return code;
}

int report(const std::exception& problem, int code, const Log& log) {
  log.error(problem.what());
  return code;
}

/// Files that are opened get the lowest numbers, and must not get those of the standard streams. What is
/// written to one that was closed fails as before.
void open_standard_streams() {
  for (int stream = 0; stream <= 2; ++stream) {
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) == -1) return;
  }
}

/// What is thrown out of a function that promises not to throw ends the program at once. Libraries are asked
/// through such functions alone, so it is theirs as a rule.
[[noreturn]] void abort_in_words() {
  tell(fmt::format(
      "error: '{}' was thrown where nothing may be: most likely by a contact law, a material or a cover, "
      "whose functions are noexcept; `talus check-plugin` tells which; what was written so far stays\n",
      words_of_thrown()));
  std::abort();
}

int guarded(const Words& words) {
  open_standard_streams();
  const Log log = log_of_words(words);
  try {
    const int code = dispatch(words);
    if (std::fflush(stdout) != 0) {
      log.error("the standard output could not be written");
      return exit_code::file_trouble;
    }
    return code;
  } catch (const UsageError& problem) {
    return report(problem, log);
  } catch (const LibrariesNotAllowed& problem) {
    return report(problem, exit_code::plugin_refused, log);
  } catch (const SceneError& problem) {
    return report(problem, exit_code::bad_input, log);
  } catch (const InputError& problem) {
    return report(problem, exit_code::bad_input, log);
  } catch (const PluginError& problem) {
    return report(problem, exit_code::plugin_refused, log);
  } catch (const NumericalTrouble& problem) {
    return report(problem, exit_code::numerical_trouble, log);
  } catch (const std::system_error& problem) {
    return report(problem, exit_code::file_trouble, log);
  } catch (const std::bad_alloc&) {
    return report(std::runtime_error("there is not enough memory for this"), exit_code::internal_error, log);
  } catch (const std::exception& problem) {
    return report(problem, exit_code::internal_error, log);
  }
}

}  // namespace

}  // namespace talus

int main(int count, char** words) {
  std::set_terminate(talus::abort_in_words);
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of the shell is then an error in words
  return talus::guarded(talus::Words(words + 1, words + count));
}
