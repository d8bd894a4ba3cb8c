#include "compare/report.hpp"
#include "output/run_record.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace talus {

namespace {

using Json = nlohmann::ordered_json;

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json run_json(const ComparedRun& run, const ComparedRun& baseline) {
  const RunResult& result = run.result;
  const CostRatio ratio = cost_ratio(run, baseline);
  Json json;
  json["value"] = run.value;
  json["folder"] = folder_of_value(run.value);
  json["end"] = name_of(result.end);
  if (result.end == RunEnd::stopped) json["trouble"] = result.trouble;
  json["t [s]"] = result.never_settled ? 0 : result.time;
  json["steps"] = result.summary.steps;
  json["dt [s]"] = result.summary.dt;
  json["dt_limiter"] = result.summary.dt_limiter;
  json["own_dt [s]"] = run.own_dt;
  json["own_steps"] = optional_json(ratio.own_steps);
  json["cpu [s]"] = result.stepping.cpu;
  json["settling cpu [s]"] = result.settling.cpu;
  json["cost_at_equal_dt"] = optional_json(ratio.at_equal_dt);
  json["cost_at_own_dt"] = optional_json(ratio.at_own_dt);
  json["largest_penetration [m]"] = result.summary.largest_penetration;
  json["largest_residual_share"] = result.summary.largest_residual_share;
  json["ledger_residual [J/m]"] = result.ledger.residual;
  json["settled_difference [m]"] = optional_json(run.settled_difference);
  json["state_hash"] = result.state_hash;
  return json;
}

Json deviation_json(const ColumnDeviation& entry, const std::vector<double>& moments) {
  Json json{{"largest", entry.deviation.largest},
            {"largest_at [s]", entry.deviation.largest_time},
            {"rms", entry.deviation.rms},
            {"final", entry.deviation.final},
            {"final_at [s]", entry.deviation.final_time},
            {"times", entry.deviation.times}};
  for (std::size_t i = 0; i < moments.size(); ++i) {
    json["at"][fmt::format("{}", moments[i])] = optional_json(entry.at_moments[i]);
  }
  return json;
}

Json tolerances_json(const Comparison& comparison) {
  Json list = Json::array();
  for (const ComparedTolerance& each : comparison.tolerances) {
    for (const ToleranceCheck& found : each.checks) {
      list.push_back({{"column", fmt::format("{}.{}", each.tolerance.monitor, each.tolerance.quantity)},
                      {"run", comparison.runs[each.run].value},
                      {"against", each.tolerance.against_reference ? "reference" : "baseline"},
                      {"measure", found.measure},
                      {"allowed", found.allowed},
                      {"found", found.found},
                      {"verdict", name_of(found.verdict)}});
    }
  }
  return list;
}

/// What is known before a run is made.
Json head_json(const ComparisonOrder& order) {
  return {
      {"talus", TALUS_VERSION},
      {"scene",
       {{"file", order.scenes[0].file}, {"title", order.scenes[0].title}, {"xxh3_128", order.scene_hash}}},
      {"varied", order.variation.pointer},
      {"baseline", order.variation.values[0]}};
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

CostRatio cost_ratio(const ComparedRun& run, const ComparedRun& baseline) {
  CostRatio ratio;
  const auto per_step = [](const ComparedRun& each) {
    return each.result.stepping.cpu / static_cast<double>(each.result.summary.steps);
  };
  ratio.own_steps = run.own_steps;
  if (run.result.summary.steps == 0 || baseline.result.summary.steps == 0) return ratio;
  ratio.at_equal_dt = per_step(run) / per_step(baseline);
  if (run.own_steps && baseline.own_steps)
    ratio.at_own_dt = *ratio.at_equal_dt * *run.own_steps / *baseline.own_steps;
  return ratio;
}

std::string comparison_json(const ComparisonOrder& order, const Comparison& comparison) {
  Json json = head_json(order);
  if (!order.moments.empty()) json["moments [s]"] = order.moments;
  json["common_dt [s]"] = optional_json(comparison.common_dt);
  if (order.reference)
    json["reference"] = {
        {"file", order.reference->file}, {"copy", reference_copy}, {"xxh3_128", order.reference->hash}};
  json["meaning"] = {
      {"deviation",
       "run minus baseline, at the times of which both have a row, or run minus reference (linear between "
       "its rows, within its range)"},
      {"cost_at_equal_dt", "CPU seconds per step, over the baseline's; settling and writing not counted"},
      {"cost_at_own_dt",
       "CPU seconds per step times the steps needed at own_dt, over the baseline's: computed, not run"},
      {"common_dt", "the step that the scene states, or the largest for all; null where it varies"},
      {"own_dt",
       "the time step of the run by itself at its start: automatic, whatever the scene states; where "
       "something of /time is varied, the one stated, if one is"},
      {"own_steps",
       "of own_dt at most, each output met; null where speed, contacts or stages bound the step more"},
      {"settled_difference", "largest distance of a vertex from where it is in the baseline, at t = 0"}};
  json["runs"] = Json::array();
  for (const ComparedRun& run : comparison.runs) json["runs"].push_back(run_json(run, comparison.runs[0]));
  json["deviations"] = Json::object();
  for (const ColumnDeviation& entry : comparison.deviations) {
    json["deviations"][entry.column][comparison.runs[entry.run].value]
        [entry.from_reference ? "from_reference" : "from_baseline"] = deviation_json(entry, order.moments);
  }
  json["tolerances"] = tolerances_json(comparison);
  json["tolerances_held"] = comparison.tolerances_held();
  json["warnings"] = comparison.warnings;
  return text_of(json);
}

std::string begun_comparison_json(const ComparisonOrder& order,
                                  const std::vector<std::filesystem::path>& others) {
  Json json = head_json(order);
  json["ended"] = false;
  json["runs"] = Json::array();
  for (const std::string& value : order.variation.values)
    json["runs"].push_back({{"value", value}, {"folder", folder_of_value(value)}});
  for (const std::filesystem::path& other : others)
    json["runs"].push_back({{"value", other.filename().string()}, {"folder", other.filename().string()}});
  return text_of(json);
}

std::string comparison_csv(const Comparison& comparison) {
  std::vector<std::string> fields{"t [s]"};
  for (const ComparedRun& run : comparison.runs) {
    for (const std::string& name : run.result.history.names) fields.push_back(run.value + "/" + name);
  }
  std::string text = csv_line(fields) + "\n";
  for (const double time : comparison.runs[0].result.history.time) {
    text += fmt::format("{}", time);
    for (const ComparedRun& run : comparison.runs) {
      const auto row = row_at(run.result.history.time, time);
      for (const std::vector<double>& values : run.result.history.values)
        text += row ? fmt::format(",{}", values[*row]) : ",";
    }
    text += '\n';
  }
  return text;
}

}  // namespace talus
