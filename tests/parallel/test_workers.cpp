#include "parallel/workers.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <numeric>
#include <vector>

using namespace talus;

TEST_CASE("Every index is visited once, whatever the number of threads", "[parallel]") {
  for (const int threads : {1, 2, 3, 5}) {
    Workers workers(threads);
    for (const std::size_t count : {0U, 1U, 7U, 64U, 1000U}) {
      std::vector<int> visits(count, 0);
      std::vector<std::size_t> begins((count + 6) / 7, 99999);
      workers.over(count, 7, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        begins[chunk] = begin;
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      CHECK(visits == std::vector<int>(count, 1));
      for (std::size_t chunk = 0; chunk < begins.size(); ++chunk) CHECK(begins[chunk] == 7 * chunk);
    }
  }
}

TEST_CASE("Loops that follow each other see what the one before wrote", "[parallel]") {
  Workers workers(3);
  std::vector<double> values(500, 1.0), sums(5);
  for (int round = 0; round < 2000; ++round) {
    workers.over(values.size(), 10, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) values[i] += 1;
    });
    workers.over(values.size(), 100, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      sums[chunk] = std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                    values.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
    });
    REQUIRE(std::accumulate(sums.begin(), sums.end(), 0.0) == 500.0 * (round + 2));
  }
}

TEST_CASE("Workers that fell asleep wake up for the next loop", "[parallel]") {
  Workers workers(2);
  int done[2] = {0, 0};
  for (int round = 1; round < 4; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    workers.over(2, 1, [&](std::size_t chunk, std::size_t, std::size_t) { ++done[chunk]; });
    CHECK(done[0] == round);
    CHECK(done[1] == round);
  }
}

TEST_CASE("More threads than cores share many short loops", "[parallel]") {
  Workers workers(8);
  std::vector<std::size_t> by(40);
  std::size_t sum = 0;
  for (std::size_t round = 0; round < 3000; ++round) {
    workers.over(by.size(), 1, [&](std::size_t chunk, std::size_t, std::size_t, std::size_t thread) {
      by[chunk] = chunk + round * (thread < 8 ? 1 : 0);
    });
    sum += std::accumulate(by.begin(), by.end(), std::size_t{0});
  }
  CHECK(sum == 3000u * 780 + 40u * (2999u * 3000 / 2));
}

TEST_CASE("Threads that come late find no loop that has ended", "[parallel]") {
  // Fewer chunks than threads in most loops, so that parts go unused and threads fall behind; what a loop
  // refers to is gone after it.
  Workers workers(5);
  for (std::size_t round = 0; round < 20000; ++round) {
    const std::size_t chunks = 2 + round * round % 7;
    std::vector<std::size_t> visits(chunks, 0);
    workers.over(chunks, 1,
                 [&](std::size_t chunk, std::size_t, std::size_t) { visits[chunk] += round + chunk; });
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) REQUIRE(visits[chunk] == round + chunk);
  }
}
