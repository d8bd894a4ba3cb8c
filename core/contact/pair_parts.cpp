#include "contact/pair_parts.hpp"

#include "contact/room.hpp"

#include <algorithm>

namespace talus {
namespace {

/// What a law has to do for a pair, roughly: of those apart it mostly knows without a look.
std::uint64_t work_of(const BodyPair& pair) {
  const std::uint64_t of_pieces = pair.contact_count == 0 ? 1 : pair.master_share() == 0.5 ? 12 : 10;
  return of_pieces * pair.piece_pair_count();
}

std::uint64_t work_of_all(std::span<const BodyPair> pairs) {
  std::uint64_t all = 0;
  for (const BodyPair& pair : pairs) all += work_of(pair);
  return all;
}

/// What the thread that has most to do begins with, wave after wave: within one a thread begins with as many
/// batches as any other.
std::uint64_t work_of_busiest(std::span<const BodyPair> pairs, int threads,
                              std::span<const std::uint32_t> batch_begin) {
  const auto all_threads = static_cast<std::size_t>(threads);
  std::uint64_t work = 0;
  for (std::size_t batch = 0, end = 0; batch + 1 < batch_begin.size(); batch = end) {
    const std::size_t wave = batch_begin[batch] / pairs_of_wave(threads);
    while (end + 1 < batch_begin.size() && batch_begin[end] / pairs_of_wave(threads) == wave) ++end;
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < all_threads; ++i) {
      const std::uint32_t first = batch_begin[batch + (end - batch) * i / all_threads],
                          last = batch_begin[batch + (end - batch) * (i + 1) / all_threads];
      most = std::max(most, work_of_all(pairs.subspan(first, last - first)));
    }
    work += most;
  }
  return work;
}

}  // namespace

bool worth_dividing_anew(std::span<const BodyPair> pairs, const PairSharing& sharing, int threads,
                         std::span<const std::uint32_t> batch_begin, std::vector<std::uint32_t>& other) {
  constexpr double worth = 1.05;
  divide_into_batches(pairs, sharing, threads, other);
  return static_cast<double>(work_of_busiest(pairs, threads, batch_begin)) >
         worth * static_cast<double>(work_of_busiest(pairs, threads, other));
}

void divide_into_batches(std::span<const BodyPair> pairs, const PairSharing& sharing, int threads,
                         std::vector<std::uint32_t>& batch_begin) {
  const std::size_t chunk = sharing.chunk;
  const bool alone = threads == 1 || pairs.size() <= 4 * chunk;  // few pairs wake nobody
  const std::size_t shares = alone ? 1 : sharing.batches_of_thread * static_cast<std::size_t>(threads),
                    large = shares * large_batch;
  batch_begin.assign(1, 0);
  for (std::size_t first = 0; first < pairs.size(); first += pairs_of_wave(threads)) {
    const std::span<const BodyPair> wave =
        pairs.subspan(first, std::min(pairs_of_wave(threads), pairs.size() - first));
    const std::size_t batches = shares * ((wave.size() + large - 1) / large);
    const std::uint64_t all = work_of_all(wave);
    std::uint64_t before = 0, batch = 1;
    for (std::size_t i = 0; i < wave.size(); i += chunk) {
      const std::uint64_t here = work_of_all(wave.subspan(i, std::min(chunk, wave.size() - i)));
      // A batch ends at the chunk that begins nearest to its share of the work.
      const auto shares_before = [&] { return (2 * before + here) * batches / (2 * all); };
      if (i > 0 && shares_before() >= batch) {
        append_to(batch_begin, static_cast<std::uint32_t>(first + i));
        batch = shares_before() + 1;
      }
      before += here;
    }
    append_to(batch_begin, static_cast<std::uint32_t>(first + wave.size()));
  }
}

}  // namespace talus
