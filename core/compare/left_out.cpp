#include "compare/left_out.hpp"

#include "output/history.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {

namespace {

/// A column of the reference that goes by the name of one of the runs, but in another unit.
void warn_of_other_units(const ComparisonOrder& order, Comparison& comparison) {
  const auto without_unit = [](const std::string& column) { return column.substr(0, column.rfind(" [")); };
  const std::vector<std::string> columns = monitor_columns(order.scenes[0]);
  for (const std::string& name : order.reference->series.names) {
    if (std::ranges::count(columns, name) != 0) continue;
    for (const std::string& column : columns) {
      if (without_unit(column) != without_unit(name)) continue;
      comparison.warnings.push_back(
          fmt::format("{}: '{}' was left out, for the runs have '{}'", order.reference->file, name, column));
    }
  }
}

/// Of what is told of a run without being in its rows, or by few of them.
void warn_of_rows(const ComparisonOrder& order, Comparison& comparison) {
  const std::vector<double>& base = comparison.runs[0].result.history.time;
  for (std::size_t run = 1; run < comparison.runs.size(); ++run) {
    const std::vector<double>& own = comparison.runs[run].result.history.time;
    const auto entry = std::ranges::find_if(comparison.deviations, [&](const ColumnDeviation& each) {
      return each.run == run && !each.from_reference;
    });
    if (entry == comparison.deviations.end()) continue;
    const std::string words = fmt::format("'{}' has rows at other times than '{}'",
                                          comparison.runs[run].value, comparison.runs[0].value);
    if (entry->deviation.between_rows) {
      comparison.warnings.push_back(
          words + ": between them one of the two was taken for a line; give both the same /output/history");
    } else if (2 * entry->deviation.times < std::min(own.size(), base.size())) {
      comparison.warnings.push_back(
          fmt::format("{}: they are compared at the {} that both have", words, entry->deviation.times));
    }
    for (const double moment : order.moments) {
      if ((row_at(own, moment) && row_at(base, moment)) || !(moment < std::min(own.back(), base.back())))
        continue;
      comparison.warnings.push_back(
          fmt::format("--at {}: '{}' and '{}' do not both have a row of that time, so what is told is on the "
                      "line between rows beside it",
                      moment, comparison.runs[0].value, comparison.runs[run].value));
    }
  }
}

/// Monitors that the runs do not all have.
void warn_of_columns(const ComparisonOrder& order, Comparison& comparison) {
  const std::vector<std::string> base = monitor_columns(order.scenes[0]);
  const auto without = [](std::vector<std::string> columns, const std::vector<std::string>& others) {
    std::erase_if(columns, [&](const std::string& each) { return std::ranges::count(others, each) != 0; });
    return columns;
  };
  const auto tell = [&](const ComparedRun& has, const ComparedRun& lacks,
                        const std::vector<std::string>& columns) {
    if (columns.empty()) return;
    comparison.warnings.push_back(fmt::format("'{}' has, and '{}' has not, so it is not compared: '{}'",
                                              has.value, lacks.value, fmt::join(columns, "', '")));
  };
  for (std::size_t run = 1; run < comparison.runs.size(); ++run) {
    const std::vector<std::string> own = monitor_columns(order.scenes[run]);
    tell(comparison.runs[0], comparison.runs[run], without(base, own));
    tell(comparison.runs[run], comparison.runs[0], without(own, base));
  }
}

/// Of a step that nobody was to look at there is no row: what stopped a run there shows in no deviation.
void warn_of_ends(Comparison& comparison) {
  for (const ComparedRun& run : comparison.runs) {
    const RunResult& result = run.result;
    const std::vector<double>& time = result.history.time;
    if (result.end != RunEnd::stopped) continue;
    if (!time.empty() && time.back() < result.time - time_tolerance(time))
      comparison.warnings.push_back(
          fmt::format("'{}' was stopped at t = {:.6g} s and is compared up to t = {:.6g} s, its "
                      "last row: what stopped it is in no deviation",
                      run.value, result.time, time.back()));
  }
}

/// Runs of which not one row is compared.
void warn_of_nothing(const ComparisonOrder& order, Comparison& comparison) {
  const auto warn = [&](std::size_t run, bool from_reference, const std::string& other) {
    if (std::ranges::any_of(comparison.deviations, [&](const ColumnDeviation& each) {
          return each.run == run && each.from_reference == from_reference;
        }))
      return;
    comparison.warnings.push_back(
        fmt::format("'{}' has no time in common with {}", comparison.runs[run].value, other));
  };
  for (std::size_t run = 0; run < comparison.runs.size(); ++run) {
    if (run > 0) warn(run, false, fmt::format("'{}'", comparison.runs[0].value));
    if (order.reference) warn(run, true, order.reference->file);
  }
}

}  // namespace

void warn_of_what_is_left_out(const ComparisonOrder& order, Comparison& comparison) {
  if (order.reference) warn_of_other_units(order, comparison);
  warn_of_columns(order, comparison);
  warn_of_nothing(order, comparison);
  warn_of_rows(order, comparison);
  warn_of_ends(comparison);
}

}  // namespace talus
