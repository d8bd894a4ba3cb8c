#include "contact/wave_loads.hpp"

#include "kernels/blocks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace talus {
namespace {

constexpr std::size_t guard_loads = 8;
constexpr std::uint32_t corners_of_line = 64 / sizeof(CornerLoad);  ///< loads of four corners share one
constexpr double guard_load = -1.2345678901234567e-300;
constexpr std::uint32_t nowhere = 0xFFFFFFFFu;
constexpr std::uint32_t no_loads = 0;  ///< where zeros stand, before all loads
constexpr std::size_t gather_at_once = 64, gather_covered_at_once = 4;
constexpr std::uint32_t most_summed = std::numeric_limits<std::uint16_t>::max();

std::uint32_t corners_of(const Model& model, std::uint32_t piece) {
  return model.piece_start[piece + 1] - model.piece_start[piece];
}

/// Of a body whose corners are those of its one piece; else 0.
std::uint16_t corners_of_one_piece(const Model& model, const Body& body) {
  const std::uint32_t corners = body.corner_end - body.corner_begin;
  return model.one_piece(body) && corners <= most_summed ? static_cast<std::uint16_t>(corners) : 0;
}

/// Where a piece pair is found that is one of `pairs` pairs, or of those that are listed.
std::size_t entry_number(std::size_t pairs, const BodyPair& pair, std::size_t number, std::uint32_t i) {
  return pair.plain() ? number : pairs + pair.piece_pair_range[0] + i;
}

/// Calls take(body, piece, its entry number, 0 or 1 for a or b) for the moving bodies of some pairs, in their
/// order.
template <class Take>
void visit(const Model& model, std::span<const BodyPair> pairs, const PiecePairs& piece_pairs,
           std::size_t begin, std::size_t end, const Take& take) {
  for (std::size_t number = begin; number < end; ++number) {
    const BodyPair& pair = pairs[number];
    const bool a_moves = model.moves(pair.a), b_moves = model.moves(pair.b);
    for (std::uint32_t i = 0; i < pair.piece_pair_count(); ++i) {
      const PiecePair pieces = piece_pairs.at(pair, i);
      const std::size_t entry = entry_number(pairs.size(), pair, number, i);
      if (a_moves) take(pair.a, pieces.a, entry, 0);
      if (b_moves) take(pair.b, pieces.b, entry, 1);
    }
  }
}

}  // namespace

WaveLoads::WaveLoads(const Model& model, SimdLevel level, Workers& workers, bool may_sleep)
    : workers_(workers),
      kernels_(kernels::block_kernels(level)),
      wave_size_(pairs_of_wave(workers.threads())),
      may_sleep_(may_sleep) {
  for (std::uint32_t piece = 0; piece + 1 < model.piece_start.size(); ++piece)
    most_corners_ = std::max(most_corners_, corners_of(model, piece));
  for (const Body& body : model.bodies) any_divided_ = any_divided_ || corners_of_one_piece(model, body) == 0;
}

void WaveLoads::lay_out(const Model& model, std::span<BodyPair> pairs,
                        std::span<const std::uint32_t> batch_begin, std::span<PiecePair> piece_pairs,
                        std::span<const std::uint32_t> first_piece) {
  const std::size_t entries = pairs.size() + piece_pairs.size();
  latest_.assign(model.bodies.size(), nowhere);
  wave_bodies_.assign(1, 0);
  bodies_.clear();
  first_.clear();
  make_room_in(first_, 2 * entries);
  if (any_divided_) make_room_in(piece_, 2 * entries);
  for (auto& entry : entry_) {
    make_room_in(entry, entries);
    entry.assign(entries, nowhere);
  }
  batch_load_.clear();
  std::uint32_t most = 0;
  for (std::size_t first = 0; first < pairs.size(); first += wave_size_) {
    const std::size_t end = std::min(first + wave_size_, pairs.size());
    std::uint32_t loads = most_corners_;  // what stands before them are zeros
    for (std::size_t i = first; i < end; ++i) {
      BodyPair& pair = pairs[i];
      if (i == batch_begin[batch_load_.size()]) append_to(batch_load_, loads);
      loads = (loads + corners_of_line - 1) / corners_of_line * corners_of_line;
      pair.load_start = loads;
      if (pair.plain()) loads += pair.plain_corners[0] + pair.plain_corners[1];
      for (std::uint32_t k = 0; k < pair.piece_pair_count() && !pair.plain(); ++k) {
        PiecePair& pieces = piece_pairs[pair.piece_pair_range[0] + k];
        pieces.load_start = loads;
        loads += corners_of(model, pieces.a) + corners_of(model, pieces.b);
      }
    }
    most = std::max(most, loads);
    list_bodies(model, pairs, {piece_pairs.data(), first_piece.data()}, first, end);
  }
  place_sums();
  append_to(batch_load_, 0U);
  make_room_in(corner_, most + guard_loads);
  corner_.assign(most, {0, 0});
  corner_.resize(most + guard_loads, {guard_load, guard_load});
  written_ = false;
  renewed_ = false;
}

