#pragma once

#include "output/vtu.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// A frame that frames.pvd lists.
struct ListedFrame {
  double time;  ///< s
  std::filesystem::path bodies, contacts;
};

/// Those of a folder of results, in their order; none if it has no frames.
std::vector<ListedFrame> listed_frames(const std::filesystem::path& folder);

/// One of their files. Throws InputError that names it.
Grid read_grid(const std::filesystem::path& file);

/// An array that each frame has. Throws InputError if this one has not.
const std::vector<double>& reals_of(const std::vector<GridArray>& arrays, const char* name);
const std::vector<std::int32_t>& integers_of(const std::vector<GridArray>& arrays, const char* name);

/// What contacts add up to in one frame.
struct ContactSums {
  std::size_t count = 0, slipping = 0;
  double normal = 0, tangential = 0;  ///< N/m, sums of magnitudes
};
ContactSums contact_sums(const Grid& contacts);

}  // namespace talus
