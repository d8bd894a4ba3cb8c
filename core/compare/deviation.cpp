#include "compare/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace talus {

namespace {

/// How many of some times lie within others.
std::size_t count_within(const std::vector<double>& times, const std::vector<double>& others) {
  if (times.empty() || others.empty()) return 0;
  const auto from = std::lower_bound(times.begin(), times.end(), others.front());
  return static_cast<std::size_t>(std::upper_bound(from, times.end(), others.back()) - from);
}

struct Curve {
  const Series& series;
  std::size_t column;

  const std::vector<double>& time() const { return series.time; }
  double at_row(std::size_t row) const { return series.values[column][row]; }
  std::optional<double> at(double moment) const {
    return interpolate(series.time, series.values[column], moment);
  }
};

/// Where both have a value.
void add_at(double moment, const Curve& one, const Curve& other, Difference& found) {
  const std::optional<double> value = one.at(moment), expected = other.at(moment);
  if (!value || !expected) return;
  found.time.push_back(moment);
  found.value.push_back(*value - *expected);
}

Difference at_common_rows(const Curve& one, const Curve& other) {
  Difference found;
  for (std::size_t row = 0; row < one.time().size(); ++row) {
    const auto same = row_at(other.time(), one.time()[row]);
    if (!same) continue;
    found.time.push_back(one.time()[row]);
    found.value.push_back(one.at_row(row) - other.at_row(*same));
  }
  // What stopped a run shows best in its last row.
  for (const Curve* each : {&one, &other}) {
    if (!each->series.stopped || found.time.empty()) continue;
    const double stop = each->time().back();
    if (!row_at(found.time, stop) && stop > found.time.back()) add_at(stop, one, other, found);
  }
  return found;
}

}  // namespace

Difference difference(const Series& series, std::size_t column, const Series& other, std::size_t other_column,
                      Between between) {
  const Curve one{series, column}, from{other, other_column};
  Difference found;
  if (between == Between::unknown) {
    found = at_common_rows(one, from);
    if (found.time.size() > 1 || series.time.size() < 2 || other.time.size() < 2) return found;
    found = {{}, {}, true};
  }
  const bool from_is_coarser = between == Between::unknown &&
                               count_within(other.time, series.time) < count_within(series.time, other.time);
  for (const double moment : from_is_coarser ? other.time : series.time) add_at(moment, one, from, found);
  return found;
}

std::optional<Deviation> deviation(const Series& series, std::size_t column, const Series& other,
                                   std::size_t other_column, Between between) {
  const Difference apart = difference(series, column, other, other_column, between);
  if (apart.time.empty()) return std::nullopt;
  Deviation found;
  double squares = 0;
  for (std::size_t i = 0; i < apart.time.size(); ++i) {
    const double value = apart.value[i];
    // Written so that a NaN is kept as the largest.
    if (i == 0 || (!std::isnan(found.largest) && !(std::abs(value) <= std::abs(found.largest)))) {
      found.largest = value;
      found.largest_time = apart.time[i];
    }
    squares += value * value;
  }
  found.final = apart.value.back();
  found.final_time = apart.time.back();
  found.times = apart.time.size();
  found.between_rows = apart.between_rows;
  found.rms = std::sqrt(squares / static_cast<double>(found.times));
  return found;
}

std::optional<double> deviation_at(const Series& series, std::size_t column, const Series& other,
                                   std::size_t other_column, Between between, double time) {
  const Difference apart = difference(series, column, other, other_column, between);
  return interpolate(apart.time, apart.value, time);
}

const char* name_of(ToleranceVerdict verdict) {
  switch (verdict) {
    case ToleranceVerdict::held:
      return "held";
    case ToleranceVerdict::broken:
      return "broken";
    case ToleranceVerdict::cut_short:
      return "cut short";
    case ToleranceVerdict::unchecked:
      break;
  }
  return "not checked";
}

std::vector<ToleranceCheck> check(const Tolerance& tolerance, const std::optional<Deviation>& deviation,
                                  bool cut_short) {
  std::vector<ToleranceCheck> checks;
  const auto add = [&](const char* measure, const std::optional<double>& allowed, double Deviation::*what) {
    if (!allowed) return;
    const double found = deviation ? (*deviation).*what : std::numeric_limits<double>::quiet_NaN();
    if (!deviation) {
      checks.push_back({measure, *allowed, found, ToleranceVerdict::unchecked});
      return;
    }
    const bool within = std::abs(found) <= *allowed;
    ToleranceVerdict verdict = within ? ToleranceVerdict::held : ToleranceVerdict::broken;
    // What is the mean or the last of a part says nothing of the whole.
    if (cut_short && (within || std::string_view(measure) != "largest"))
      verdict = ToleranceVerdict::cut_short;
    checks.push_back({measure, *allowed, found, verdict});
  };
  add("largest", tolerance.largest, &Deviation::largest);
  add("rms", tolerance.rms, &Deviation::rms);
  add("final", tolerance.final, &Deviation::final);
  return checks;
}

}  // namespace talus
