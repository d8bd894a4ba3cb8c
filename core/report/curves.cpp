#include "report/curves.hpp"

#include "picture/thinned.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_rows = 1500;
constexpr int least_digits = 6, most_digits = 17;

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  explicit Extent(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  double largest() const { return low <= high ? std::max(std::abs(low), std::abs(high)) : 0; }
  int digits() const {
    if (!(low < high)) return most_digits;
    const double before = std::max(0.0, std::ceil(std::log10(largest() / (high - low))));
    return std::min(least_digits + static_cast<int>(before), most_digits);
  }
};

std::vector<double> of_rows(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> kept;
  for (const std::size_t row : rows) kept.push_back(values[row]);
  return kept;
}

}  // namespace

Json short_numbers(const std::vector<double>& values) {
  const int digits = Extent(values).digits();
  Json list = Json::array();
  for (const double value : values) {
    list.push_back(std::isfinite(value)
                       ? Json(std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr))
                       : Json(nullptr));
  }
  return list;
}

Json curves_of(const Series& series) {
  Json times = Json::array(), values = Json::array(), largest = Json::array();
  for (const std::vector<double>& column : series.values) {
    const std::vector<std::size_t> rows = thinned_rows(column, most_rows);
    times.push_back(short_numbers(of_rows(series.time, rows)));
    values.push_back(short_numbers(of_rows(column, rows)));
    largest.push_back(Extent(column).largest());
  }
  return {{"times", times},
          {"names", series.names},
          {"values", values},
          {"largest", largest},
          {"thinned", series.time.size() > most_rows}};
}

Series difference(const Series& series, const Series& from, Between between) {
  Series found;
  for (std::size_t column = 0; column < series.names.size(); ++column) {
    const std::optional<std::size_t> other = from.column(series.names[column]);
    if (!other) continue;
    Difference apart = difference(series, column, from, *other, between);
    found.time = std::move(apart.time);  // of all columns the same
    found.names.push_back(series.names[column]);
    found.values.push_back(std::move(apart.value));
  }
  return found;
}

}  // namespace talus
