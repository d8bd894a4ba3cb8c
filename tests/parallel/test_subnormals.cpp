#include "parallel/subnormals.hpp"

#include "parallel/workers.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace talus;

namespace {

volatile double least = 2.2250738585072014e-308;

/// Half of the least number that is not subnormal.
double half_of_least() {
  const volatile double half = least / 2;
  return half;
}

}  // namespace

#if defined(__x86_64__)

TEST_CASE("Subnormal numbers are 0 for a while, and come back after it", "[parallel]") {
  const double half = half_of_least();
  REQUIRE(half > 0);
  {
    const NoSubnormals here;
    CHECK(half_of_least() == 0);
    const volatile double operand = half;
    CHECK(operand * 2 == 0);
    CHECK(least > 0);
  }
  CHECK(half_of_least() == half);
}

TEST_CASE("All threads of a step take subnormal numbers for 0", "[parallel]") {
  const NoSubnormals here;
  Workers workers(3);
  std::vector<double> halves(300, 1.0);
  workers.over(halves.size(), 1, [&](std::size_t, std::size_t begin, std::size_t) {
    volatile double work = 1;
    for (int i = 0; i < 1000; ++i) work = work * 1.01;  // so that there is a share for each
    halves[begin] = half_of_least();
  });
  CHECK(halves == std::vector<double>(300, 0.0));
}

#endif
