#include "report/report.hpp"

#include "arguments.hpp"
#include "commands.hpp"
#include "exit_code.hpp"

#include <fmt/format.h>

namespace talus {

Usage usage_of_report() {
  return {"report", "FOLDER",
          "Writes report.html into a folder of results, as run and compare do at their end: the bodies in "
          "motion,\n"
          "curves, energies, deviations and provenance on one page that needs no network.",
          "FOLDER", "  talus report out/incline\n"};
}

int report_command(const Words& words) {
  const Usage usage = usage_of_report();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const std::filesystem::path folder = text_option(*given, "FOLDER");
  write_report(folder);
  fmt::print("{}\n", (folder / "report.html").string());
  return exit_code::ok;
}

}  // namespace talus
