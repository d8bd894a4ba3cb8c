#include "contact/neighbours.hpp"

#include "contact/room.hpp"
#include "model/strips.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// A piece wider than this many cells is tested against every other instead of filling the grid.
constexpr double large_in_cells = 4;
/// Whatever flies further shares the last cell, which only costs.
constexpr double last_cell = 1 << 30;

}  // namespace

bool outside_of_a_side(const Model& model, const MotionState& motion, std::uint32_t piece,
                       std::uint32_t other, double margin) {
  const Vec2 from = model.bodies[model.piece_body[other]].centre,
             to = model.bodies[model.piece_body[piece]].centre;
  const double offset_x = to.x - from.x, offset_y = to.y - from.y;
  const std::uint32_t begin = model.piece_start[other], end = model.piece_start[other + 1];
  for (std::uint32_t side = begin; side < end; ++side) {
    const BoundaryCorner &a = motion.corners[side], &b = motion.corners[side + 1 == end ? begin : side + 1];
    const double along_x = b.x - a.x, along_y = b.y - a.y;
    const double limit = margin * std::sqrt(along_x * along_x + along_y * along_y);
    bool beyond = limit > 0;
    for (std::uint32_t c = model.piece_start[piece]; beyond && c < model.piece_start[piece + 1]; ++c) {
      const double x = motion.corners[c].x + offset_x - a.x, y = motion.corners[c].y + offset_y - a.y;
      beyond = along_y * x - along_x * y > limit;
    }
    if (beyond) return true;
  }
  return false;
}

NeighbourSearch::NeighbourSearch(const Model& model) : boxes_(model.piece_body.size()) {
  origin_ = model.bodies.empty() ? Vec2{} : model.bodies[0].centre;
  std::vector<double> sizes;
  for (std::size_t p = 0; p < model.piece_body.size(); ++p) {
    if (!model.moves(model.piece_body[p])) continue;
    double squared = 0;
    for (std::uint32_t c = model.piece_start[p]; c < model.piece_start[p + 1]; ++c) {
      const double dx = model.reference_x[c] - model.reference_x[model.piece_start[p]];
      const double dy = model.reference_y[c] - model.reference_y[model.piece_start[p]];
      squared = std::max(squared, dx * dx + dy * dy);
    }
    sizes.push_back(std::sqrt(squared));
  }
  if (sizes.empty()) return;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  cell_ = 1.5 * sizes[sizes.size() / 2];
}

