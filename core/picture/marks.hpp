#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A point of a chart of marks.
struct Mark {
  double x = 0, y = 0;      ///< both above 0, or it is left out
  std::string label;        ///< stands beside it where there is room; "" for none
  std::string words;        ///< what a browser shows where the pointer rests on it; "" for none
  std::string_view colour;  ///< of its disc
};

/// A line from mark to mark.
struct MarkLine {
  std::vector<std::size_t> marks;
  std::string_view colour;
  std::string_view dashes = "";  ///< as in stroke-dasharray
  std::string label = {};        ///< in the legend; "" for none
};

/// Marks over two axes by powers of ten, as an SVG of 720 by 400.
std::string marks_svg(const std::string& title, const std::string& x_label, const std::string& y_label,
                      const std::vector<Mark>& marks, const std::vector<MarkLine>& lines);

/// Powers of ten within a range above 0, and where those are few 2 and 5 times them, or more.
std::vector<double> power_ticks(double low, double high);

}  // namespace talus
