#include "safety/mechanism.hpp"

#include "picture/palette.hpp"
#include "picture/section.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

constexpr double picture_width = 1000, legend_height = 30;
constexpr double longest_arrow = 60, least_arrow = 6;
constexpr std::string_view arrow_colour = "#b3261e";

/// Where the arrow of a part begins, and how far the part came.
struct Middle {
  Vec2 at, moved;
};

Middle middle_of(const MovedPart& part) {
  Middle middle;
  const auto count = static_cast<double>(part.loops.front().size());
  for (const MovedPart::Point& point : part.loops.front()) {
    middle.at += point.from / count;
    middle.moved += point.moved / count;
  }
  return middle;
}

double farthest_of(const MovedPart& part) {
  double most = 0;
  for (const auto& loop : part.loops) {
    for (const MovedPart::Point& point : loop) most = std::max(most, size_of(point.moved));
  }
  return most;
}

void draw_part(const Scene& scene, const SectionView& view, const MovedPart& part, double share, Svg& svg) {
  std::vector<std::vector<Spot>> rings;
  for (const auto& loop : part.loops) {
    std::vector<Vec2> ring;
    for (const MovedPart::Point& point : loop) ring.push_back(point.from);
    rings.push_back(view.ring(ring));
  }
  const SceneBody& body = scene.bodies[part.body];
  const std::string fill = body.fixed ? std::string(palette::fixed) : palette::shade(share);
  svg.polygon(rings, fill, {palette::edge, 0.5}, 1, body.name);
}

void draw_arrow(const SectionView& view, const MovedPart& part, double farthest, Svg& svg) {
  const Middle middle = middle_of(part);
  const double scale = longest_arrow / farthest;
  if (size_of(middle.moved) * scale < least_arrow) return;
  const Spot from = view.at(middle.at);
  svg.arrow(from, {from.x + middle.moved.x * scale, from.y - middle.moved.y * scale}, {arrow_colour, 1.6});
}

}  // namespace

std::string mechanism_svg(const Scene& scene, const Safety& safety) {
  if (!safety.falls) return "";
  const ReducedRun& run = *std::ranges::find(safety.runs, *safety.falls, &ReducedRun::factor);
  if (run.parts.empty()) return "";
  std::vector<Vec2> shown;
  double farthest = 0;
  for (const MovedPart& part : run.parts) {
    farthest = std::max(farthest, farthest_of(part));
    for (const auto& loop : part.loops) {
      for (const MovedPart::Point& point : loop) shown.push_back(point.from);
    }
  }
  const SectionView view(shown, picture_width);
  const std::string title = fmt::format("collapse at a factor of {:.4g}", run.factor);
  Svg svg(picture_width, view.height() + legend_height, title);
  for (const MovedPart& part : run.parts)
    draw_part(scene, view, part, farthest > 0 ? farthest_of(part) / farthest : 0, svg);
  for (const MovedPart& part : run.parts) {
    if (farthest > 0) draw_arrow(view, part, farthest, svg);
  }
  view.draw_scale(svg);
  svg.text({picture_width / 2, view.height() + 14},
           fmt::format("{}: up to {:.4g} m (yellow) in {:.4g} s, which arrows show {:.3g} times as long",
                       title, farthest, run.lasted, longest_arrow / farthest / view.units_per_metre()),
           Svg::Anchor::middle);
  return svg.done();
}

}  // namespace talus
