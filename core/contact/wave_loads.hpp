#pragma once

#include "contact/pair_parts.hpp"
#include "contact/room.hpp"
#include "kernels/level.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "parallel/workers.hpp"

#include <talus/contact_model.hpp>

#include <array>
#include <atomic>
#include <span>
#include <vector>

namespace talus {

/// The loads of pairs, wave after wave of them: what a law has written of one is gathered by the bodies
/// before the next takes its place.
class WaveLoads {
 public:
  /// `may_sleep`: whether pairs in contact may stay unasked.
  WaveLoads(const Model& model, SimdLevel level, Workers& workers, bool may_sleep);

  /// Gives all piece pairs their load_start. `batch_begin` as divide_into_batches() says, `piece_pairs` and
  /// `first_piece` as PiecePairs.
  void lay_out(const Model& model, std::span<BodyPair> pairs, std::span<const std::uint32_t> batch_begin,
               std::span<PiecePair> piece_pairs, std::span<const std::uint32_t> first_piece);

  std::size_t waves() const { return wave_bodies_.size() - 1; }

  /// Until the next call the loads are those of this wave.
  void begin(std::size_t wave);
  /// Before a law writes loads of a batch, and where it writes none. Any thread, each batch of the wave once.
  void prepare(std::size_t batch);
  /// From now on bodies gather what stands at the pieces of a pair, or nothing. Any thread, each pair by one.
  /// After lay_out() they gather from the pairs that were in contact.
  void gather(const Model& model, std::span<const BodyPair> pairs, const PiecePairs& piece_pairs,
              std::size_t pair, bool touching);
  /// Sets all loads of a pair, N/m.
  void fill(const Model& model, const BodyPair& pair, const PiecePairs& piece_pairs, double value);
  /// Makes all loads zero as the next waves begin.
  void renew() { renewed_ = true; }
  /// Says that a law may write some. Any thread.
  void expect() {
    if (!written()) written_.store(true, std::memory_order_relaxed);
  }
  /// Whether there is anything to add: a wave without loads may still end sums that others began.
  bool due() const { return written() || waves() > 1; }

  /// Adds what was written to the forces on moving bodies, contact after contact and in the order of pairs
  /// (f_c of Eq. 48), but not on those that are `still` [body]; empty: none is. False if a load is no number.
  bool add(const Model& model, std::span<const char> still, MotionState& motion);

  CornerLoad* corner() { return corner_.data(); }  ///< [load]
  const CornerLoad* corner() const { return corner_.data(); }

  /// Whether nobody wrote past the last load there can be.
  bool intact() const;

 private:
  bool written() const { return written_.load(std::memory_order_relaxed); }
  void list_bodies(const Model& model, std::span<const BodyPair> pairs, const PiecePairs& piece_pairs,
                   std::size_t begin, std::size_t end);
  void place_sums();

  double add_piece_loads(const Model& model, std::uint32_t piece, std::uint32_t first,
                         MotionState& motion) const;

  Workers& workers_;
  const kernels::BlockKernels& kernels_;
  bool any_divided_ = false;                ///< whether some body is not one convex piece
  InLines<CornerLoad> corner_;              ///< and a guard behind them
  std::vector<std::uint32_t> batch_load_;   ///< [batch of pairs + 1] its first load; not more: a wave begins
  std::vector<kernels::BodyLoads> bodies_;  ///< wave after wave, and one behind them
  std::vector<std::uint32_t> wave_bodies_{0};  ///< [wave + 1] in bodies_
  std::vector<std::uint32_t> first_;           ///< [entry] as GatheredLoads::first
  std::vector<std::uint32_t> piece_;           ///< [entry] if any_divided_
  std::vector<std::uint32_t> entry_[2];        ///< [entry_number()] of pieces a and b; or nowhere
  std::vector<std::uint32_t> latest_;          ///< [body] in bodies_, while they are listed; then its sum
  std::vector<CornerLoad> sum_;                ///< of bodies that gather from several waves
  std::array<std::vector<std::uint32_t>, 17> free_sums_;  ///< [digits of their number of corners, binary]
  std::size_t wave_ = 0;
  std::size_t wave_size_;           ///< pairs
  std::uint32_t most_corners_ = 0;  ///< of a piece
  bool may_sleep_;
  bool renewed_ = false;
  bool stale_ = false;  ///< other loads stand where those of the present wave belong
  std::atomic<bool> written_{false};
};

}  // namespace talus
