#pragma once

#include "arguments.hpp"
#include "scene_options.hpp"
#include "study/findings.hpp"

#include <filesystem>
#include <vector>

namespace talus {

/// What `study` and `advise` share.
void add_study_options(Usage& usage);

/// The plan that --vary and --sample ask for.
StudyPlan plan_of(const Usage& usage, const boost::program_options::variables_map& given);

struct Study {
  std::filesystem::path folder;
  std::vector<StudyRun> runs;
  StudyFindings findings;  ///< unless interrupted
  bool interrupted = false;
};

/// Makes the runs of a plan, finds out and writes study.csv, study.json, study.svg and study.html. `words`
/// are those after the command's name.
Study make_study(const Usage& usage, const boost::program_options::variables_map& given,
                 const std::vector<std::string>& words, const StudyPlan& plan, const SceneFile& source);

}  // namespace talus
