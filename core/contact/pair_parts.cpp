#include "contact/pair_parts.hpp"

#include "contact/room.hpp"

#include <algorithm>

namespace talus {
namespace {

/// What a law has to do for a pair, roughly: of those apart it mostly knows without a look.
std::uint64_t work_of(const BodyPair& pair) {
  const std::uint64_t of_pieces = pair.contact_count == 0 ? 1 : pair.master_share == 0.5 ? 20 : 10;
  return of_pieces * (pair.piece_pair_end - pair.piece_pair_start);
}

}  // namespace

void divide_into_batches(std::span<const BodyPair> pairs, int threads,
                         std::vector<std::uint32_t>& batch_begin) {
  // Of several threads the one that is done first takes over a batch of another. Few pairs wake nobody.
  const bool few = pairs.size() <= 4 * pair_chunk;
  const std::size_t shares = threads == 1 || few ? 1 : 2 * static_cast<std::size_t>(threads),
                    large = shares * large_batch;
  batch_begin.assign(1, 0);
  for (std::size_t first = 0; first < pairs.size(); first += pairs_of_wave(threads)) {
    const std::span<const BodyPair> wave =
        pairs.subspan(first, std::min(pairs_of_wave(threads), pairs.size() - first));
    const std::size_t batches = shares * ((wave.size() + large - 1) / large);
    std::uint64_t all = 0, before = 0;
    for (const BodyPair& pair : wave) all += work_of(pair);
    for (std::size_t i = 0, batch = 1; i < wave.size(); ++i) {
      if (i % pair_chunk == 0 && before * batches >= all * batch) {
        append_to(batch_begin, static_cast<std::uint32_t>(first + i));
        batch = before * batches / all + 1;
      }
      before += work_of(wave[i]);
    }
    append_to(batch_begin, static_cast<std::uint32_t>(first + wave.size()));
  }
}

}  // namespace talus
