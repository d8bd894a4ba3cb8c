#include "study_options.hpp"

#include "files/folder_lock.hpp"
#include "files/hash.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "interrupt.hpp"
#include "output/history.hpp"
#include "output/output_folder.hpp"
#include "progress.hpp"
#include "scene_options.hpp"
#include "study/rounding.hpp"
#include "study/study_charts.hpp"
#include "study/study_page.hpp"
#include "study/study_text.hpp"
#include "terminal.hpp"
#include "text/shell_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace talus {
namespace {

namespace po = boost::program_options;

std::string name_of_column(const std::string& column) {
  return column.substr(0, column.rfind(" ["));
}

/// The first speed of a body that moves; or of that the first of all; or the first there is.
std::string most_telling(const std::vector<std::string>& columns, const Scene& scene) {
  const auto moves = [&](const std::string& column) {
    return std::any_of(scene.monitors.begin(), scene.monitors.end(), [&](const Monitor& monitor) {
      return !scene.bodies[monitor.body].fixed && column.starts_with(monitor.name + ".");
    });
  };
  const auto is_speed = [&](const std::string& column) {
    return moves(column) && name_of_column(column).ends_with(".speed");
  };
  auto found = std::find_if(columns.begin(), columns.end(), is_speed);
  if (found == columns.end()) found = std::find_if(columns.begin(), columns.end(), moves);
  return found == columns.end() ? columns[0] : *found;
}

/// A column of the scene's monitors: the one that is named, if one is.
std::string column_of(const Usage& usage, const po::variables_map& given, const Scene& scene) {
  const std::vector<std::string> columns = monitor_columns(scene);
  if (columns.empty())
    throw InputError("the scene has no monitors, so there is nothing to measure errors of");
  const std::string wanted = text_option(given, "metric");
  if (wanted.empty()) return most_telling(columns, scene);
  for (const std::string& column : columns) {
    if (column == wanted || name_of_column(column) == wanted) return column;
  }
  throw UsageError(usage.command, fmt::format("--metric {}: the scene's monitors have '{}'", wanted,
                                              fmt::join(columns, "', '")));
}

/// The line that was typed.
std::string command_of(const Usage& usage, const std::vector<std::string>& words) {
  std::string line = "talus " + usage.command;
  for (const std::string& word : words) line += ' ' + shell_word(word);
  return line;
}

void warn_of_no_errors(const StudyPlan& plan, const StudyFindings& findings) {
  std::size_t first = findings.runs.size(), count = 0;
  for (std::size_t i = findings.runs.size(); i-- > 0;) {
    if (findings.runs[i].why_none.empty()) continue;
    first = i;
    ++count;
  }
  if (count == 0) return;
  print_warning(fmt::format("no error of {}{}: {}", plan.words(plan.points[first]),
                            count == 1 ? "" : fmt::format(" and of {} more", count - 1),
                            findings.runs[first].why_none));
}

}  // namespace

void add_study_options(Usage& usage) {
  usage.options.add_options()(
      "vary", po::value<std::vector<std::string>>()->value_name("/pointer=a,b"),
      "what varies; may be given several times; with --sample also a range, low:high")(
      "sample", po::value<int>()->value_name("N"),
      "a Latin hypercube of N runs instead of all combinations; what listed values repeat is made once")(
      "seed", po::value<std::int64_t>()->value_name("S"), "of the sample (default: 1)")(
      "reference", po::value<std::string>()->value_name("FILE.csv"),
      "curve to measure errors from (default: the run that did the most work)")(
      "metric", po::value<std::string>()->value_name("MONITOR.QUANTITY"),
      "what errors are of (default: the first speed of a body that moves)")(
      "out,o", po::value<std::string>()->value_name("DIR"),
      fmt::format("folder for the results (default: out/<scene name>-{})", usage.command).c_str())(
      "overwrite", "replace what the folder holds of other studies: runs with other values, and tables")(
      "repeat", po::value<int>()->value_name("N")->default_value(1),
      "make each run N times, all of them in turn, and take the median of their cost")(
      "threads", po::value<std::string>()->value_name("N"),
      "runs at a time, one thread each (default: one per core)");
  add_scene_options(usage);
  usage.options.add_options()("quiet,q", "no progress");
}

