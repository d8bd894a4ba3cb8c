#include "targets.hpp"

#include "files/input_error.hpp"
#include "output/series.hpp"
#include "scene/columns.hpp"

#include <algorithm>
#include <cmath>

namespace talus::fuzz {

namespace {

void check(const Columns& columns) {
  demand(columns.at.size() >= 2 && columns.at.size() == columns.value.size(), "columns that are no table");
  for (std::size_t i = 0; i < columns.at.size(); ++i) {
    demand(std::isfinite(columns.at[i]) && std::isfinite(columns.value[i]), "a number that is none");
    demand(i == 0 || columns.at[i - 1] < columns.at[i], "a first column that does not rise");
  }
}

void check(const Series& series) {
  demand(series.names.size() == series.values.size(), "a column without a name");
  for (const std::vector<double>& column : series.values)
    demand(column.size() == series.time.size(), "a column without a row");
  for (const double time : series.time) {
    for (const std::vector<double>& column : series.values) interpolate(series.time, column, time);
  }
}

}  // namespace

/// The same text as a table of a scene and as a history. A first line "column NAME" names a column of the
/// former.
void read_tables(std::string_view bytes) {
  constexpr std::string_view key = "column ";
  std::string column;
  if (bytes.starts_with(key)) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    column = bytes.substr(key.size(), end - key.size());
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  std::string problem;
  const std::optional<Columns> columns = read_columns_text(bytes, "table.csv", column, problem);
  demand(columns.has_value() == problem.empty(), "refused without words, or read with some");
  if (columns) check(*columns);
  try {
    check(read_series_text(bytes, "history.csv"));
  } catch (const InputError&) {
  }
}

}  // namespace talus::fuzz
