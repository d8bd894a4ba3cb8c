#include "commands.hpp"
#include "exit_code.hpp"
#include "study/study_text.hpp"
#include "study_options.hpp"
#include "terminal.hpp"

#include <fmt/format.h>

namespace talus {

Usage usage_of_study() {
  Usage usage{
      "study", "SCENE --vary /pointer=a,b [--vary ...] [options]",
      "Runs a scene with every combination of some values, or a sample of them, and measures what each run "
      "costs\n"
      "and how far it is from a reference. Writes study.html, study.csv, study.json, study.svg and a folder "
      "for each\n"
      "run to a folder: out/<scene name>-study unless --out says otherwise. Runs that the folder holds "
      "already are "
      "not made\n"
      "again, so a study that was broken off goes on with the same words; those with other values, other\n"
      "instructions or of another processor are replaced with --overwrite alone, which also removes what\n"
      "else the folder holds of an earlier study.",
      "SCENE",
      "  talus study scenes/incline.json --vary /time/dt=6e-5,3e-5,1.5e-5 --vary "
      "/contact/model=overlap_area,vertex_edge\n"
      "  talus study scenes/collision.json --vary /interfaces/0/normal_stiffness=1e8:1e10 --sample 12 --set "
      "/time/dt=auto\n"};
  add_study_options(usage);
  return usage;
}

int study_command(const Words& words) {
  const Usage usage = usage_of_study();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const StudyPlan plan = plan_of(usage, *given);
  const Study study = make_study(usage, *given, words, plan, scene_file_of(*given));
  if (study.interrupted) {
    tell(fmt::format("interrupted; the same words go on with the study in {}\n", study.folder.string()));
    return exit_code::interrupted;
  }
  fmt::print("{}\nresults in {}\n", study_table(plan, study.runs, study.findings), study.folder.string());
  return exit_code::ok;
}

}  // namespace talus
