#include "compare/deviation.hpp"

#include <cmath>
#include <string_view>

namespace talus {

std::optional<Deviation> deviation(const Series& series, std::size_t column, const Series& other,
                                   std::size_t other_column) {
  Deviation found;
  double squares = 0;
  for (std::size_t row = 0; row < series.time.size(); ++row) {
    const double time = series.time[row];
    const std::optional<double> expected = interpolate(other.time, other.values[other_column], time);
    if (!expected) continue;
    const double difference = series.values[column][row] - *expected;
    // Written so that a NaN is kept as the largest.
    if (found.times == 0 ||
        (!std::isnan(found.largest) && !(std::abs(difference) <= std::abs(found.largest)))) {
      found.largest = difference;
      found.largest_time = time;
    }
    squares += difference * difference;
    found.final = difference;
    found.final_time = time;
    ++found.times;
  }
  if (found.times == 0) return std::nullopt;
  found.rms = std::sqrt(squares / static_cast<double>(found.times));
  return found;
}

std::optional<double> deviation_at(const Series& series, std::size_t column, const Series& other,
                                   std::size_t other_column, double time) {
  const std::optional<double> value = interpolate(series.time, series.values[column], time);
  const std::optional<double> expected = interpolate(other.time, other.values[other_column], time);
  if (!value || !expected) return std::nullopt;
  return *value - *expected;
}

const char* name_of(ToleranceVerdict verdict) {
  switch (verdict) {
    case ToleranceVerdict::held:
      return "held";
    case ToleranceVerdict::broken:
      return "broken";
    case ToleranceVerdict::cut_short:
      break;
  }
  return "cut short";
}

std::vector<ToleranceCheck> check(const Tolerance& tolerance, const Deviation& deviation, bool cut_short) {
  std::vector<ToleranceCheck> checks;
  const auto add = [&](const char* measure, const std::optional<double>& allowed, double found) {
    if (!allowed) return;
    const bool within = std::abs(found) <= *allowed;
    ToleranceVerdict verdict = within ? ToleranceVerdict::held : ToleranceVerdict::broken;
    // What is the mean or the last of a part says nothing of the whole.
    if (cut_short && (within || std::string_view(measure) != "largest"))
      verdict = ToleranceVerdict::cut_short;
    checks.push_back({measure, *allowed, found, verdict});
  };
  add("largest", tolerance.largest, deviation.largest);
  add("rms", tolerance.rms, deviation.rms);
  add("final", tolerance.final, deviation.final);
  return checks;
}

}  // namespace talus
