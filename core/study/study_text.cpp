#include "study/study_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_orders = 8;  ///< between neighbours, that say more than the slope of all
constexpr std::size_t most_warnings = 8;

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string share_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.3g} %", 100 * *share) : "-";
}

/// Each once, with the first run that raised it.
std::string warnings_text(const StudyPlan& plan, const std::vector<StudyRun>& runs) {
  std::vector<std::string> told;
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const std::string& warning : runs[i].warnings) {
      if (std::ranges::find(told, warning) != told.end()) continue;
      told.push_back(warning);
      if (told.size() <= most_warnings)
        text += fmt::format("warning: {}: {}\n", plan.words(plan.points[i]), warning);
    }
  }
  if (told.size() > most_warnings)
    text += fmt::format("{} warnings more in study.json\n", told.size() - most_warnings);
  return text;
}

}  // namespace

std::string study_csv(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                      const StudyFindings& findings) {
  std::vector<std::string> fields{"run"};
  fields.insert(fields.end(), plan.pointers.begin(), plan.pointers.end());
  for (const char* name : {"end", "error [-]", "rms", "largest", "cpu [s]", "work [element steps]", "dt [s]",
                           "residual [-]", "penetration [m]", "on front"})
    fields.emplace_back(name);
  std::string text = csv_line(fields) + "\n";
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "";
  };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const StudyRun& run = runs[i];
    const StudyFinding& found = findings.runs[i];
    fields = {run.folder.filename().string()};
    fields.insert(fields.end(), plan.points[i].values.begin(), plan.points[i].values.end());
    for (const std::string& field : {run.end, number(found.error), number(found.rms), number(found.largest),
                                     number(run.cpu), number(run.work), number(run.dt), number(run.residual),
                                     number(run.penetration), std::string(found.on_front ? "1" : "0")})
      fields.push_back(field);
    text += csv_line(fields) + "\n";
  }
  return text;
}

std::string study_json(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                       const StudyFindings& findings) {
  Json json{{"talus", TALUS_VERSION}, {"column", findings.column}};
  json["reference"] =
      findings.reference ? Json(runs[*findings.reference].folder.filename().string()) : Json("file");
  json["reference_is_one_of_many"] = findings.reference_is_one_of_many;
  json["error"] = "RMS of the column over the largest magnitude of the reference";
  json["varied"] = plan.pointers;
  json["runs"] = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const StudyRun& run = runs[i];
    const StudyFinding& found = findings.runs[i];
    Json entry{
        {"folder", run.folder.filename().string()}, {"values", plan.points[i].values}, {"end", run.end}};
    if (!run.trouble.empty()) entry["trouble"] = run.trouble;
    if (!run.warnings.empty()) entry["warnings"] = run.warnings;
    entry["error [-]"] = optional_json(found.error);
    entry["rms"] = optional_json(found.rms);
    entry["largest"] = optional_json(found.largest);
    entry["cpu [s]"] = run.cpu;
    if (run.cpu_of_each.size() > 1) entry["cpu of each [s]"] = run.cpu_of_each;
    entry["work [element steps]"] = run.work;
    entry["dt [s]"] = run.dt;
    entry["residual [-]"] = run.residual;
    entry["penetration [m]"] = run.penetration;
    entry["on_front"] = found.on_front;
    json["runs"].push_back(entry);
  }
  json["orders"] = Json::array();
  for (const ObservedOrder& order : findings.orders) {
    Json entry{{"varied", plan.pointers[order.variation]},
               {"runs", Json::array()},
               {"orders", order.orders},
               {"fit", order.fit}};
    for (const std::size_t run : order.runs) entry["runs"].push_back(runs[run].folder.filename().string());
    json["orders"].push_back(entry);
  }
  json["error_of_reference [-]"] = optional_json(findings.error_of_reference);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string study_table(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                        const StudyFindings& findings) {
  std::size_t width = 4;
  for (const StudyPoint& point : plan.points) width = std::max(width, plan.words(point).size());
  std::string text =
      fmt::format("error of {} against {}\n", findings.column, words_of_reference(plan, findings));
  text += fmt::format("  {:<{}}{:>11}{:>11}{:>12}{:>12}{:>14}\n", "", width, "error", "CPU [s]", "dt [s]",
                      "residual", "overlap [m]");
  for (const std::size_t i : by_cost(runs)) {
    if (!finished(runs[i])) continue;
    const std::string error = findings.reference == i ? "reference" : share_text(findings.runs[i].error);
    text += fmt::format("{} {:<{}}{:>11}{:>11.3g}{:>12.4g}{:>12}{:>14.3g}\n",
                        findings.runs[i].on_front ? "*" : " ", plan.words(plan.points[i]), width, error,
                        runs[i].cpu, runs[i].dt, share_text(runs[i].residual), runs[i].penetration);
  }
  text += "* none is both cheaper and nearer\n";
  for (const ObservedOrder& order : findings.orders) {
    text += fmt::format("order in {} ({}):", plan.pointers[order.variation],
                        plan.words(plan.points[order.runs.back()]));
    if (order.orders.size() <= most_orders) {
      for (const double each : order.orders) text += fmt::format(" {:.2f}", each);
      text += "; all:";
    }
    text += fmt::format(" {:.2f}\n", order.fit);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!finished(runs[i]))
      text += fmt::format("failed: {}: {}\n", plan.words(plan.points[i]),
                          runs[i].done ? runs[i].trouble : "not run to its end");
  }
  return text + warnings_text(plan, runs);
}

}  // namespace talus