void NeighbourSearch::measure_boxes(const Model& model, const MotionState& motion, double skin) {
  for (std::size_t p = 0; p < boxes_.size(); ++p) {
    const Vec2 centre = model.bodies[model.piece_body[p]].centre;
    const double offset_x = centre.x - origin_.x, offset_y = centre.y - origin_.y;
    Box box{INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (std::uint32_t c = model.piece_start[p]; c < model.piece_start[p + 1]; ++c) {
      box.low_x = std::min(box.low_x, motion.corners[c].x);
      box.low_y = std::min(box.low_y, motion.corners[c].y);
      box.high_x = std::max(box.high_x, motion.corners[c].x);
      box.high_y = std::max(box.high_y, motion.corners[c].y);
    }
    boxes_[p] = {box.low_x + offset_x - skin / 2, box.low_y + offset_y - skin / 2,
                 box.high_x + offset_x + skin / 2, box.high_y + offset_y + skin / 2};
  }
}

NeighbourSearch::Cell NeighbourSearch::cell_of(double x, double y) const {
  const auto number = [&](double value) {
    return static_cast<std::int32_t>(std::clamp(std::floor(value / cell_), -last_cell, last_cell));
  };
  return {number(x), number(y)};
}

/// In the upper half. Those of 65,536 columns and rows about the middle are all different.
std::uint64_t NeighbourSearch::tag_of(const Cell& cell) {
  constexpr std::uint32_t middle = 1U << 15;
  const std::uint32_t x = static_cast<std::uint32_t>(cell.x) + middle,
                      y = static_cast<std::uint32_t>(cell.y) + middle;
  return std::uint64_t{x << 16 ^ x >> 16 ^ y} << 32;
}

/// Of the cell with the lower left corner of what the boxes of both share.
std::uint64_t NeighbourSearch::tag_of_shared_corner(std::uint32_t p, std::uint32_t q) const {
  const Box &a = boxes_[p], &b = boxes_[q];
  return tag_of(cell_of(std::max(a.low_x, b.low_x), std::max(a.low_y, b.low_y)));
}

void NeighbourSearch::fill_grid() {
  grid_.clear();
  large_.clear();
  for (std::uint32_t p = 0; p < boxes_.size(); ++p) {
    const Box& box = boxes_[p];
    if (std::max(box.high_x - box.low_x, box.high_y - box.low_y) > large_in_cells * cell_) {
      large_.push_back(p);
      continue;
    }
    const Cell low = cell_of(box.low_x, box.low_y), high = cell_of(box.high_x, box.high_y);
    for (std::int32_t x = low.x; x <= high.x; ++x) {
      for (std::int32_t y = low.y; y <= high.y; ++y) append_to(grid_, tag_of({x, y}) | p);
    }
  }
  std::sort(grid_.begin(), grid_.end());
}

/// Two strips of one body that do not hang together: of different fragments, of a cut, or of an outline that
/// may meet itself.
bool NeighbourSearch::may_meet_itself(const Model& model, std::uint32_t p, std::uint32_t q) {
  const Body& body = model.bodies[model.piece_body[p]];
  if (!body.meets_itself || p == q) return false;
  const Strip &a = model.strips[model.piece_strip[p]], &b = model.strips[model.piece_strip[q]];
  if (!body.outline_meets && a.fragment == b.fragment && !model.sides[a.side].is_cut_face &&
      !model.sides[b.side].is_cut_face)
    return false;
  return !hang_together(model, a, b.side) && !hang_together(model, b, a.side);
}

bool NeighbourSearch::meet(std::uint32_t p, std::uint32_t q) const {
  const Box &a = boxes_[p], &b = boxes_[q];
  return !(a.low_x > b.high_x || b.low_x > a.high_x || a.low_y > b.high_y || b.low_y > a.high_y);
}

/// Whether all of `p` is more than `skin` outside of a side of the large piece. Only where one of both is
/// fixed: of moving bodies those near them count for the time step, however far they are from a side.
bool NeighbourSearch::outside(const Model& model, const MotionState& motion, std::uint32_t large,
                              std::uint32_t p, double skin) {
  const std::uint32_t body = model.piece_body[large], other = model.piece_body[p];
  if ((model.moves(body) && model.moves(other)) || model.is_strip[large] != 0) return false;
  return outside_of_a_side(model, motion, p, large, skin);
}

void NeighbourSearch::offer(const Model& model, std::uint32_t p, std::uint32_t q,
                            std::vector<Candidate>& candidates) {
  const std::uint32_t body_p = model.piece_body[p], body_q = model.piece_body[q];
  if (!model.moves(body_p) && !model.moves(body_q)) return;
  if (body_p == body_q && !may_meet_itself(model, p, q)) return;
  append_to(candidates, {std::min(p, q), std::max(p, q)});  // numbers of pieces rise with those of bodies
}

void NeighbourSearch::find(const Model& model, const MotionState& motion, double skin,
                           std::vector<Candidate>& candidates) {
  candidates.clear();
  measure_boxes(model, motion, skin);
  fill_grid();
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const std::uint64_t tag = grid_[i] >> 32 << 32;
    const auto p = static_cast<std::uint32_t>(grid_[i]);
    for (std::size_t j = i + 1; j < grid_.size() && grid_[j] >> 32 << 32 == tag; ++j) {
      const auto q = static_cast<std::uint32_t>(grid_[j]);
      // Of the cells that two pieces share they are found in one.
      if (meet(p, q) && tag_of_shared_corner(p, q) == tag) offer(model, p, q, candidates);
    }
  }
  for (std::size_t i = 0; i < large_.size(); ++i) {
    for (std::uint32_t p = 0; p < boxes_.size(); ++p) {
      const bool both_large = std::binary_search(large_.begin(), large_.end(), p);
      if ((both_large && p <= large_[i]) || !meet(large_[i], p)) continue;
      if (!outside(model, motion, large_[i], p, skin)) offer(model, large_[i], p, candidates);
    }
  }
  std::sort(candidates.begin(), candidates.end(), CandidateOrder(model));
  // Where cells side by side share a tag, pieces in both are found more than once.
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
}

}  // namespace talus
