#include "commands.hpp"
#include "exit_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace talus {

namespace {

std::string long_name(const boost::program_options::option_description& option) {
  return "--" + option.long_name();
}

/// The value names of options and the names of arguments tell what they are completed by.
std::string completed_by(std::string_view value) {
  const bool words = std::all_of(value.begin(), value.end(), [](char letter) {
    return letter == '|' || (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9');
  });
  if (words) {
    std::string parted(value);
    std::replace(parted.begin(), parted.end(), '|', ' ');
    return fmt::format("words \"{}\"", parted);
  }
  if (value == "DIR") return "folders";
  if (value.starts_with("FILE")) return "files";
  return "nothing";
}

std::string arguments_of(const Usage& usage) {
  if (usage.synopsis.starts_with("SCENE")) return "scenes";
  if (usage.synopsis.starts_with("FOLDER")) return "files";
  if (usage.argument.find("COMMAND") != std::string::npos) return "words \"$commands\"";
  const std::string first = usage.synopsis.substr(0, usage.synopsis.find(' '));
  return completed_by(first);
}

std::string value_name(const boost::program_options::option_description& option) {
  return option.semantic()->max_tokens() == 0 ? std::string() : option.semantic()->name();
}

std::string case_of(const Usage& usage) {
  std::string names = "--help", values;
  for (const auto& option : usage.options.options()) {
    names += ' ' + long_name(*option);
    std::string value = value_name(*option);
    if (value.empty()) continue;
    std::string forms = long_name(*option);
    if (option->canonical_display_name(boost::program_options::command_line_style::allow_dash_for_short) !=
        option->long_name())
      forms += '|' + option->canonical_display_name(
                         boost::program_options::command_line_style::allow_dash_for_short);
    values += fmt::format("        {}) {}; return ;;\n", forms, completed_by(value));
  }
  std::string text = fmt::format("    {})\n", usage.command);
  if (!values.empty()) text += fmt::format("      case $previous in\n{}      esac\n", values);
  return text +
         fmt::format("      options=\"{}\"\n      arguments() {{ {}; }} ;;\n", names, arguments_of(usage));
}

std::string bash_script() {
  std::string names, cases;
  for (const Command& command : commands()) {
    const Usage usage = command.usage();
    names += (names.empty() ? "" : " ") + usage.command;
    cases += case_of(usage);
  }
  return fmt::format(R"(# Completion of talus {} for bash, as `talus completion bash` writes it.
_talus() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} options
  local commands="{}"
  # bash parts --out=DIR at the sign.
  if [[ $current == = ]]; then current=
  elif [[ $previous == = ]]; then previous=${{COMP_WORDS[COMP_CWORD - 2]}}; fi
  words() {{ mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current"); }}
  files() {{ compopt -o filenames 2> /dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$current"); }}
  folders() {{ compopt -o filenames 2> /dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$current"); }}
  scenes() {{
    compopt -o filenames 2> /dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X '!*.json' -- "$current")
  }}
  nothing() {{ COMPREPLY=(); }}
  if ((COMP_CWORD == 1)); then words "$commands --help --version"; return; fi
  case ${{COMP_WORDS[1]}} in
{}    *) nothing; return ;;
  esac
  if [[ $current == -* ]]; then words "$options"; else arguments; fi
}}
complete -F _talus talus
)",
                     TALUS_VERSION, names, cases);
}

}  // namespace

Usage usage_of_completion() {
  return {
      "completion", "bash",
      "Writes what completes commands, options and files in bash. It is installed with the program; without\n"
      "that, `source <(talus completion bash)` brings it into a shell.",
      "SHELL", "  source <(talus completion bash)\n"};
}

int completion_command(const Words& words) {
  const Usage usage = usage_of_completion();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::string shell = text_option(*given, "SHELL");
  if (shell != "bash")
    throw UsageError(usage.command, fmt::format("SHELL {}: there is one for bash alone", shell));
  fmt::print("{}", bash_script());
  return exit_code::ok;
}

}  // namespace talus
