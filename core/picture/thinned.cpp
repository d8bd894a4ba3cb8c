#include "picture/thinned.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus {

std::vector<std::size_t> thinned_rows(const std::vector<double>& values, std::size_t most) {
  std::vector<std::size_t> rows;
  if (values.size() <= most) {
    rows.resize(values.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return rows;
  }
  const std::size_t side_by_side = (2 * values.size() + most - 1) / most;
  for (std::size_t begin = 0; begin < values.size(); begin += side_by_side) {
    const std::size_t end = std::min(begin + side_by_side, values.size());
    std::size_t low = end, high = end, gap = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(values[i])) {
        if (gap == end) gap = i;
      } else {
        if (low == end || values[i] < values[low]) low = i;
        if (high == end || values[i] > values[high]) high = i;
      }
    }
    for (const std::size_t row : {low, high, gap}) {
      if (row < end) rows.push_back(row);
    }
  }
  rows.push_back(0);
  rows.push_back(values.size() - 1);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace talus
