#include "commands.hpp"
#include "conformance/check_components.hpp"
#include "exit_code.hpp"
#include "files/whole_file.hpp"
#include "plugin/refusal.hpp"
#include "scene_options.hpp"

#include <fmt/format.h>

namespace talus {

namespace {

using conformance::Check;
using conformance::ComponentReport;
using conformance::Outcome;
using conformance::Verdict;

namespace po = boost::program_options;

double time_limit_of(const Usage& usage, const po::variables_map& given) {
  if (given.count("time-limit") == 0) return 20;
  const auto seconds = given["time-limit"].as<double>();
  if (!(seconds > 0 && seconds <= 86400)) {
    throw UsageError(usage.command, fmt::format("--time-limit {}: allowed are seconds up to 86400", seconds));
  }
  return seconds;
}

void print_outcome(const Check& check, const Outcome& outcome) {
  fmt::print("  {:<11}  {:<11}  {}\n", verdict_in_words(outcome.verdict), outcome.check, check.sentence);
  if (outcome.verdict == Verdict::failed) {
    fmt::print("      fed    {}\n      found  {}\n      due    {}\n", outcome.fed, outcome.found,
               outcome.due);
  } else if (!outcome.found.empty()) {
    fmt::print("      {}\n", outcome.found);
  }
  std::fflush(stdout);
}

/// The components that LIB stands for. A path is loaded apart from what is installed, so that a copy of an
/// installed library is not taken for a clash of names.
std::vector<RegisteredComponent> named_components(const Usage& usage, const std::string& name,
                                                  const Registry& installed, double seconds) {
  std::vector<RegisteredComponent> found;
  std::vector<std::string> names;
  for (const RegisteredComponent& entry : installed.components()) {
    names.emplace_back(entry.component->name);
    if (name == entry.component->name) found.push_back(entry);
  }
  if (!found.empty()) return found;
  if (name.find('/') == std::string::npos && !name.ends_with(".so")) {
    throw UsageError(usage.command,
                     fmt::format("there is no component '{}'{}\n       a library is named by its path, "
                                 "as ./libmine.so",
                                 name, guess(name, names)));
  }
  Registry own;
  own.simd = installed.simd;
  conformance::load_carefully(own, name, seconds);
  found.assign(own.components().begin(), own.components().end());
  return found;
}

}  // namespace

Usage usage_of_check_plugin() {
  Usage usage{
      "check-plugin", "LIB [options]",
      "Holds every component of a library to what is due of a contact law, a material or a cover, through "
      "the\n"
      "plugin interface alone. LIB is the path of a library, or the name of a component that is installed. "
      "Each\n"
      "check runs in a process of its own. Exit code 0: all passed, 1: a check failed, 3: the library was "
      "refused.",
      "LIB",
      "  talus check-plugin build/libmy_law.so --junit my_law.xml\n  talus check-plugin overlap_area\n"};
  usage.options.add_options()("junit", po::value<std::string>()->value_name("FILE"),
                              "write the report as JUnit XML");
  usage.options.add_options()("html", po::value<std::string>()->value_name("FILE"),
                              "write the report as a page");
  usage.options.add_options()("time-limit", po::value<double>()->value_name("SECONDS"),
                              "what a check may take before it counts as hanging (default 20)");
  add_plugin_path(usage);
  return usage;
}

int check_plugin_command(const Words& words) {
  const Usage usage = usage_of_check_plugin();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const double seconds = time_limit_of(usage, *given);
  const Registry installed = load_registry(usage, *given);
  std::vector<ComponentReport> reports;
  std::size_t failed = 0;
  for (const RegisteredComponent& entry :
       named_components(usage, text_option(*given, "LIB"), installed, seconds)) {
    fmt::print("{}{} {} of {}\n", reports.empty() ? "" : "\n", kind_in_words(entry.component->kind),
               entry.component->name, entry.file.filename().string());
    reports.push_back(conformance::check_component(entry, installed, seconds, print_outcome));
    const ComponentReport& report = reports.back();
    failed += report.count(Verdict::failed);
    fmt::print("  {} passed, {} failed, {} not claimed, {} not run\n", report.count(Verdict::passed),
               report.count(Verdict::failed), report.count(Verdict::not_claimed),
               report.count(Verdict::not_run));
  }
  if (const std::string file = text_option(*given, "junit"); !file.empty()) {
    write_whole_file(file, conformance::junit_of(reports));
  }
  if (const std::string file = text_option(*given, "html"); !file.empty()) {
    write_whole_file(file, conformance::html_of(reports));
  }
  return failed == 0 ? exit_code::ok : exit_code::check_failed;
}

}  // namespace talus
