#include "commands.hpp"
#include "help.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace talus {

namespace {

constexpr const char* last_change = "2026-11-22";
constexpr std::size_t longest_line = 64;

/// Lines of prose that no checker of manuals finds long; they are filled anew when shown.
std::string broken(std::string_view text) {
  std::string lines;
  std::size_t length = 0;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    const bool fits = length + 1 + word.size() <= longest_line;
    if (!lines.empty()) lines += fits ? ' ' : '\n';
    length = (fits ? length + 1 : 0) + word.size();
    lines += word;
  }
  return lines;
}

/// The letter of more than one byte that begins at `at`, by its number in Unicode; `at` is left at its end.
std::string unicode(std::string_view text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  unsigned code = first & (0x3Fu >> more);
  for (std::size_t i = 0; i < more && at + 1 < text.size(); ++i)
    code = code << 6 | (static_cast<unsigned char>(text[++at]) & 0x3Fu);
  return fmt::format("\\[u{:04X}]", code);
}

/// Text as roff takes it: no letter of it is a request, an escape or a hyphen to be broken at.
std::string roff(std::string_view text) {
  std::string escaped;
  bool line_begins = true;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char letter = text[at];
    if (line_begins && (letter == '.' || letter == '\'')) escaped += "\\&";
    line_begins = letter == '\n';
    switch (letter) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      default:
        escaped += static_cast<unsigned char>(letter) < 0x80 ? std::string(1, letter) : unicode(text, at);
    }
  }
  return escaped;
}

std::string prose(std::string_view text) {
  return roff(broken(text)) + '\n';
}

std::string verbatim(std::string_view text) {
  return ".nf\n" + roff(text) + ".fi\n";
}

std::string explained(std::span<const Explained> all) {
  std::string text;
  for (const Explained& one : all) text += fmt::format(".TP\n.B {}\n{}", roff(one.name), prose(one.meaning));
  return text;
}

std::string options_of(const Usage& usage) {
  std::string text;
  for (const auto& option : usage.options.options()) {
    const std::string argument = option->format_parameter();
    text +=
        fmt::format(".TP\n\\fB{}\\fR{}\n{}", roff(option->format_name()),
                    argument.empty() ? "" : " \\fI" + roff(argument) + "\\fR", prose(option->description()));
  }
  return text;
}

std::string section_of(const Command& command) {
  const Usage usage = command.usage();
  std::string text = fmt::format(".SS {0}\n.B talus {0}\n{1}\n.PP\n{2}", roff(usage.command),
                                 roff(usage.synopsis), prose(usage.sentence));
  text += options_of(usage);
  if (!usage.examples.empty()) text += ".PP\nExamples:\n" + verbatim(usage.examples);
  return text;
}

}  // namespace

std::string manual_page() {
  std::string text =
      fmt::format(".TH TALUS 1 {} \"talus " TALUS_VERSION "\" \"User Commands\"\n.SH NAME\n", last_change);
  text +=
      "talus \\- the explicit numerical manifold method in 2D, contact laws as plugins\n"
      ".SH SYNOPSIS\n.B talus\n.I command\n[arguments]\n.SH DESCRIPTION\n";
  text += prose(
      "talus follows deformable and rigid bodies in two dimensions through contact, sliding and impact. A "
      "scene\n"
      "is a JSON file, checked as a whole before anything runs. Results go to out/<scene name> unless --out "
      "says\n"
      "otherwise; nothing is overwritten without --overwrite.");
  text += ".SH COMMANDS\nEach command takes\n.B \\-\\-help\nas well.\n";
  for (const Command& command : commands()) text += section_of(command);
  text += ".SH EXIT STATUS\n" + explained(exit_codes());
  text += ".SH ENVIRONMENT\n" + explained(environment());
  std::string lines;
  for (const char* call : examples()) lines += std::string(call) + '\n';
  return text + ".SH EXAMPLES\n" + verbatim(lines);
}

}  // namespace talus
