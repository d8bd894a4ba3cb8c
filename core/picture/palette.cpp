#include "picture/palette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace talus::palette {

std::string shade(double share) {
  constexpr std::array<std::array<int, 3>, 10> anchors{{{68, 1, 84},
                                                        {72, 40, 120},
                                                        {62, 74, 137},
                                                        {49, 104, 142},
                                                        {38, 130, 142},
                                                        {31, 158, 137},
                                                        {53, 183, 121},
                                                        {109, 205, 89},
                                                        {180, 222, 44},
                                                        {253, 231, 37}}};
  const double at = std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0) * (anchors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
  std::array<long, 3> mixed{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int from = anchors[below][i], to = anchors[below + 1][i];
    mixed[i] = std::lround(from + (to - from) * (at - static_cast<double>(below)));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

}  // namespace talus::palette
