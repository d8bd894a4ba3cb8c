#include "picture/svg.hpp"

#include "text/escaped.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus {
namespace {

std::string stroke_text(const Stroke& stroke) {
  if (stroke.colour == "none") return "";
  std::string text = fmt::format(" stroke=\"{}\" stroke-width=\"{:.3g}\"", stroke.colour, stroke.width);
  if (!stroke.dashes.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", stroke.dashes);
  return text;
}

/// Hundredths of a unit are finer than any printer.
void append_points(std::string& text, const std::vector<Spot>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", points[i].x, points[i].y);
}

}  // namespace

Svg::Svg(double width, double height, std::string_view title) {
  text_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.6g} {1:.6g}\" width=\"{0:.6g}\" "
      "height=\"{1:.6g}\" "
      "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, escaped(title));
}

void Svg::polygon(const std::vector<std::vector<Spot>>& rings, std::string_view fill, const Stroke& stroke,
                  double opacity, std::string_view words) {
  text_ += "<path d=\"";
  for (const std::vector<Spot>& ring : rings) {
    append_points(text_, ring);
    text_ += 'Z';
  }
  text_ += fmt::format("\" fill=\"{}\" fill-rule=\"evenodd\" stroke-linejoin=\"round\"{}", fill,
                       stroke_text(stroke));
  if (opacity < 1) text_ += fmt::format(" fill-opacity=\"{:.3g}\"", opacity);
  text_ += words.empty() ? std::string("/>\n") : fmt::format("><title>{}</title></path>\n", escaped(words));
}

void Svg::line(const std::vector<Spot>& points, const Stroke& stroke) {
  if (points.empty()) return;
  text_ += "<path d=\"";
  append_points(text_, points);
  text_ += fmt::format("\" fill=\"none\" stroke-linejoin=\"round\"{}/>\n", stroke_text(stroke));
}

void Svg::arrow(Spot from, Spot to, const Stroke& stroke) {
  constexpr double head = 8;
  const double x = to.x - from.x, y = to.y - from.y, length = std::hypot(x, y);
  if (length == 0) return;
  const Spot along{x / length * head, y / length * head};
  line({from, to}, stroke);
  polygon({{to,
            {to.x - along.x - along.y / 2.5, to.y - along.y + along.x / 2.5},
            {to.x - along.x + along.y / 2.5, to.y - along.y - along.x / 2.5}}},
          stroke.colour, {});
}

void Svg::circle(Spot centre, double radius, std::string_view fill, const Stroke& stroke,
                 std::string_view words) {
  text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.3g}\" fill=\"{}\"{}", centre.x, centre.y,
                       radius, fill, stroke_text(stroke));
  text_ += words.empty() ? std::string("/>\n") : fmt::format("><title>{}</title></circle>\n", escaped(words));
}

void Svg::text(Spot at, std::string_view words, Anchor anchor, std::string_view colour, double size,
               double turned) {
  const char* anchors[] = {"start", "middle", "end"};
  text_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.3g}\" fill=\"{}\" text-anchor=\"{}\"",
                       at.x, at.y, size, colour, anchors[static_cast<int>(anchor)]);
  if (turned != 0) text_ += fmt::format(" transform=\"rotate({:.4g} {:.2f} {:.2f})\"", turned, at.x, at.y);
  text_ += fmt::format(">{}</text>\n", escaped(words));
}

}  // namespace talus
