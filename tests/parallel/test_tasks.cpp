#include "parallel/tasks.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

using namespace talus;

TEST_CASE("Tasks are each done once, on any number of threads, and in order on one", "[parallel]") {
  for (const int threads : {0, 1, 2, 100}) {
    std::vector<std::atomic<int>> times(37);
    do_tasks(times.size(), threads, [&](std::size_t i) { ++times[i]; });
    for (const std::atomic<int>& each : times) CHECK(each == 1);
  }
  std::vector<std::size_t> order;
  do_tasks(5, 1, [&](std::size_t i) { order.push_back(i); });
  CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
  do_tasks(0, 4, [](std::size_t) { FAIL("there is none"); });
}

TEST_CASE("A task that throws keeps no other from being done, and the first of those is told", "[parallel]") {
  for (const int threads : {1, 3}) {
    std::atomic<int> done = 0;
    CHECK_THROWS_WITH(do_tasks(9, threads,
                               [&](std::size_t i) {
                                 if (i == 7 || i == 4) throw std::runtime_error("task " + std::to_string(i));
                                 ++done;
                               }),
                      "task 4");
    CHECK(done == 7);
  }
}
