#include "contact/pair_parts.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace talus;

namespace {

/// Pairs of a piece each, of which those from `first` on touched in the last step.
std::vector<BodyPair> pairs_touching_from(std::size_t first, std::size_t count) {
  std::vector<BodyPair> pairs(count);
  for (std::size_t i = 0; i < count; ++i) {
    pairs[i].piece_pair_range[0] = static_cast<std::uint32_t>(i);
    pairs[i].piece_pair_range[1] = pairs[i].piece_pair_range[0] + 1;
    pairs[i].contact_count = i < first ? 0 : 1;
  }
  return pairs;
}

std::vector<std::uint32_t> batches(const std::vector<BodyPair>& pairs, int threads,
                                   const PairSharing& sharing = plain_pairs) {
  std::vector<std::uint32_t> begin{7, 7, 7};
  divide_into_batches(pairs, sharing, threads, begin);
  return begin;
}

}  // namespace

TEST_CASE("batches cover all pairs in whole chunks, and none lies in two waves", "[contact][batches]") {
  for (const int threads : {1, 2, 3, 7}) {
    for (const std::size_t count : {std::size_t{1}, pair_chunk, pair_chunk + 1, std::size_t{2025},
                                    pairs_of_wave(1) + 1, 3 * pairs_of_wave(1), pairs_of_wave(2) + 100}) {
      CAPTURE(threads, count);
      const std::vector<std::uint32_t> begin = batches(pairs_touching_from(count / 3, count), threads);
      REQUIRE(begin.front() == 0);
      REQUIRE(begin.back() == count);
      for (std::size_t i = 1; i < begin.size(); ++i) {
        REQUIRE(begin[i] > begin[i - 1]);
        if (i + 1 < begin.size()) REQUIRE(begin[i] % pair_chunk == 0);
      }
      for (std::size_t wave = pairs_of_wave(threads); wave < count; wave += pairs_of_wave(threads))
        REQUIRE(std::binary_search(begin.begin(), begin.end(), wave));
    }
  }
}

TEST_CASE("no pairs make no batch", "[contact][batches]") {
  CHECK(batches({}, 1) == std::vector<std::uint32_t>{0});
  CHECK(batches({}, 2) == std::vector<std::uint32_t>{0});
}

TEST_CASE("one thread has as few batches as their size allows, others share the work", "[contact][batches]") {
  CHECK(batches(pairs_touching_from(0, large_batch), 1).size() == 2);
  CHECK(batches(pairs_touching_from(0, large_batch + 1), 1).size() == 3);

  CHECK(batches(pairs_touching_from(0, 4 * pair_chunk), 2).size() == 2);  // too few to wake others for
  CHECK(batches(pairs_touching_from(0, 4 * pair_chunk + 1), 2).size() > 2);

  const std::vector<std::uint32_t> even = batches(pairs_touching_from(0, 4096), 2);
  CHECK(even == std::vector<std::uint32_t>{0, 1024, 2048, 3072, 4096});
  // Pairs that are apart cost little: whoever has them takes more.
  const std::vector<std::uint32_t> half_apart = batches(pairs_touching_from(2048, 4096), 2);
  REQUIRE(half_apart.size() == 5);
  CHECK(half_apart[1] > 2048);
  CHECK(half_apart[4] - half_apart[3] < 640);
  CHECK(half_apart[4] - half_apart[3] > 400);
}

TEST_CASE("pairs of bodies of many elements are shared where others would be too few", "[contact][batches]") {
  CHECK(batches(pairs_touching_from(0, 4 * heavy_pairs.chunk), 2, heavy_pairs).size() == 2);
  CHECK(batches(pairs_touching_from(0, 4 * heavy_pairs.chunk + 1), 2, heavy_pairs).size() == 6);
  const std::vector<std::uint32_t> begin = batches(pairs_touching_from(0, 352), 2, heavy_pairs);
  REQUIRE(begin.size() == 17);
  for (std::size_t i = 1; i < 16; ++i) {
    CHECK(begin[i] % heavy_pairs.chunk == 0);
    CHECK(begin[i] == Approx(static_cast<double>(22 * i)).margin(heavy_pairs.chunk / 2.0));
  }
}

TEST_CASE("pairs of bodies of many elements are divided anew as others are", "[contact][batches]") {
  std::vector<std::uint32_t> other;
  const std::vector<std::uint32_t> begin = batches(pairs_touching_from(100, 200), 2, heavy_pairs);
  CHECK_FALSE(worth_dividing_anew(pairs_touching_from(100, 200), heavy_pairs, 2, begin, other));
  CHECK(worth_dividing_anew(pairs_touching_from(0, 200), heavy_pairs, 2, begin, other));
  CHECK(other == batches(pairs_touching_from(0, 200), 2, heavy_pairs));
}

TEST_CASE("a batch ends at the chunk nearest to its share", "[contact][batches]") {
  for (const std::size_t count :
       {std::size_t{300}, std::size_t{1000}, std::size_t{2200}, std::size_t{4000}}) {
    const std::vector<std::uint32_t> begin = batches(pairs_touching_from(0, count), 2);
    REQUIRE(begin.size() == 5);
    for (std::size_t i = 1; i < 4; ++i) {
      CAPTURE(count, i);
      CHECK(begin[i] == Approx(static_cast<double>(i * count) / 4).margin(pair_chunk / 2.0));
    }
  }
}

TEST_CASE("pairs are divided anew when contacts are elsewhere, and not before", "[contact][batches]") {
  std::vector<std::uint32_t> other;
  for (const int threads : {2, 3}) {
    for (const std::size_t count : {std::size_t{2048}, pairs_of_wave(threads) + 4096,
                                    pairs_of_wave(threads) + 10}) {  // a last wave of one batch
      CAPTURE(threads, count);
      const std::vector<BodyPair> in_a_half = pairs_touching_from(count / 2, count);
      const std::vector<std::uint32_t> begin = batches(in_a_half, threads);
      CHECK_FALSE(worth_dividing_anew(in_a_half, plain_pairs, threads, begin, other));
      for (const std::size_t first : {std::size_t{0}, count - count / 8}) {
        const std::vector<BodyPair> elsewhere = pairs_touching_from(first, count);
        CHECK(worth_dividing_anew(elsewhere, plain_pairs, threads, begin, other));
        CHECK(other == batches(elsewhere, threads));
      }
    }
  }
  const std::vector<BodyPair> few = pairs_touching_from(0, 4 * pair_chunk);
  CHECK_FALSE(worth_dividing_anew(few, plain_pairs, 2, batches(few, 2), other));
  CHECK_FALSE(worth_dividing_anew({}, plain_pairs, 2, batches({}, 2), other));
}
