#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Columns over time: what history.csv and reference files hold. Times increase.
struct Series {
  std::vector<double> time;                 ///< s
  std::vector<std::string> names;           ///< [column] "<monitor>.<quantity> [unit]"
  std::vector<std::vector<double>> values;  ///< [column][row]
  bool stopped = false;                     ///< whether the last row is where numerical trouble ended a run

  std::optional<std::size_t> column(std::string_view name) const;
};

/// One line of a CSV file without its end, quoted where a field needs it.
std::string csv_line(std::span<const std::string> fields);

/// Reads a CSV file whose first column is "t [s]"; lines that start with # are comments, an empty field is no
/// number (NaN). Throws InputError with file and line; std::system_error when it cannot be read.
Series read_series(const std::filesystem::path& file);
Series read_series_text(std::string_view text, const std::string& name);

/// The same of a curve that runs are held against: InputError also where it has no rows, or a field of one of
/// these columns is no number.
Series read_reference_text(std::string_view text, const std::string& name,
                           std::span<const std::string> columns);

/// By how much a time that somebody wrote with six digits may be off, s.
double time_tolerance(std::span<const double> times);

/// The row of a time, as far as rounding goes, s; nothing where there is none.
std::optional<std::size_t> row_at(std::span<const double> times, double time);

/// Linear between the rows around `time`; nothing outside of their range, but for time_tolerance().
std::optional<double> interpolate(std::span<const double> times, std::span<const double> values, double time);

}  // namespace talus
