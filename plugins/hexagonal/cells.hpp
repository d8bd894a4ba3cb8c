#pragma once

#include "lattice.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace talus::hexagonal {

/// What lies this close to a cell is looked at in that cell, too, grid steps: more than anything moves.
inline constexpr std::int64_t cell_margin = 512;

/// Calls visit(cell) for each cell that the segment passes through or by, row after row.
template <class Visit>
void visit_cells(GridPoint p, GridPoint q, Visit&& visit) {
  if (p.b > q.b) std::swap(p, q);
  const auto column_at = [&](std::int64_t b) {
    if (b <= p.b) return p.a;
    if (b >= q.b) return q.a;
    const double share = static_cast<double>(b - p.b) / static_cast<double>(q.b - p.b);
    return p.a + static_cast<std::int64_t>(share * static_cast<double>(q.a - p.a));
  };
  const std::int32_t last_row = cell_index(q.b + cell_margin);
  for (std::int32_t j = cell_index(p.b - cell_margin); j <= last_row; ++j) {
    std::int64_t left = p.a, right = q.a;
    if (p.b != q.b) {
      left = column_at(j * unit - cell_margin);
      right = column_at((j + std::int64_t{1}) * unit + cell_margin);
    }
    if (left > right) std::swap(left, right);
    const std::int32_t last = cell_index(right + cell_margin);
    for (std::int32_t i = cell_index(left - cell_margin); i <= last; ++i) visit(Cell{j, i});
  }
}

/// A directed piece of the outline, the body on its left.
struct OutlinePiece {
  GridPoint p, q;
};

/// Sorted cells that are needed: those touched by curves, and those in the body.
struct NeededCells {
  std::vector<Cell> cells;
  std::vector<std::uint8_t> touched;  ///< [cell] 1 or 0

  /// Position of a cell in `cells`, or none.
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  std::uint32_t find(Cell cell) const;
  bool is_touched(Cell cell) const;
};

/// `touched`, sorted, are the cells of all curves; cells between them are in the body where the outline winds
/// around them.
NeededCells needed_cells(std::span<const Cell> touched, std::span<const OutlinePiece> outline);

/// All sides of the triangles of these cells, each once, in the order of the cells.
struct LatticeSides {
  std::vector<LatticeSide> near_curves, clear;
};
LatticeSides lattice_sides(const NeededCells& needed);

}  // namespace talus::hexagonal
