#include "cells.hpp"

#include <compare>

namespace talus::hexagonal {
namespace {

/// Where the outline crosses the middle of a row: to the right of it, it winds `turns` more times around.
struct Passage {
  Cell cell;
  int turns;
};

std::vector<Passage> passages(std::span<const OutlinePiece> outline) {
  std::vector<Passage> result;
  for (OutlinePiece piece : outline) {
    const int turns = piece.p.b > piece.q.b ? 1 : -1;
    if (turns > 0) std::swap(piece.p, piece.q);
    const auto [p, q] = piece;
    // Rows whose middle m holds p.b <= m < q.b.
    const auto first_row = [](std::int64_t b) { return cell_index(b + unit / 2 - 1); };
    for (std::int32_t j = first_row(p.b); j < first_row(q.b); ++j) {
      const std::int64_t middle = j * unit + unit / 2;
      const double share = static_cast<double>(middle - p.b) / static_cast<double>(q.b - p.b);
      const auto a = p.a + static_cast<std::int64_t>(share * static_cast<double>(q.a - p.a));
      result.push_back({{j, cell_index(a)}, turns});
    }
  }
  std::sort(result.begin(), result.end(), [](const Passage& m, const Passage& n) { return m.cell < n.cell; });
  return result;
}

}  // namespace

std::uint32_t NeededCells::find(Cell cell) const {
  const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
  return found != cells.end() && *found == cell ? static_cast<std::uint32_t>(found - cells.begin()) : none;
}

bool NeededCells::is_touched(Cell cell) const {
  const std::uint32_t found = find(cell);
  return found != none && touched[found] == 1;
}

NeededCells needed_cells(std::span<const Cell> touched, std::span<const OutlinePiece> outline) {
  const std::vector<Passage> crossed = passages(outline);
  NeededCells result;
  std::size_t passage = 0;
  int winding = 0;
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const Cell cell = touched[k];
    result.cells.push_back(cell);
    result.touched.push_back(1);
    const bool row_ends = k + 1 == touched.size() || touched[k + 1].j != cell.j;
    for (; passage < crossed.size() && crossed[passage].cell <= cell; ++passage) {
      winding += crossed[passage].turns;
    }
    if (row_ends) {
      winding = 0;
      continue;
    }
    if (winding <= 0) continue;
    for (std::int32_t i = cell.i + 1; i < touched[k + 1].i; ++i) {
      result.cells.push_back({cell.j, i});
      result.touched.push_back(0);
    }
  }
  return result;
}

LatticeSides lattice_sides(const NeededCells& needed) {
  LatticeSides result;
  for (std::uint32_t k = 0; k < needed.cells.size(); ++k) {
    const auto [j, i] = needed.cells[k];
    const bool touched = needed.touched[k] == 1;
    const auto add = [&](std::int32_t column, std::int32_t row, std::uint8_t direction, bool near) {
      (near ? result.near_curves : result.clear).push_back({column, row, direction});
    };
    add(i, j, 0, touched || needed.is_touched({j - 1, i}));
    add(i, j, 1, touched || needed.is_touched({j, i - 1}));
    add(i, j, 2, touched);
    if (needed.find({j + 1, i}) == NeededCells::none) add(i, j + 1, 0, touched);
    if (needed.find({j, i + 1}) == NeededCells::none) add(i + 1, j, 1, touched);
  }
  return result;
}

}  // namespace talus::hexagonal
