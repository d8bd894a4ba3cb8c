#include "compare/report.hpp"
#include "output/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {

namespace {

std::string number_text(double value) {
  return fmt::format("{:.6g}", value);
}

std::string ratio_text(const std::optional<double>& ratio) {
  return ratio ? fmt::format("{:.2f}", *ratio) : "-";
}

/// Columns as wide as their widest cell: the first one to the left, numbers to the right.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += i == 0 ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string runs_table(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows{{"run", "steps", "dt [s]", "own dt [s]", "CPU [s]", "cost",
                                              "cost at own dt", "residual", "settled apart [m]", "end"}};
  for (const ComparedRun& run : comparison.runs) {
    const CostRatio ratio = cost_ratio(run, comparison.runs[0]);
    rows.push_back({run.value, fmt::format("{}", run.result.summary.steps),
                    number_text(run.result.summary.dt), number_text(run.own_dt),
                    fmt::format("{:.3f}", run.result.stepping.cpu), ratio_text(ratio.at_equal_dt),
                    ratio_text(ratio.at_own_dt),
                    fmt::format("{:.2g} %", 100 * run.result.summary.largest_residual_share),
                    run.settled_difference ? fmt::format("{:.2g}", *run.settled_difference) : "-",
                    name_of(run.result.end)});
  }
  return aligned(rows);
}

std::string deviations_table(const ComparisonOrder& order, const Comparison& comparison,
                             bool from_reference) {
  std::vector<std::vector<std::string>> rows{{"", "largest", "at t [s]", "RMS", "final"}};
  for (const double moment : order.moments) rows[0].push_back(fmt::format("at {} s", moment));
  // Every run of one column together, so that the eye compares what belongs together.
  std::vector<const ColumnDeviation*> entries;
  for (const ColumnDeviation& entry : comparison.deviations) {
    if (entry.from_reference == from_reference) entries.push_back(&entry);
  }
  if (entries.empty()) return "";
  std::vector<std::string> columns;
  for (const ColumnDeviation* entry : entries) {
    if (std::find(columns.begin(), columns.end(), entry->column) == columns.end())
      columns.push_back(entry->column);
  }
  for (const std::string& column : columns) {
    rows.push_back({column});
    for (const ColumnDeviation* entry : entries) {
      if (entry->column != column) continue;
      const Deviation& found = entry->deviation;
      std::vector<std::string> row{fmt::format("  {}", comparison.runs[entry->run].value),
                                   number_text(found.largest), number_text(found.largest_time),
                                   number_text(found.rms), number_text(found.final)};
      for (const std::optional<double>& value : entry->at_moments) {
        row.push_back(value ? number_text(*value) : "-");
      }
      rows.push_back(row);
    }
  }
  const std::string from =
      from_reference ? "the reference " + order.reference->file : order.variation.values[0] + " (baseline)";
  return fmt::format("\nDeviation from {}\n{}", from, aligned(rows));
}

std::string tolerances_table(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows{{"tolerance", "measure", "found", "allowed", ""}};
  for (const ComparedTolerance& each : comparison.tolerances) {
    for (const ToleranceCheck& found : each.checks) {
      rows.push_back({fmt::format("{}.{} of {} against the {}", each.tolerance.monitor,
                                  each.tolerance.quantity, comparison.runs[each.run].value,
                                  each.tolerance.against_reference ? "reference" : "baseline"),
                      found.measure, number_text(found.found), number_text(found.allowed),
                      found.verdict == ToleranceVerdict::broken ? "BROKEN" : name_of(found.verdict)});
    }
  }
  return rows.size() == 1 ? "" : fmt::format("\n{}", aligned(rows));
}

}  // namespace

std::string comparison_table(const ComparisonOrder& order, const Comparison& comparison) {
  std::string text = fmt::format(
      "{}: {} = {}{}\n\n", order.scenes[0].file, order.variation.pointer,
      fmt::join(order.variation.values, ", "),
      !comparison.common_dt ? "; each at its own time step"
      : order.scenes[0].time.dt
          ? fmt::format("; the step that the scene states, {:.6g} s, for all", *order.scenes[0].time.dt)
      : std::isfinite(*comparison.common_dt)
          ? fmt::format("; largest step for all {:.6g} s", *comparison.common_dt)
          : "; no step is critical");
  text += runs_table(comparison);
  text += deviations_table(order, comparison, false);
  text += deviations_table(order, comparison, true);
  text += tolerances_table(comparison);
  return text;
}

}  // namespace talus