StudyPlan plan_of(const Usage& usage, const po::variables_map& given) {
  std::vector<Variation> variations;
  for (const std::string& text : list_option(given, "vary")) variations.push_back(parse_variation(text));
  if (variations.empty()) throw UsageError(usage.command, "--vary /pointer=a,b is missing");
  for (std::size_t i = 0; i < variations.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::string &one = variations[i].pointer, &other = variations[j].pointer;
      if (one == other)
        throw UsageError(usage.command,
                         fmt::format("--vary {} is given twice: give all values of it at once", one));
      if (one.starts_with(other + "/") || other.starts_with(one + "/"))
        throw UsageError(usage.command,
                         fmt::format("--vary {} and --vary {}: the one is within the other, so that it "
                                     "would say nothing of what varies",
                                     other, one));
    }
  }
  if (given.count("sample") == 0) {
    if (given.count("seed") != 0)
      throw UsageError(usage.command, "--seed is of a --sample, which is missing");
    return grid(variations);
  }
  const std::int64_t seed = given.count("seed") == 0 ? 1 : given["seed"].as<std::int64_t>();
  if (seed < 0) throw UsageError(usage.command, fmt::format("--seed {}: allowed are 0 and more", seed));
  const int count = given["sample"].as<int>();
  if (count < 1) throw UsageError(usage.command, fmt::format("--sample {}: allowed are 1 and more", count));
  return latin_hypercube(variations, static_cast<std::size_t>(count), static_cast<std::uint64_t>(seed));
}

Study make_study(const Usage& usage, const po::variables_map& given, const std::vector<std::string>& words,
                 const StudyPlan& plan, const SceneFile& source) {
  Study study;
  study.folder = output_folder(given, source, "-" + usage.command);
  const bool allow_plugins = given.count("allow-plugins") != 0;

  StudyOrder order;
  order.folder = study.folder;
  order.plan = plan;
  order.overwrite = given.count("overwrite") != 0;
  order.reference = here_or_shipped(text_option(given, "reference"));
  order.overrides = overrides_of(usage, given);
  order.scene_hash = hash_of_bytes(source.text);
  order.threads = threads_of(usage, given, cores());
  order.times = given["repeat"].as<int>();
  if (order.times < 1 || order.times > 1000)
    throw UsageError(usage.command, fmt::format("--repeat {}: allowed are 1 to 1000", order.times));
  order.read = [&](const std::vector<Override>& overrides) {
    HeldScene held{std::make_unique<Registry>(offered_registry(usage, given)), {}};
    held.scene = read_scene_of(source, *held.registry, overrides, allow_plugins);
    return held;
  };
  // A scene that is wrong by itself is told at once, and so is a metric that it has not.
  const HeldScene plain = order.read(order.overrides);
  order.simd = plain.scene.simd;
  for (const std::string& warning : plain.scene.warnings) print_warning(warning);
  const std::string column = column_of(usage, given, plain.scene);
  std::optional<Series> reference;
  if (!order.reference.empty()) {
    reference =
        read_reference_text(read_whole_file(order.reference), order.reference.string(), std::array{column});
    check_reference(*reference, column);
  }
  std::vector<std::filesystem::path> read = plain.scene.files_read();
  read.push_back(order.reference);
  prepare_folder_of_runs(study.folder, read);
  const FolderLock mine(study.folder);

  order.interrupted = watch_for_interrupts();
  Progress progress({}, given.count("quiet") != 0);
  order.progress = [&](std::size_t done, std::size_t all) {
    progress.show(static_cast<double>(done) / static_cast<double>(all),
                  fmt::format("{} of {} runs", done, all));
  };
  study.runs = make_runs(order);
  progress.clear();
  study.interrupted = *order.interrupted;
  if (study.interrupted) return study;
  study.findings = find_out(plan, study.runs, column, reference, rounding_of(plain.scene, column));
  if (!study.findings.part.empty())
    print_warning(fmt::format("the reference goes {} and runs do not: errors are those of the time in common",
                              study.findings.part));
  warn_of_no_errors(plan, study.findings);
  write_whole_file(study.folder / "study.csv", study_csv(plan, study.runs, study.findings));
  write_whole_file(study.folder / "study.json", study_json(plan, study.runs, study.findings));
  write_whole_file(study.folder / "study.svg", study_svg(plan, study.runs, study.findings));
  const std::string& title = plain.scene.title.empty() ? source.file.filename().string() : plain.scene.title;
  write_whole_file(study.folder / "study.html",
                   study_page(title, command_of(usage, words), plan, study.runs, study.findings));
  return study;
}

}  // namespace talus
