#include "verification/verify.hpp"

#include "commands.hpp"
#include "exit_code.hpp"
#include "files/whole_file.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "scene_options.hpp"
#include "verification/report.hpp"

#include <fmt/format.h>

namespace talus {

namespace {

namespace po = boost::program_options;

/// --scenes, or those installed with the program, or those here.
std::filesystem::path scenes_of(const Usage& usage, const po::variables_map& given) {
  const std::string named = text_option(given, "scenes");
  if (!named.empty()) {
    if (!std::filesystem::is_directory(named))
      throw UsageError(usage.command, fmt::format("--scenes {}: there is no such folder", named));
    return named;
  }
  const std::filesystem::path installed = installation_prefix() / "share" / "talus" / "scenes";
  for (const std::filesystem::path& folder : {installed, std::filesystem::path("scenes")}) {
    if (std::filesystem::exists(folder / "collision.json")) return folder;
  }
  throw UsageError(
      usage.command,
      fmt::format("the shipped scenes are neither in {} nor in ./scenes: say where with --scenes",
                  installed.string()));
}

}  // namespace

Usage usage_of_verify() {
  Usage usage{
      "verify", "[PATTERN ...] [options]",
      "Runs reference cases and holds what comes out against what is known beforehand: formulas, equalities "
      "to the bit,\n"
      "bounds, published figures. A pattern is a group, a case, or group/case, in which * stands for any "
      "letters;\n"
      "without one all cases run, some minutes of them. Exit code 0: all held, 1: something was missed.",
      "[PATTERN...]",
      "  talus verify incline impact\n  talus verify 'extremes/*' --json extremes.json\n  talus verify "
      "--list\n"};
  usage.options.add_options()("list", "print the cases with what they predict, and run nothing");
  usage.options.add_options()("json", po::value<std::string>()->value_name("FILE"),
                              "write all rows to a file");
  usage.options.add_options()("markdown", "print tables in Markdown");
  usage.options.add_options()("into", po::value<std::string>()->value_name("FILE.md"),
                              "write the tables between the markers of a Markdown file anew");
  usage.options.add_options()("scenes", po::value<std::string>()->value_name("DIR"),
                              "folder of the scenes (default: those installed, or ./scenes)");
  usage.options.add_options()("threads", po::value<std::string>()->value_name("N"),
                              "cases at a time (default: one per core; same figures for any number)");
  add_plugin_path(usage);
  usage.options.add_options()("quiet,q", "no progress");
  return usage;
}

int verify_command(const Words& words) {
  using namespace verification;
  const Usage usage = usage_of_verify();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  VerifyOrder order;
  order.cases = chosen_cases(list_option(*given, "PATTERN"));
  if (given->count("list") != 0) {
    fmt::print("{}", list_of(order.cases));
    return exit_code::ok;
  }
  const std::string document = text_option(*given, "into");
  const std::string before = document.empty() ? std::string() : read_whole_file(document);
  order.threads = threads_of(usage, *given, cores());
  order.interrupted = watch_for_interrupts();
  const bool in_markdown = given->count("markdown") != 0;
  Progress progress({}, given->count("quiet") != 0);
  order.progress = [&](std::size_t done) {
    const std::size_t all = order.cases.size();
    progress.show(static_cast<double>(done) / static_cast<double>(all),
                  fmt::format("{} of {} cases", done, all));
  };
  order.finished = [&](const CaseResult& result) {
    progress.clear();
    fmt::print(in_markdown ? stderr : stdout, "{}", text_of(result));
    std::fflush(stdout);
  };
  Registry registry = load_registry(usage, *given);
  const Bench bench(registry, scenes_of(usage, *given));
  const std::vector<CaseResult> results = verify(bench, order);
  progress.clear();

  if (in_markdown) fmt::print("{}", markdown_of(results));
  if (const std::string file = text_option(*given, "json"); !file.empty())
    write_whole_file(file, json_of(results));
  if (!document.empty()) write_whole_file(document, with_tables(before, results));
  fmt::print(in_markdown ? stderr : stdout, "{}\n", summary_of(results));
  if (*order.interrupted) return exit_code::interrupted;
  const bool held =
      std::all_of(results.begin(), results.end(), [](const CaseResult& each) { return each.held(); });
  return held ? exit_code::ok : exit_code::check_failed;
}

}  // namespace talus
