#include "targets.hpp"

#include "files/input_error.hpp"
#include "output/vtu.hpp"

namespace talus::fuzz {

namespace {

/// Data that is no array of its grid is what read_vtu_text() leaves to its callers; corners are not.
void check(const Grid& grid) {
  for (const std::int64_t corner : grid.connectivity)
    demand(corner >= 0 && 3 * static_cast<std::size_t>(corner) + 2 < grid.points.size(), "a corner nowhere");
  std::int64_t start = 0;
  for (const std::int64_t end : grid.offsets) {
    demand(end >= start && end <= static_cast<std::int64_t>(grid.connectivity.size()), "a cell nowhere");
    start = end;
  }
}

}  // namespace

void read_frame(std::string_view bytes) {
  Grid grid;
  try {
    grid = read_vtu_text(bytes);
  } catch (const InputError&) {
    return;
  }
  check(grid);
  grid.point_data.clear();  // talus writes no names that are markup
  grid.cell_data.clear();
  const Grid again = read_vtu_text(vtu_text(grid, 0));
  demand(
      again.connectivity == grid.connectivity && again.offsets == grid.offsets && again.types == grid.types,
      "a frame is not read as it was written");
}

}  // namespace talus::fuzz
