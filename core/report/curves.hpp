#pragma once

#include "compare/deviation.hpp"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace talus {

/// Finite numbers with as many digits as tell apart a millionth of their range, which may lie far from zero,
/// and at least six; others are null.
nlohmann::ordered_json short_numbers(const std::vector<double>& values);

/// A history for the charts of a page: at most some 1500 of its rows, one of every so many and the last;
/// `largest` is the largest magnitude of each column in all rows.
nlohmann::ordered_json curves_of(const Series& series);

/// What a history has in its columns more than another one of the same name, at the times compared.
Series difference(const Series& series, const Series& from, Between between);

}  // namespace talus