/// So that each body can gather its loads, pair after pair, whoever evaluated the pairs.
void WaveLoads::list_bodies(const Model& model, std::span<const BodyPair> pairs,
                            const PiecePairs& piece_pairs, std::size_t begin, std::size_t end) {
  const std::uint32_t first = wave_bodies_.back();
  visit(model, pairs, piece_pairs, begin, end, [&](std::uint32_t number, std::uint32_t, std::size_t, int) {
    const std::uint32_t before = latest_[number];
    if (before == nowhere || before < first) {
      const Body& body = model.bodies[number];
      latest_[number] = static_cast<std::uint32_t>(bodies_.size());
      append_to(bodies_, {number, 0, 0, body.corner_begin, corners_of_one_piece(model, body),
                          before != nowhere, false});
      if (before != nowhere) bodies_[before].goes_on = true;
    }
    ++bodies_[latest_[number]].begin;
  });
  wave_bodies_.push_back(static_cast<std::uint32_t>(bodies_.size()));
  // How many there are says where each begins, and where it goes on while they are listed.
  const auto first_begin = static_cast<std::uint32_t>(first_.size());
  std::uint32_t at = first_begin;
  for (std::size_t i = first; i < bodies_.size(); ++i) at += std::exchange(bodies_[i].begin, at);
  first_.resize(at, no_loads);
  if (any_divided_) piece_.resize(at);
  const auto list = [&](std::uint32_t body, std::uint32_t piece, std::size_t number, int side) {
    const std::uint32_t entry = bodies_[latest_[body]].begin++;
    if (any_divided_) piece_[entry] = piece;
    entry_[side][number] = entry;
  };
  visit(model, pairs, piece_pairs, begin, end, list);
  for (std::size_t i = bodies_.size(); i-- > first + 1;) bodies_[i].begin = bodies_[i - 1].begin;
  if (first < bodies_.size()) bodies_[first].begin = first_begin;
  for (std::size_t i = begin; i < end; ++i) {
    if (pairs[i].contact_count > 0) gather(model, pairs, piece_pairs, i, true);
  }
}

/// Few bodies meet others of several waves at once, so few sums are there at a time.
void WaveLoads::place_sums() {
  append_to(bodies_, {nowhere, static_cast<std::uint32_t>(first_.size()), 0, 0, 0, false, false});
  for (auto& sums : free_sums_) sums.clear();
  std::uint32_t size = 0;
  for (std::size_t wave = 0; wave < waves(); ++wave) {
    const std::span<kernels::BodyLoads> bodies =
        std::span(bodies_).subspan(wave_bodies_[wave], wave_bodies_[wave + 1] - wave_bodies_[wave]);
    const auto digits = [](const kernels::BodyLoads& body) {
      return static_cast<std::size_t>(std::bit_width(std::max<std::uint32_t>(body.corner_count, 4) - 1));
    };
    for (kernels::BodyLoads& body : bodies) {
      if (body.corner_count == 0 || !(body.begun || body.goes_on)) continue;
      if (!body.begun) {
        std::vector<std::uint32_t>& free = free_sums_[digits(body)];
        latest_[body.body] = free.empty() ? size : free.back();
        if (free.empty()) {
          size += 1U << digits(body);
        } else {
          free.pop_back();
        }
      }
      body.sum = latest_[body.body];
    }
    // Others may take them from the next wave on.
    for (const kernels::BodyLoads& body : bodies) {
      if (body.corner_count > 0 && body.begun && !body.goes_on) append_to(free_sums_[digits(body)], body.sum);
    }
  }
  make_room_in(sum_, size);
  sum_.resize(size);
}

