#include "output/series.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace talus {

namespace {

/// Where reading stands, for messages.
struct Position {
  const std::string& file;
  std::size_t line;
};

[[noreturn]] void fail(const Position& position, const std::string& words) {
  throw InputError(fmt::format("{}:{}: {}", position.file, position.line, words));
}

std::vector<std::string> split(std::string_view line, const Position& position) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  if (quoted) fail(position, "a quotation mark is not closed");
  return fields;
}

double number_of(std::string_view field, const Position& position) {
  const std::string_view text = trimmed(field);
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const char* first = text.data() + (text.front() == '+' ? 1 : 0);
  const auto [end, problem] = std::from_chars(first, text.data() + text.size(), value);
  if (text.starts_with("+-") || problem != std::errc() || end != text.data() + text.size()) {
    fail(position, fmt::format("'{}' is no number", text));
  }
  return value;
}

void read_header(Series& series, std::string_view line, const Position& position) {
  const std::vector<std::string> fields = split(line, position);
  if (trimmed(fields[0]) != "t [s]") {
    fail(position, fmt::format("the first column must be 't [s]', not '{}'", trimmed(fields[0])));
  }
  for (std::size_t i = 1; i < fields.size(); ++i) {
    std::string name(trimmed(fields[i]));
    if (series.column(name)) fail(position, fmt::format("column '{}' is there twice", name));
    series.names.push_back(std::move(name));
  }
  series.values.resize(series.names.size());
}

void read_row(Series& series, std::string_view line, const Position& position) {
  const std::vector<std::string> fields = split(line, position);
  if (fields.size() != series.names.size() + 1) {
    fail(position, fmt::format("{} fields where the header has {}", fields.size(), series.names.size() + 1));
  }
  const double time = number_of(fields[0], position);
  if (!std::isfinite(time)) fail(position, fmt::format("'{}' is no time", fields[0]));
  if (!series.time.empty() && !(time > series.time.back())) {
    fail(position, fmt::format("times must increase, but '{}' comes here", fields[0]));
  }
  series.time.push_back(time);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    series.values[i - 1].push_back(number_of(fields[i], position));
  }
}

}  // namespace

std::optional<std::size_t> Series::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::string csv_line(std::span<const std::string> fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (!line.empty() || &field != fields.data()) line += ',';
    if (field.find_first_of(",\"\n\r") == std::string::npos) {
      line += field;
      continue;
    }
    line += '"';
    for (const char letter : field) line += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    line += '"';
  }
  return line;
}

Series read_series(const std::filesystem::path& file) {
  return read_series_text(read_whole_file(file), file.string());
}

Series read_series_text(std::string_view text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  Series series;
  bool header_read = false;
  Position position{name, 0};
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++position.line;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (trimmed(line).empty() || line.front() == '#') continue;
    if (header_read) {
      read_row(series, line, position);
    } else {
      read_header(series, line, position);
      header_read = true;
    }
  }
  if (!header_read) fail(position, "there is no header line ('t [s],<monitor>.<quantity> [unit],...')");
  return series;
}

Series read_reference_text(std::string_view text, const std::string& name,
                           std::span<const std::string> columns) {
  Series series = read_series_text(text, name);
  if (series.time.empty()) throw InputError(fmt::format("{}: there are no rows below the header", name));
  for (std::size_t column = 0; column < series.names.size(); ++column) {
    if (std::find(columns.begin(), columns.end(), series.names[column]) == columns.end()) continue;
    for (std::size_t row = 0; row < series.time.size(); ++row) {
      if (std::isfinite(series.values[column][row])) continue;
      throw InputError(
          fmt::format("{}: '{}' has no finite number at t = {:.9g} s: leave out the row, or give "
                      "the column a file of its own",
                      name, series.names[column], series.time[row]));
    }
  }
  return series;
}

double time_tolerance(std::span<const double> times) {
  return times.empty() ? 0 : 5e-6 * std::max(std::abs(times.front()), std::abs(times.back()));
}

std::optional<std::size_t> row_at(std::span<const double> times, double time) {
  if (times.empty()) return std::nullopt;
  const double rounding = 1e-9 * std::max(std::abs(times.front()), std::abs(times.back()));
  const auto row = std::lower_bound(times.begin(), times.end(), time - rounding);
  if (row == times.end() || !(*row <= time + rounding)) return std::nullopt;
  return static_cast<std::size_t>(row - times.begin());
}

std::optional<double> interpolate(std::span<const double> times, std::span<const double> values,
                                  double time) {
  const double little = time_tolerance(times);
  if (times.empty() || !(time >= times.front() - little) || !(time <= times.back() + little))
    return std::nullopt;
  time = std::clamp(time, times.front(), times.back());
  const auto above =
      static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), time) - times.begin());
  if (times[above] == time) return values[above];
  const double share = (time - times[above - 1]) / (times[above] - times[above - 1]);
  return values[above - 1] + share * (values[above] - values[above - 1]);
}

}  // namespace talus
