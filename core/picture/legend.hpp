#pragma once

#include "picture/svg.hpp"

#include <string>
#include <vector>

namespace talus {

struct LegendEntry {
  std::string label;
  std::string colour;
  std::string dashes;  ///< of its line, empty: solid
};

/// Samples of lines with their names below a picture: as many in a row as there is room for.
class Legend {
 public:
  static constexpr double row = 18,
                          below = 14;  ///< height of a row; from the last to the edge of the picture

  Legend(std::vector<LegendEntry> entries, double begin, double end, double first_row);

  double height() const { return height_; }  ///< of a picture that holds it
  void draw(Svg& svg) const;

 private:
  std::vector<LegendEntry> entries_;
  std::vector<Spot> places_;  ///< where a sample begins
  double height_;
};

}  // namespace talus
