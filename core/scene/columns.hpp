#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Of a file of comma-separated values: the first column, which rises strictly, and another one.
struct Columns {
  std::vector<double> at, value;  ///< at least two of each
};

inline constexpr std::size_t most_points = 1'000'000;  ///< of one file

/// The column of that name in a line before the numbers, or the second of two where `column` is "". Lines
/// that begin with # count as such lines, too. Otherwise nothing, and `problem` says in which line what is
/// wrong.
std::optional<Columns> read_columns(const std::filesystem::path& file, const std::string& column,
                                    std::string& problem);

/// The same from text; `name` stands for the file in messages.
std::optional<Columns> read_columns_text(std::string_view text, const std::string& name,
                                         const std::string& column, std::string& problem);

}  // namespace talus
