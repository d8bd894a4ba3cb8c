#include "parallel/large_pages.hpp"

#include <catch2/catch.hpp>

#include <cstddef>
#include <vector>

using namespace talus;

TEST_CASE("values stay as they are in large pages", "[parallel]") {
  // None, less than one large page, and some with a part at both ends.
  for (const std::size_t count : {std::size_t{0}, std::size_t{1000}, std::size_t{1500000}}) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(i);
    prefer_large_pages(values);
    std::size_t same = 0;
    for (std::size_t i = 0; i < count; ++i) same += values[i] == static_cast<double>(i) ? 1 : 0;
    CHECK(same == count);
  }
}
