#include "commands.hpp"
#include "exit_code.hpp"
#include "scene/tables.hpp"
#include "scene_options.hpp"
#include "study/study_text.hpp"
#include "study_options.hpp"
#include "terminal.hpp"
#include "text/plain_number.hpp"
#include "text/shell_word.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {

namespace {

namespace po = boost::program_options;

double share_of(const Usage& usage, const std::string& text) {
  if (text.empty()) throw UsageError(usage.command, "--error 1% is missing");
  const bool percent = text.ends_with('%');
  const double share =
      plain_number(text.substr(0, text.size() - (percent ? 1 : 0))).value_or(0) / (percent ? 100 : 1);
  if (!(share > 0) || share > 1)
    throw UsageError(usage.command,
                     fmt::format("--error {}: give a share above 0, at most 1: 1% or 0.01", text));
  return share;
}

/// The time step as the scene states it, or the safety factor of the automatic one, by factors of two.
StudyPlan steps_of(const Usage& usage, const po::variables_map& given, const SceneFile& source) {
  Registry registry = offered_registry(usage, given);
  const Scene scene =
      read_scene_of(source, registry, overrides_of(usage, given), given.count("allow-plugins") != 0);
  const double most = scene.contact.component == nullptr ? table::of(table::time, "safety").maximum
                                                         : table::safety_with_contact;
  Variation variation{scene.time.dt ? "/time/dt" : "/time/safety", {}};
  for (const double factor : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    const double value = factor * scene.time.dt.value_or(scene.time.safety);
    if (scene.time.dt || value <= most) variation.values.push_back(fmt::format("{:.6g}", value));
  }
  return grid({variation});
}

/// To the last digit of what was measured; one may be cheaper than another by the noise of clocks alone.
bool are_one_run(const Study& study) {
  return study.findings.reference_is_one_of_many &&
         std::ranges::all_of(study.runs, [](const StudyRun& run) { return run.end == "finished"; }) &&
         std::ranges::all_of(study.findings.runs,
                             [](const StudyFinding& found) { return found.error.value_or(0) == 0; });
}

}  // namespace

Usage usage_of_advise() {
  Usage usage{"advise", "SCENE --error 1% [options]",
              "Proposes the cheapest settings of a study whose error stays below a bound, as a line of "
              "--set. The study is\n"
              "that of --vary (see `talus study --help`); without it the time step is varied by its safety "
              "factor. Errors\n"
              "against the run with the most work say how far a run is from what the scene converges to, not "
              "from nature.",
              "SCENE",
              "  talus advise scenes/collision.json --error 1%\n"
              "  talus advise scenes/incline.json --error 0.1% --vary /time/safety=0.4,0.2,0.1 --reference "
              "scenes/reference/incline_overlap_area.csv\n"};
  usage.options.add_options()("error", po::value<std::string>()->value_name("SHARE"),
                              "RMS error over the largest value: 1% or 0.01");
  add_study_options(usage);
  return usage;
}

int advise_command(const Words& words) {
  const Usage usage = usage_of_advise();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const double error = share_of(usage, text_option(*given, "error"));
  const SceneFile source = scene_file_of(*given);
  if (given->count("vary") == 0 && given->count("sample") + given->count("seed") != 0)
    throw UsageError(usage.command, "--sample and --seed are of what --vary names, which is missing");
  const StudyPlan plan = given->count("vary") != 0 ? plan_of(usage, *given) : steps_of(usage, *given, source);
  const Study study = make_study(usage, *given, words, plan, source);
  if (study.interrupted) {
    tell(fmt::format("interrupted; the same words go on with the study in {}\n", study.folder.string()));
    return exit_code::interrupted;
  }
  fmt::print("{}\n", study_table(plan, study.runs, study.findings));
  if (study.findings.reference_is_one_of_many)
    print_warning(fmt::format("errors are measured from {}", words_of_reference(plan, study.findings)));
  if (are_one_run(study)) {
    fmt::print(
        "nothing to choose: all runs are the same, for what is varied changes nothing in this scene{}\n",
        given->count("vary") == 0 ? "; its step is not held by /time/safety, so --vary something else" : "");
    return exit_code::ok;
  }
  const auto best = cheapest_within(study.findings, study.runs, error);
  if (!best) {
    fmt::print("no run keeps {:.3g} %: vary more, or take finer values\n", 100 * error);
    return exit_code::tolerance_broken;
  }
  fmt::print("for {:.3g} % take", 100 * error);
  for (const Override& change : plan.overrides(plan.points[*best]))
    fmt::print(" --set {}", shell_word(change.pointer + "=" + change.value));
  fmt::print("\nerror {:.3g} %", 100 * study.findings.runs[*best].error.value_or(0));
  if (study.findings.error_of_reference)
    fmt::print(" and about {:.2g} % of what it is measured against",
               100 * *study.findings.error_of_reference);
  fmt::print(", {:.3g} s of CPU", study.runs[*best].cpu);
  if (study.findings.reference == *best) {
    fmt::print(": it is the run that the others are measured against");
  } else if (study.findings.reference) {
    const double of_reference = study.runs[*best].cpu / study.runs[*study.findings.reference].cpu;
    fmt::print(", {:.3g} times {} the run it is measured against",
               of_reference < 1 ? 1 / of_reference : of_reference,
               of_reference < 1 ? "less than" : "that of");
  }
  fmt::print("\n");
  return exit_code::ok;
}

}  // namespace talus
