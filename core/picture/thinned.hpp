#pragma once

#include <cstddef>
#include <vector>

namespace talus {

/// The rows of a column to draw where there are more than `most`, in their order: the smallest and the
/// largest of every few rows side by side, so that no peak is lost, the first and the last, and one of each
/// gap.
std::vector<std::size_t> thinned_rows(const std::vector<double>& values, std::size_t most);

}  // namespace talus
