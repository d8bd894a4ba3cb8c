#include "picture/thinned.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

using namespace talus;

TEST_CASE("A thinned column keeps its ends, its peaks and its gaps, and is no longer than asked",
          "[output]") {
  std::vector<double> values(12001, 0.0);
  values[1002] = 641959;
  values[7003] = -3;
  values[9000] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> rows = thinned_rows(values, 1500);
  CHECK(std::is_sorted(rows.begin(), rows.end()));
  CHECK(rows.size() <= 1500 + 3);
  CHECK(rows.front() == 0);
  CHECK(rows.back() == 12000);
  for (const std::size_t row : {1002, 7003, 9000}) CHECK(std::count(rows.begin(), rows.end(), row) == 1);
}

TEST_CASE("A short column is kept as it is", "[output]") {
  CHECK(thinned_rows({2, 1, 3}, 3) == std::vector<std::size_t>{0, 1, 2});
  CHECK(thinned_rows({}, 3).empty());
}
