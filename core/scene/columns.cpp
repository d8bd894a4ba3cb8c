#include "scene/columns.hpp"

#include "files/whole_file.hpp"
#include "scene/files.hpp"
#include "scene/section.hpp"
#include "text/nearest.hpp"
#include "text/plain_number.hpp"
#include "text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = 100'000'000;
constexpr std::size_t most_columns = 1000, most_heads = 100;

/// At most one more than there may be.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (fields.size() <= most_columns) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  return fields;
}

/// Numbers that blanks, tabs or semicolons divide.
bool divided_otherwise(std::string_view line, const std::vector<std::string_view>& fields) {
  return line.find_first_of("0123456789") != std::string_view::npos &&
         line.find_first_not_of("0123456789+-.eE,; \t\r") == std::string_view::npos &&
         std::any_of(fields.begin(), fields.end(), [](std::string_view field) {
           return field.find_first_of("; \t") != std::string_view::npos;
         });
}

/// A name as it stands between commas, perhaps in quotes.
std::string name_of(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return std::string(field);
}

std::optional<std::string> text_of(const fs::path& file, std::string& problem) {
  if (!is_file(file)) {
    problem = fmt::format("there is no file {}", file.string());
    return std::nullopt;
  }
  std::error_code error;
  if (const std::uintmax_t size = fs::file_size(file, error); error || size > most_bytes) {
    problem =
        fmt::format("{} is larger than {} MB, the most that is read", file.string(), most_bytes / 1'000'000);
    return std::nullopt;
  }
  try {
    return read_whole_file(file);
  } catch (const std::system_error& failure) {
    problem = failure.what();
    return std::nullopt;
  }
}

/// Takes a file line by line until one is wrong.
class ColumnReader {
 public:
  explicit ColumnReader(std::string column) : column_(std::move(column)) {}

  /// What is wrong with the line, or "".
  std::string take(std::string_view line) {
    const bool remark = line.starts_with('#');
    if (remark) line.remove_prefix(1);
    const std::vector<std::string_view> fields = fields_of(line);
    if (fields.size() > most_columns) return fmt::format("expected at most {} columns", most_columns);
    if (!remark && columns_.at.empty() && divided_otherwise(line, fields))
      return "numbers with no comma between them: expected lines as 0.1,2.5, with a point in decimals";
    const bool any_number =
        std::any_of(fields.begin(), fields.end(), [](auto one) { return plain_number(one); });
    if (remark || (columns_.at.empty() && !any_number)) return take_head(fields);
    if (columns_.at.empty()) {
      if (std::string problem = choose(fields.size()); !problem.empty()) return problem;
    }
    if (fields.size() != count_)
      return fmt::format("{} columns, but {} in the lines before", fields.size(), count_);
    return take_numbers(fields[0], fields[chosen_]);
  }

  std::string finish() const {
    if (columns_.at.size() >= 2) return {};
    return fmt::format("{} of numbers: expected at least two",
                       columns_.at.empty() ? "no line" : "only one line");
  }

  Columns columns() && { return std::move(columns_); }

 private:
  std::string take_head(const std::vector<std::string_view>& fields) {
    if (heads_.size() == most_heads) return columns_.at.empty() ? "too many lines before the numbers" : "";
    std::vector<std::string>& names = heads_.emplace_back();
    for (const std::string_view field : fields) names.push_back(name_of(field));
    return {};
  }

  /// Which column is meant, once it is known how many there are.
  std::string choose(std::size_t count) {
    count_ = count;
    std::vector<std::string> known;
    for (const std::vector<std::string>& names : heads_) {
      if (names.size() != count) continue;  // a remark with commas in it
      known.insert(known.end(), names.begin() + 1, names.end());
      const auto found = std::find(names.begin() + 1, names.end(), column_);
      if (!column_.empty() && found != names.end()) chosen_ = static_cast<std::size_t>(found - names.begin());
    }
    if (chosen_ != 0) return {};
    if (!column_.empty()) {
      return fmt::format("there is no column \"{}\" after the first;{} known: {}", column_,
                         did_you_mean(column_, known), listed(known));
    }
    chosen_ = 1;
    if (count == 2) return {};
    return fmt::format("{} column{}: expected two, or \"file.csv:name\" with the name of one; known: {}",
                       count, count == 1 ? "" : "s", listed(known));
  }

  std::string take_numbers(std::string_view at, std::string_view value) {
    for (const std::string_view field : {at, value}) {
      if (!plain_number(field))
        return fmt::format("{} is no finite number", shown(Json(std::string(field.substr(0, 100)))));
    }
    const double where = *plain_number(at);
    if (!columns_.at.empty() && !(where > columns_.at.back())) {
      return fmt::format("{} does not come after {}: the first column must rise strictly", where,
                         columns_.at.back());
    }
    if (columns_.at.size() == most_points)
      return fmt::format("more than {} points, the most that are read", most_points);
    columns_.at.push_back(where);
    columns_.value.push_back(*plain_number(value));
    return {};
  }

  std::string column_;
  std::vector<std::vector<std::string>> heads_;
  std::size_t count_ = 0, chosen_ = 0;
  Columns columns_;
};

}  // namespace

std::optional<Columns> read_columns(const fs::path& file, const std::string& column, std::string& problem) {
  const std::optional<std::string> text = text_of(file, problem);
  return text ? read_columns_text(*text, file.string(), column, problem) : std::nullopt;
}

std::optional<Columns> read_columns_text(std::string_view rest, const std::string& name,
                                         const std::string& column, std::string& problem) {
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  ColumnReader reader(column);
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = trimmed(rest.substr(0, end));
    const std::string wrong = line.empty() ? std::string() : reader.take(line);
    if (!wrong.empty()) {
      problem = fmt::format("{}:{}: {}", name, number, wrong);
      return std::nullopt;
    }
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  if (const std::string wrong = reader.finish(); !wrong.empty()) {
    problem = fmt::format("{}: {}", name, wrong);
    return std::nullopt;
  }
  return std::move(reader).columns();
}

}  // namespace talus
