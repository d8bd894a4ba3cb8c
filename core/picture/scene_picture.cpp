#include "picture/scene_picture.hpp"

#include "geometry/geos.hpp"
#include "geometry/outlines.hpp"
#include "picture/palette.hpp"
#include "picture/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace talus {
namespace {

constexpr double picture_width = 1000, legend_line = 20;
constexpr double arrow_length = 46;
constexpr std::size_t most_names = 40;  ///< of bodies that move; more would hide the bodies
constexpr std::string_view load_colour = "#b3261e", motion_colour = "#6741d9";
constexpr std::string_view body_colours[] = {"#f1e3cb", "#dbe7d3", "#d6e4f0",
                                             "#efdbe4", "#e9e6c8", "#dcdcf0"};

struct Picture {
  const Simulation& simulation;
  const Scene& scene;
  SectionView view;
  Svg svg;
  std::map<std::string, std::string> legend;  ///< words, colour

  /// In units of the picture.
  Spot size_of_body(std::size_t body) const {
    Spot low{1e300, 1e300}, high{-1e300, -1e300};
    for (const Vec2 vertex : scene.bodies[body].outer.vertices) {
      low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
      high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
    }
    return {(high.x - low.x) * view.units_per_metre(), (high.y - low.y) * view.units_per_metre()};
  }
};

std::vector<Vec2> all_vertices(const Scene& scene) {
  std::vector<Vec2> points;
  for (const SceneBody& body : scene.bodies)
    points.insert(points.end(), body.outer.vertices.begin(), body.outer.vertices.end());
  return points;
}

Vec2 middle_of(const std::vector<Vec2>& points) {
  Vec2 sum;
  for (const Vec2 point : points) sum = {sum.x + point.x, sum.y + point.y};
  const auto count = static_cast<double>(std::max<std::size_t>(points.size(), 1));
  return {sum.x / count, sum.y / count};
}

/// Somewhere within a body, in its middle if that is within.
Vec2 place_within(const SceneBody& body) {
  const std::vector<Vec2>& ring = body.outer.vertices;
  const Loops loops = loops_of(body);
  const Vec2 middle = middle_of(ring);
  if (contains(loops, middle, 0)) return middle;
  Vec2 best = middle;
  double largest = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 p = ring[i], q = ring[(i + 1) % ring.size()], r = ring[(i + 2) % ring.size()];
    const double area = std::abs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
    const Vec2 at = middle_of({p, q, r});
    if (area > largest && contains(loops, at, 0)) best = at, largest = area;
  }
  return largest > 0 ? best : Geos().point_within(loops);
}

void draw_body(Picture& picture, std::size_t index) {
  const SceneBody& body = picture.scene.bodies[index];
  std::vector<std::vector<Spot>> rings;
  each_loop(body, [&](const Loop& loop) { rings.push_back(picture.view.ring(loop.vertices)); });
  const std::string_view fill =
      body.fixed ? palette::fixed : body_colours[body.material % std::size(body_colours)];
  if (!body.fixed) picture.legend[picture.scene.materials[body.material].name] = fill;
  picture.svg.polygon(rings, fill, {palette::edge, body.fixed ? 0.8 : 1.0}, 1, body.name);
}

/// Elements, where there are several.
void draw_cover(Picture& picture, std::size_t index) {
  const std::vector<BodyPart> parts = picture.simulation.parts(index);
  if (parts.size() < 2) return;
  for (const BodyPart& part : parts) {
    for (const std::vector<PartPoint>& loop : part.loops) {
      std::vector<Vec2> points;
      for (const PartPoint& point : loop) points.push_back(point.position);
      picture.svg.polygon({picture.view.ring(points)}, "none", {palette::faint, 0.35});
    }
  }
}

std::string surface_colour(const Picture& picture, std::uint32_t surface_class) {
  return std::string(palette::lines[surface_class % std::size(palette::lines)]) +
         (picture.scene.surfaces.size() > std::size(palette::lines) ? "cc" : "");
}

/// Sides that have a name, and those a body is cut along.
void draw_surfaces(Picture& picture, std::size_t index) {
  const SceneBody& body = picture.scene.bodies[index];
  const auto draw = [&](const std::vector<Vec2>& line, std::uint32_t surface_class, std::string_view dashes) {
    const SurfaceClass& surface = picture.scene.surfaces[surface_class];
    if (surface.surface.empty() && dashes.empty()) return;
    const std::string colour =
        surface.surface.empty() ? std::string(palette::ink) : surface_colour(picture, surface_class);
    picture.svg.line(picture.view.ring(line), {colour, 2.4, dashes});
    if (!surface.surface.empty()) picture.legend["surface " + surface.surface] = colour;
  };
  each_loop(body, [&](const Loop& loop) {
    for (std::size_t i = 0; i < loop.vertices.size(); ++i)
      draw({loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]}, loop.surface_class[i], "");
  });
  for (const Discontinuity& cut : body.discontinuities) draw(cut.points, cut.surface_class, "6 3");
}