void WaveLoads::gather(const Model& model, std::span<const BodyPair> pairs, const PiecePairs& piece_pairs,
                       std::size_t pair, bool touching) {
  for (std::uint32_t i = 0; i < pairs[pair].piece_pair_count(); ++i) {
    const PiecePair pieces = piece_pairs.at(pairs[pair], i);
    const std::uint32_t of_a = pieces.load_start, of_b = of_a + corners_of(model, pieces.a);
    const std::size_t number = entry_number(pairs.size(), pairs[pair], pair, i);
    if (entry_[0][number] != nowhere) first_[entry_[0][number]] = touching ? of_a : no_loads;
    if (entry_[1][number] != nowhere) first_[entry_[1][number]] = touching ? of_b : no_loads;
  }
}

void WaveLoads::begin(std::size_t wave) {
  wave_ = wave;
  stale_ = renewed_ || (may_sleep_ && written() && waves() > 1);
  written_.store(false, std::memory_order_relaxed);
  if (wave + 1 == waves()) renewed_ = false;
}

void WaveLoads::prepare(std::size_t batch) {
  if (!stale_) return;
  const std::size_t begin = batch_load_[batch], next = batch_load_[batch + 1];
  const std::size_t end = next <= begin ? corner_.size() - guard_loads : next;  // a wave begins
  std::fill(corner() + begin, corner() + end, CornerLoad{0, 0});
}

void WaveLoads::fill(const Model& model, const BodyPair& pair, const PiecePairs& piece_pairs, double value) {
  const PiecePair last = piece_pairs.at(pair, pair.piece_pair_count() - 1);
  const std::uint32_t begin = piece_pairs.at(pair, 0).load_start;
  const std::uint32_t end = last.load_start + corners_of(model, last.a) + corners_of(model, last.b);
  std::fill(corner() + begin, corner() + end, CornerLoad{value, value});
}

bool WaveLoads::add(const Model& model, std::span<const char> still, MotionState& motion) {
  const std::size_t first = wave_bodies_[wave_], count = wave_bodies_[wave_ + 1] - first;
  const kernels::GatheredLoads loads{bodies_.data() + first, first_.data(), corner_.data(), sum_.data(),
                                     still.empty() ? nullptr : still.data()};
  std::atomic<bool> sound{true};
  const std::size_t at_once = model.mostly_covered() ? gather_covered_at_once : gather_at_once;
  workers_.over(count, at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
    double all = kernels_.add_loads(loads, model.reference_x.data(), model.reference_y.data(),
                                    motion.forces.data(), begin, end);
    for (std::size_t i = begin; i < end && any_divided_; ++i) {
      const kernels::BodyLoads& gathered = loads.bodies[i];
      if (gathered.corner_count != 0 || (!still.empty() && still[gathered.body] != 0)) continue;
      for (std::uint32_t at = gathered.begin; at != (&gathered)[1].begin; ++at)
        all += add_piece_loads(model, piece_[at], first_[at], motion);
    }
    if (!std::isfinite(all)) sound.store(false, std::memory_order_relaxed);
  });
  return sound;
}

/// Returns what adding all of them gives.
double WaveLoads::add_piece_loads(const Model& model, std::uint32_t piece, std::uint32_t first,
                                  MotionState& motion) const {
  const CornerLoad* load = corner() + first;
  if (model.is_strip[piece] != 0) {
    const auto none = [](const CornerLoad& at) { return at.x == 0 && at.y == 0; };
    if (none(load[0]) && none(load[1])) return 0;  // most pieces of two bodies in contact are apart
    const BoundarySide& side = model.sides[model.strips[model.piece_strip[piece]].side];
    motion.add_force(side.start, {load[0].x, load[0].y});
    motion.add_force(side.end, {load[1].x, load[1].y});
    return (load[0].x + load[0].y) + (load[1].x + load[1].y);
  }
  double all = 0;
  BodyForce& force = motion.forces[model.piece_body[piece]];
  for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c, ++load) {
    force.add({model.reference_x[c], model.reference_y[c]}, {load->x, load->y});
    all += load->x + load->y;
  }
  return all;
}

bool WaveLoads::intact() const {
  const auto is_guard = [](double load) {
    return std::bit_cast<std::uint64_t>(load) == std::bit_cast<std::uint64_t>(guard_load);
  };
  return std::all_of(corner_.end() - guard_loads, corner_.end(),
                     [&](const CornerLoad& load) { return is_guard(load.x) && is_guard(load.y); });
}

}  // namespace talus
