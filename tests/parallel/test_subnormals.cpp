#include "parallel/subnormals.hpp"

#include "parallel/workers.hpp"

#include <catch2/catch.hpp>

#include <set>
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

// What a thread computed is looked at when it no longer takes subnormal operands for 0.

TEST_CASE("Subnormal results and operands are 0 for a while, and come back after it", "[parallel]") {
  const double half = half_of_least();
  REQUIRE(half > 0);
  double result = 1, of_operand = 1, of_least = 0;
  {
    const NoSubnormals here;
    result = half_of_least();
    const volatile double operand = half;
    of_operand = operand * 4;
    of_least = least * 2;
  }
  CHECK(result == 0);
  CHECK(of_operand == 0);
  CHECK(of_least == 2 * least);
  CHECK(half_of_least() == half);
}

TEST_CASE("All threads of a loop take subnormal numbers for 0 in steps", "[parallel]") {
  Workers workers(3);  // before the mode, which new threads inherit
  std::vector<double> halves(300, 1.0);
  std::vector<std::size_t> threads(halves.size());
  // Until two threads at least had a share, whatever else the machine does.
  for (int round = 0; round < 1000 && std::set(threads.begin(), threads.end()).size() < 2; ++round) {
    const NoSubnormals here;
    workers.over(halves.size(), 1, [&](std::size_t, std::size_t begin, std::size_t, std::size_t thread) {
      volatile double work = 1;
      for (int i = 0; i < 1000; ++i) work = work * 1.01;
      halves[begin] = half_of_least();
      threads[begin] = thread;
    });
  }
  CHECK(std::set(threads.begin(), threads.end()).size() >= 2);
  CHECK(halves == std::vector<double>(300, 0.0));
}

#endif