/// Wheels where a direction is held or driven.
void draw_support(Picture& picture, std::size_t index) {
  const SceneBody& body = picture.scene.bodies[index];
  const Support& support = body.support;
  const Spot at = picture.view.at(middle_of(body.outer.vertices));
  const auto mark = [&](const std::optional<double>& value, Spot along) {
    if (!value) return;
    const Spot to{at.x + along.x * 16, at.y + along.y * 16};
    if (*value != 0) {
      const double sign = *value > 0 ? 1 : -1;
      picture.svg.arrow(at, {at.x + sign * along.x * arrow_length, at.y + sign * along.y * arrow_length},
                        {motion_colour, 2});
      picture.legend["driven"] = motion_colour;
      return;
    }
    picture.svg.line({{at.x - along.x * 16, at.y - along.y * 16}, to}, {palette::ink, 2.5});
    picture.legend["held along the bar"] = palette::ink;
  };
  mark(support.x, {1, 0});
  mark(support.y, {0, -1});
  if (support.rotation) {
    picture.svg.circle(at, 9, "none", {palette::ink, 2});
    picture.legend["rotation held"] = palette::ink;
  }
}

void draw_velocity(Picture& picture, std::size_t index, double fastest) {
  const SceneBody& body = picture.scene.bodies[index];
  const double speed = std::hypot(body.velocity.x, body.velocity.y);
  if (!(speed > 0)) return;
  const Spot at = picture.view.at(middle_of(body.outer.vertices));
  const double length = arrow_length * speed / fastest / speed;
  picture.svg.arrow(at, {at.x + body.velocity.x * length, at.y - body.velocity.y * length},
                    {motion_colour, 2});
  picture.legend[fmt::format("velocity, the longest {:.3g} m/s", fastest)] = motion_colour;
}

/// At the time when they are largest of some.
Vec2 typical(const VectorFunction& function, Vec2 at, double end) {
  Vec2 largest;
  for (int i = 0; i <= 20; ++i) {
    const double time = end * i / 20;
    const Vec2 now{function[0](time, at), function[1](time, at)};
    if (std::hypot(now.x, now.y) > std::hypot(largest.x, largest.y)) largest = now;
  }
  return largest;
}

/// As long as its share of the `largest` says.
void draw_arrow_to(Picture& picture, Vec2 point, Vec2 direction, double largest, const std::string& words) {
  const double size = std::hypot(direction.x, direction.y);
  if (!(size > 0.05 * largest)) return;
  const double scale = arrow_length / largest;
  const Spot to = picture.view.at(point);
  picture.svg.arrow({to.x - direction.x * scale, to.y + direction.y * scale}, to, {load_colour, 2});
  picture.legend[words] = load_colour;
}

template <class Draw>
void each_side(const Scene& scene, std::uint32_t body, std::uint32_t surface_class, const Draw& draw) {
  const Loop& loop = scene.bodies[body].outer;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    if (loop.surface_class[i] != surface_class) continue;
    const Vec2 p = loop.vertices[i], q = loop.vertices[(i + 1) % loop.vertices.size()];
    draw(p, q);
  }
}

/// Three arrows along each side, by what acts at their points.
void draw_surface_loads(Picture& picture) {
  const Scene& scene = picture.scene;
  struct Pull {
    Vec2 at, size;  ///< m, Pa
  };
  std::vector<Pull> pulls;
  double largest = 0;
  for (const SurfaceLoad& load : scene.surface_loads) {
    each_side(scene, load.body, load.surface_class, [&](Vec2 p, Vec2 q) {
      const double length = std::hypot(q.x - p.x, q.y - p.y);
      for (const double lever : {0.2, 0.5, 0.8}) {
        const Vec2 at{p.x + lever * (q.x - p.x), p.y + lever * (q.y - p.y)};
        const double pressure = load.pressure(scene.time.end, at);
        Vec2 size = typical(load.traction, at, scene.time.end);
        size.x -= pressure * (q.y - p.y) / length;
        size.y += pressure * (q.x - p.x) / length;
        pulls.push_back({at, size});
        largest = std::max(largest, std::hypot(size.x, size.y));
      }
    });
  }
  const std::string words = fmt::format("traction, pressure, the longest {:.3g} Pa", largest);
  for (const Pull& pull : pulls) draw_arrow_to(picture, pull.at, pull.size, largest, words);
}

