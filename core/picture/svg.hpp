#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A point of a drawing, in its units; y points down.
struct Spot {
  double x, y;
};

struct Stroke {
  std::string_view colour = "none";
  double width = 1;
  std::string_view dashes = "";  ///< as in stroke-dasharray
};

/// A drawing as text. Words are set in the reader's sans-serif; colours are those of CSS.
class Svg {
 public:
  Svg(double width, double height, std::string_view title);

  enum class Anchor { start, middle, end };

  /// `words` are what a browser shows where the pointer rests on it.
  void polygon(const std::vector<std::vector<Spot>>& rings, std::string_view fill, const Stroke& stroke,
               double opacity = 1, std::string_view words = "");
  void line(const std::vector<Spot>& points, const Stroke& stroke);
  void arrow(Spot from, Spot to, const Stroke& stroke);
  /// `words` as of polygon().
  void circle(Spot centre, double radius, std::string_view fill, const Stroke& stroke = {},
              std::string_view words = "");
  void text(Spot at, std::string_view words, Anchor anchor, std::string_view colour = "#16202a",
            double size = 12, double turned = 0);

  std::string done() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace talus
