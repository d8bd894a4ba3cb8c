#pragma once

#include <filesystem>
#include <vector>

namespace talus {

/// Draws what a folder of a run or a comparison holds into its `figures`: one SVG for each quantity of the
/// monitors, the energies and the contact forces of each run, and the first and last state of each. Returns
/// the files. Throws InputError where there are no results.
std::vector<std::filesystem::path> write_figures(const std::filesystem::path& folder);

}  // namespace talus
