#pragma once

#include "kernels/contact_totals.hpp"

#include <talus/contact_model.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// How pairs are shared out.
struct PairSharing {
  std::size_t chunk;              ///< pairs, at most pair_chunk
  std::size_t batches_of_thread;  ///< the one that is done first takes over a batch of another
};
/// Where most bodies have many elements a pair is the work of many others, and how much shows badly
/// beforehand.
inline constexpr PairSharing plain_pairs{pair_chunk, 2}, heavy_pairs{4, 8};

/// Pairs that a law is given at once, about. Lanes waste least where a law finds many that meet alike, which
/// takes many to choose from; where all meet alike, more than the cache of a core holds only cost.
inline constexpr std::size_t large_batch = 16 * pair_chunk;

/// Pairs whose loads are held at once: so few that they are still in the cache when bodies gather them.
/// Several threads wait for each other after each wave, so theirs are larger. No result shows which.
constexpr std::size_t pairs_of_wave(int threads) {
  return (threads == 1 ? 4 : 256) * large_batch;
}

/// Divides the pairs of each wave into batches of whole chunks, to `batch_begin` [batch + 1]: as many for
/// each thread, of as much work as the contacts of the last step tell. A law is given one of them at once.
void divide_into_batches(std::span<const BodyPair> pairs, const PairSharing& sharing, int threads,
                         std::vector<std::uint32_t>& batch_begin);

/// Whether to divide them as their contacts tell now would take a twentieth off what the busiest thread has
/// to do: to move pairs from one batch to another costs as much as a few steps. That division goes to
/// `other`.
bool worth_dividing_anew(std::span<const BodyPair> pairs, const PairSharing& sharing, int threads,
                         std::span<const std::uint32_t> batch_begin, std::vector<std::uint32_t>& other);

}  // namespace talus