void draw_loads(Picture& picture) {
  const Scene& scene = picture.scene;
  for (const PointLoad& load : scene.loads) {
    const Vec2 force = typical(load.force, load.point, scene.time.end);
    draw_arrow_to(picture, load.point, force, std::hypot(force.x, force.y), "load");
  }
  draw_surface_loads(picture);
  const auto rim = [&](std::uint32_t body, std::uint32_t surface_class, const char* words,
                       std::string_view colour) {
    each_side(scene, body, surface_class, [&](Vec2 p, Vec2 q) {
      picture.svg.line(picture.view.ring({p, q}), {colour, 6, "2 3"});
      picture.legend[words] = colour;
    });
  };
  for (const PrescribedSurface& prescribed : scene.prescribed)
    rim(prescribed.body, prescribed.surface_class, "prescribed motion", motion_colour);
  for (const AbsorbingSurface& absorbing : scene.absorbing)
    rim(absorbing.body, absorbing.surface_class, "absorbing", "#0b7285");
}

void draw_names(Picture& picture) {
  constexpr double letter = 6.6;
  const bool many = picture.scene.bodies.size() > most_names;
  const auto is_monitor = [&](const std::string& name) {
    return std::any_of(picture.scene.monitors.begin(), picture.scene.monitors.end(),
                       [&](const Monitor& monitor) { return monitor.name == name; });
  };
  for (std::size_t i = 0; i < picture.scene.bodies.size(); ++i) {
    const SceneBody& body = picture.scene.bodies[i];
    const Spot size = picture.size_of_body(i);
    if (letter * static_cast<double>(body.name.size()) > size.x || size.y < 12) continue;
    if ((many && !body.fixed) || is_monitor(body.name)) continue;
    const Spot at = picture.view.at(place_within(body));
    const double above = size.y < 48 ? -4 : 12;  // patches and marks stand in the middle of large ones
    picture.svg.text({at.x, at.y - above}, body.name, Svg::Anchor::middle, palette::ink, 11);
  }
  for (const Monitor& monitor : picture.scene.monitors) {
    const Spot at = picture.view.at(picture.simulation.body_motion(monitor.body).position);
    const Spot place = monitor.point ? picture.view.at(*monitor.point) : at;
    picture.svg.circle(place, 4, "#ffffff", {palette::ink, 1.6});
    picture.svg.text({place.x + 7, place.y + 4}, monitor.name, Svg::Anchor::start, palette::ink, 11);
  }
}

void draw_gravity(Picture& picture) {
  const Vec2 pull = picture.scene.gravity;
  const double size = std::hypot(pull.x, pull.y);
  if (!(size > 0)) return;
  const Spot from{picture_width - 60, 22};
  picture.svg.arrow(from, {from.x + pull.x / size * 34, from.y - pull.y / size * 34}, {palette::ink, 2});
  picture.svg.text({from.x - 8, from.y + 12}, fmt::format("g = {:.4g} m/s²", size), Svg::Anchor::end);
}

void draw_legend(Picture& picture, double y) {
  double x = 14;
  for (const auto& [words, colour] : picture.legend) {
    const double wide = 34 + 7.0 * static_cast<double>(words.size());
    if (x + wide > picture_width) x = 14, y += legend_line;
    picture.svg.polygon({{{x, y - 10}, {x + 14, y - 10}, {x + 14, y + 2}, {x, y + 2}}}, colour,
                        {palette::edge, 0.5});
    picture.svg.text({x + 20, y}, words, Svg::Anchor::start);
    x += wide;
  }
}

}  // namespace

std::string scene_svg(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const SectionView view(all_vertices(scene), picture_width);
  Picture picture{
      simulation,
      scene,
      view,
      Svg(picture_width, view.height() + 3 * legend_line, scene.title.empty() ? scene.file : scene.title),
      {}};
  double fastest = 0;
  for (const SceneBody& body : scene.bodies)
    fastest = std::max(fastest, std::hypot(body.velocity.x, body.velocity.y));
  for (const bool fixed : {true, false}) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].fixed == fixed) draw_body(picture, i);
    }
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    draw_cover(picture, i);
    draw_surfaces(picture, i);
    draw_support(picture, i);
    draw_velocity(picture, i, fastest);
  }
  draw_loads(picture);
  draw_names(picture);
  view.draw_scale(picture.svg);
  draw_gravity(picture);
  draw_legend(picture, view.height() + legend_line);
  return picture.svg.done();
}

}  // namespace talus
