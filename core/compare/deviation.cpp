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

}  // namespace

Difference difference(const Series& series, std::size_t column, const Series& other, std::size_t other_column,
                      Between between) {
  // A run that was stopped has a row of that moment besides.
  const bool other_is_coarser = between == Between::unknown && count_within(other.time, series.time) + 1 <
                                                                   count_within(series.time, other.time);
  Difference found;
  for (const double time : other_is_coarser ? other.time : series.time) {
    const std::optional<double> value = interpolate(series.time, series.values[column], time);
    const std::optional<double> expected = interpolate(other.time, other.values[other_column], time);
    if (!value || !expected) continue;
    found.time.push_back(time);
    found.value.push_back(*value - *expected);
  }
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
