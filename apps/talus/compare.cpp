#include "compare/comparison.hpp"

#include "commands.hpp"
#include "compare/report.hpp"
#include "exit_code.hpp"
#include "files/folder_lock.hpp"
#include "files/hash.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "interrupt.hpp"
#include "output/history.hpp"
#include "output/output_folder.hpp"
#include "output/records.hpp"
#include "progress.hpp"
#include "report/report.hpp"
#include "scene/read.hpp"
#include "scene_options.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <deque>
#include <set>

namespace talus {

namespace {

namespace po = boost::program_options;

/// Values that only letters tell apart which no folder is named with would share one.
void refuse_shared_folders(const Variation& variation) {
  std::set<std::string> folders;
  for (const std::string& value : variation.values) {
    if (!folders.insert(folder_of_value(value)).second)
      throw InputError(fmt::format("--vary {}: the run of '{}' and one before would both go to a folder '{}'",
                                   variation.pointer, value, folder_of_value(value)));
  }
}

/// What the options alone say of it.
ComparisonOrder order_of(const Usage& usage, const po::variables_map& given) {
  ComparisonOrder order;
  order.variation = parse_variation(text_option(given, "vary"));
  refuse_shared_folders(order.variation);
  order.overrides = overrides_of(usage, given);
  order.threads = threads_of(usage, given, cores());
  order.neighbour_skin = given.count("no-skin") == 0;
  if (given.count("at") != 0) order.moments = given["at"].as<std::vector<double>>();
  return order;
}

/// One scene per value. Each has a registry of its own, since a scene may bring libraries along.
void read_scenes(const Usage& usage, const po::variables_map& given, const SceneFile& source,
                 std::deque<Registry>& registries, ComparisonOrder& order, const Log& log) {
  std::set<std::string> told;
  for (const std::string& value : order.variation.values) {
    std::vector<Override> overrides = order.overrides;
    overrides.push_back({order.variation.pointer, value});
    Registry& registry = registries.emplace_back(offered_registry(usage, given));
    try {
      order.scenes.push_back(
          read_scene_of(source, registry, overrides, given.count("allow-plugins") != 0, log));
    } catch (const SceneError&) {
      // The mistakes may lie beside the key that varies, in what is right with the scene's own value.
      log.error(fmt::format("with {} = {}:", order.variation.pointer, value));
      throw;
    }
    for (const std::string& warning : order.scenes.back().warnings) {
      if (told.insert(warning).second) log.warning(warning);
    }
  }
}

/// Folders of an earlier comparison that this one does not write anew, as its table tells them.
std::vector<std::filesystem::path> runs_left_over(const ComparisonOrder& order) {
  std::vector<std::filesystem::path> left_over;
  const auto before = comparison_record_in(order.folder);
  if (!before) return left_over;
  std::set<std::string> kept;
  for (const std::string& value : order.variation.values) kept.insert(folder_of_value(value));
  for (const auto& run : before->at("runs")) {
    const std::string name = std::filesystem::path(run.at("folder").get<std::string>()).filename().string();
    // No more than a folder of ours: a record may be damaged, and ".." leads elsewhere.
    if (!kept.contains(name) && folder_of_value(name) == name) left_over.push_back(order.folder / name);
  }
  return left_over;
}

/// Of an order that has its scenes. Returns the files that no output may replace.
std::vector<std::filesystem::path> read_reference(const po::variables_map& given, ComparisonOrder& order) {
  std::vector<std::filesystem::path> read;
  for (const Scene& scene : order.scenes) {
    for (std::filesystem::path& name : scene.files_read()) read.push_back(std::move(name));
  }
  const std::string named = text_option(given, "reference");
  if (named.empty()) return read;
  const std::filesystem::path reference = here_or_shipped(named);
  read.push_back(reference);
  const std::string text = read_whole_file(reference);
  order.reference =
      ReferenceFile{reference.string(), hash_of_bytes(text),
                    read_reference_text(text, reference.string(), monitor_columns(order.scenes[0])), text};
  return read;
}

/// Its own and one for each run, all or none; those of runs left over from an earlier comparison go.
FolderLock prepare_folders(const ComparisonOrder& order, bool overwrite,
                           const std::vector<std::filesystem::path>& read) {
  const std::vector<std::filesystem::path> left_over = runs_left_over(order);
  std::vector<std::filesystem::path> of_runs;
  for (const std::string& value : order.variation.values)
    of_runs.push_back(order.folder / folder_of_value(value));
  refuse_output_folder(order.folder, overwrite, read);
  for (const std::filesystem::path& run : left_over) FolderLock::refuse_busy(run);
  for (const std::filesystem::path& folder : of_runs) refuse_output_folder(folder, overwrite, read);
  prepare_output_folder(order.folder, overwrite, read);
  FolderLock lock(order.folder);
  // Whatever ends this program, the next one knows which runs are of it, or left over.
  const auto begin = [&](const std::vector<std::filesystem::path>& others) {
    write_whole_file(order.folder / "compare.json", begun_comparison_json(order, others));
  };
  begin(left_over);
  for (const std::filesystem::path& folder : of_runs) prepare_output_folder(folder, overwrite, read);
  for (const std::filesystem::path& run : left_over) remove_run(run, read);
  begin({});
  return lock;
}

void write_results(const ComparisonOrder& order, const Comparison& comparison, bool report) {
  if (order.reference) write_whole_file(order.folder / reference_copy, order.reference->text);
  write_whole_file(order.folder / "compare.csv", comparison_csv(comparison));
  write_whole_file(order.folder / "compare.json", comparison_json(order, comparison));
  if (report) write_report(order.folder);
}

int code_of(const Comparison& comparison) {
  const auto any = [&](RunEnd end) {
    return std::any_of(comparison.runs.begin(), comparison.runs.end(),
                       [end](const ComparedRun& run) { return run.result.end == end; });
  };
  if (any(RunEnd::interrupted)) return exit_code::interrupted;
  if (any(RunEnd::stopped)) return exit_code::numerical_trouble;
  return comparison.tolerances_held() ? exit_code::ok : exit_code::tolerance_broken;
}

void tell_troubles(const Comparison& comparison, const std::filesystem::path& folder, const Log& log) {
  for (const std::string& warning : comparison.warnings) log.warning(warning);
  for (const ComparedRun& run : comparison.runs) {
    for (const std::string& warning : run.result.summary.warnings) log.warning(run.value + ": " + warning);
    if (run.result.end == RunEnd::stopped) log.error(run.value + ": " + run.result.trouble);
    if (run.result.end == RunEnd::interrupted) {
      log.info("interrupted", fmt::format("{}: interrupted at {}; results so far are in {}", run.value,
                                          time_in_words(run.result, run.result.time), folder.string()));
    }
  }
}

}  // namespace

Usage usage_of_compare() {
  Usage usage{
      "compare", "SCENE --vary /pointer=a,b[,c] [options]",
      "Runs a scene once per value of --vary, side by side, from the same settled geometry and at the same "
      "time\n"
      "step (unless /time is what varies), and measures how the monitors part: from the first value, the "
      "baseline,\n"
      "and from a reference. Runs are compared at the times of which both have a row; a reference is taken "
      "for\n"
      "a line between its rows. Writes compare.csv (all runs at the times of the first), compare.json and\n"
      "a folder for each run to a folder:\n"
      "out/<scene name>-compare unless --out says otherwise.",
      "SCENE",
      "  talus compare scenes/incline.json --vary /contact/model=overlap_area,vertex_edge --at 2.95\n"
      "  talus compare scenes/collision.json --vary /time/dt=1e-4,5e-5,2.5e-5 --out out/order\n"
      "  talus compare scenes/incline.json --vary /contact/model=overlap_area --reference curve.csv\n"};
  usage.options.add_options()("vary", po::value<std::string>()->value_name("/pointer=a,b"),
                              "what varies; the first value is the baseline")(
      "reference", po::value<std::string>()->value_name("FILE.csv"),
      "curves to compare with as well: 't [s]' and columns named as in history.csv")(
      "at", po::value<std::vector<double>>()->value_name("T"),
      "tell the deviations at this time too, s; may be given several times")(
      "out,o", po::value<std::string>()->value_name("DIR"),
      "folder for the results (default: out/<scene name>-compare)")(
      "overwrite", "replace results that the folder holds already, those of other values, too")(
      "threads", po::value<std::string>()->value_name("N"),
      "runs at a time, one thread each (default: one per core)");
  add_scene_options(usage);
  add_log_options(usage);
  usage.options.add_options()("no-report", "write no report.html")("quiet,q", "no progress")(
      "no-skin", "seek contact candidates anew at every step: slow, for checking; motion keeps its bits");
  return usage;
}

int compare_command(const Words& words) {
  const Usage usage = usage_of_compare();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  if (given->count("vary") == 0) throw UsageError(usage.command, "--vary /pointer=a,b is missing");
  const Log log = log_of(usage, *given);

  ComparisonOrder order = order_of(usage, *given);
  const SceneFile source = scene_file_of(*given);
  order.folder = output_folder(*given, source, "-compare");
  order.scene_hash = hash_of_bytes(source.text);
  std::deque<Registry> registries;
  read_scenes(usage, *given, source, registries, order, log);
  const std::vector<std::filesystem::path> read = read_reference(*given, order);
  Comparison comparison = planned(order);
  const FolderLock mine = prepare_folders(order, given->count("overwrite") != 0, read);

  order.interrupted = watch_for_interrupts();
  log.info("started", "",
           {{"scene", source.file.string()},
            {"folder", order.folder.string()},
            {"vary", text_option(*given, "vary")},
            {"threads", order.threads},
            {"version", TALUS_VERSION}});
  Progress progress(log, given->count("quiet") != 0);
  order.progress = [&](double share) { progress.show(share, fmt::format("{} runs", order.scenes.size())); };
  compare(order, comparison);
  progress.clear();

  write_results(order, comparison, given->count("no-report") == 0);
  tell_troubles(comparison, order.folder, log);
  if (log.in_json())
    log.info("compared", "", {{"folder", order.folder.string()}, {"exit_code", code_of(comparison)}});
  fmt::print("{}\nresults in {}\n", comparison_table(order, comparison), order.folder.string());
  return code_of(comparison);
}

}  // namespace talus
