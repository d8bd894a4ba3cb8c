#include "compare/deviation.hpp"

#include <cmath>

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

std::vector<ToleranceCheck> check(const Tolerance& tolerance, const Deviation& deviation) {
  std::vector<ToleranceCheck> checks;
  const auto add = [&](const char* measure, const std::optional<double>& allowed, double found) {
    if (allowed) checks.push_back({measure, *allowed, found, std::abs(found) <= *allowed});
  };
  add("largest", tolerance.largest, deviation.largest);
  add("rms", tolerance.rms, deviation.rms);
  add("final", tolerance.final, deviation.final);
  return checks;
}

}  // namespace talus
