#include "terminal.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace talus {

namespace {

bool coloured() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return stderr_is_terminal() && !dumb && (no_color == nullptr || *no_color == '\0');
}

void print(std::string_view label, std::string_view colour, std::string_view words) {
  if (coloured()) {
    tell(fmt::format("\033[{}m{}:\033[0m {}\n", colour, label, words));
  } else {
    tell(fmt::format("{}: {}\n", label, words));
  }
}

}  // namespace

void tell(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

bool stderr_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

void print_error(std::string_view words) {
  print("error", "1;31", words);
}

void print_warning(std::string_view words) {
  print("warning", "1;33", words);
}

}  // namespace talus
