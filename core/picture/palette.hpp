#pragma once

#include <string>
#include <string_view>

namespace talus::palette {

/// Colours of runs and of kinds of things, told apart by those who see few colours, too.
inline constexpr std::string_view lines[] = {"#0b6bcb", "#d9480f", "#2b8a3e",
                                             "#862e9c", "#a07800", "#0b7285"};
inline constexpr std::string_view ink = "#16202a", faint = "#5a6773", grid = "#d9e0e6", fixed = "#d5dde4",
                                  edge = "#3c4a58";

/// The colour of a share from 0 to 1, dark to light (viridis).
std::string shade(double share);

}  // namespace talus::palette
