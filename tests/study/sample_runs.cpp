#include "study/sample_runs.hpp"

#include <cstdlib>
#include <utility>

namespace talus {

StudyRun run_of(double error, double cpu, double work, const std::string& end) {
  StudyRun run;
  run.folder = "run";
  run.done = true;
  run.end = end;
  run.trouble = end == "finished" ? "" : "it <blew> up";
  run.cpu = cpu;
  run.cpu_of_each = {cpu};
  run.work = work;
  run.dt = 1e-3;
  run.residual = error / 10;
  run.penetration = error / 100;
  run.history.time = {0, 1, 2};
  run.history.names = {sample_column};
  run.history.values = {{2 + error, 2 + error, 2 + error}};
  return run;
}

const StudyPlan& sample_steps() {
  static const StudyPlan plan = grid({{"/time/dt", {"4e-3", "2e-3", "1e-3", "8e-3", "5e-4"}}});
  return plan;
}

std::vector<StudyRun> stepped(std::vector<StudyRun> runs) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    runs[i].dt = std::strtod(sample_steps().points[i].values[0].c_str(), nullptr);
  return runs;
}

}  // namespace talus
