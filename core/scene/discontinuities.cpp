#include "scene/discontinuities.hpp"

#include "scene/tables.hpp"

#include <fmt/format.h>

namespace talus {
namespace {

constexpr const char* points_expected = "a list of at least two points [[x, y], ...] [m]";

std::vector<Vec2> read_points(Section& section) {
  std::vector<Vec2> points;
  const Json* written = section.required_child("points", points_expected);
  if (written == nullptr) return points;
  section.resolved["points"] = *written;
  if (!written->is_array() || written->size() < 2) {
    section.mistakes().add(section.pointer_to("points"), fmt::format("{} is not allowed here: expected {}",
                                                                     shown(*written), points_expected));
    return points;
  }
  section.list("points", points_expected, [&](const Json& value, const std::string& pointer) {
    const auto taken = take_pair(table::coordinate, value, pointer, section.mistakes());
    if (!taken) return;
    const Vec2 point{(*taken)[0], (*taken)[1]};
    if (!points.empty() && points.back().x == point.x && points.back().y == point.y)
      section.mistakes().add(
          pointer, fmt::format("({}, {}) is the point before, too: a side needs a length", point.x, point.y));
    points.push_back(point);
  });
  return points;
}

}  // namespace

std::string read_line_surface(Section& section) {
  const Json* written = section.child("surface");
  if (written == nullptr) return {};
  std::string name = section.text("surface", "a name for its faces");
  if (written->is_string() && !check_name(name, section.pointer_to("surface"), section.mistakes())) return {};
  return name;
}

std::vector<Discontinuity> read_polylines(Section& section, const std::string& key,
                                          std::vector<std::string>& surfaces) {
  std::vector<Discontinuity> all;
  OrderedJson resolved = OrderedJson::array();
  section.list(key, "a list of polylines [{\"points\": [[x, y], ...], \"surface\": ...}]",
               [&](const Json& value, const std::string& pointer) {
                 Section line(&value, pointer, section.mistakes());
                 all.push_back({read_points(line), 0});
                 surfaces.push_back(read_line_surface(line));
                 line.finish();
                 resolved.push_back(line.resolved);
               });
  if (!all.empty()) section.resolved[key] = std::move(resolved);
  return all;
}

std::vector<Discontinuity> read_discontinuities(Section& body, std::vector<std::string>& surfaces) {
  return read_polylines(body, "discontinuities", surfaces);
}

}  // namespace talus
