#include "safety/collapse.hpp"

#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr double seen = 1e-3;      ///< share of the size
constexpr double plain = 0.01;     ///< share of the size, while there is time: what swings may come less far
constexpr double lost = 0.05;      ///< share of the size: whatever stops further on has failed, too
constexpr double steady = 0.45;    ///< of the way, in the second half of the time: one half at constant speed
constexpr double kept = 0.9;       ///< of the speed in the middle, at the end
constexpr double all_kept = 0.99;  ///< of it, while there is time: what relaxes slowly loses more
constexpr double slowing = 0.25;   ///< of the way, and of that speed: slower, but not at rest
constexpr double crawling = 0.8;   ///< of the way that the speed at the end would make in the second half
constexpr double swung = 0.98;     ///< of the farthest: what is nearer came back
constexpr double crept = 1e-3;     ///< of the way: less is the last of what an elastic body has to give

/// Along x and y; turning a body drives its vertices along both.
std::array<bool, 2> driven_axes(const Scene& scene, std::size_t body) {
  const Support& support = scene.bodies[body].support;
  const auto drives = [](const std::optional<double>& velocity) { return velocity && *velocity != 0; };
  std::array<bool, 2> driven{drives(support.x), drives(support.y)};
  if (drives(support.rotation)) driven = {true, true};
  for (const PrescribedSurface& surface : scene.prescribed) {
    if (surface.body != body) continue;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto moves = [](const std::optional<Function>& way) { return way && !way->zero(); };
      if (moves(surface.displacement[axis]) || moves(surface.velocity[axis])) driven[axis] = true;
    }
  }
  return driven;
}

template <class Each>
void over_vertices(const Simulation& simulation, std::size_t body, const Each& each) {
  const std::vector<BodyPart> parts = simulation.parts(body);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const std::vector<PartPoint>& loop : parts[p].loops) {
      for (const PartPoint& point : loop) each(p, point);
    }
  }
}

}  // namespace

bool is_driven(const Scene& scene, std::size_t body) {
  const auto [x, y] = driven_axes(scene, body);
  return x || y;
}

Pieces::Pieces(const Simulation& settled) {
  const Scene& scene = settled.scene();
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    if (scene.bodies[body].fixed) continue;
    const std::array<bool, 2> driven = driven_axes(scene, body);
    if (driven[0] && driven[1]) continue;
    bodies_.push_back(body);
    const std::vector<std::uint32_t> fragment = settled.fragments(body);
    const std::size_t first = pieces_.size();
    std::vector<Ring> points(std::ranges::max(fragment) + std::size_t{1});
    over_vertices(settled, body, [&](std::size_t part, const PartPoint& point) {
      vertices_.push_back({first + fragment[part], point.position});
      points[fragment[part]].push_back(point.position);
    });
    for (const Ring& ring : points)
      pieces_.push_back({body,
                         smallest_width(ring),
                         std::min(smallest_width(ring), settled.body_width(body)),
                         {!driven[0], !driven[1]}});
  }
}

std::vector<Vec2> Pieces::places(const Simulation& simulation) const {
  std::vector<Vec2> places;
  for (const std::size_t body : bodies_) {
    over_vertices(simulation, body,
                  [&](std::size_t, const PartPoint& point) { places.push_back(point.position); });
  }
  return places;
}

PieceMotions Pieces::motions(const Simulation& simulation, const std::vector<Vec2>& began) const {
  const std::vector<double> none(pieces_.size());
  PieceMotions motions{none, none, none, {}, simulation.time()};
  std::size_t vertex = 0;
  for (const std::size_t body : bodies_) {
    over_vertices(simulation, body, [&](std::size_t, const PartPoint& point) {
      const auto& [piece, from] = vertices_[vertex];
      const std::array<bool, 2>& counts = pieces_[piece].counts;
      const auto grow = [&](double& largest, Vec2 p) {
        largest = std::max(largest, std::hypot(counts[0] ? p.x : 0, counts[1] ? p.y : 0));
      };
      grow(motions.moved[piece], point.position - from);
      grow(motions.way[piece], point.position - began[vertex++]);
      grow(motions.speed[piece], point.velocity);
    });
  }
  motions.farthest = motions.way;
  return motions;
}

Course Pieces::course(std::size_t piece, const PieceMotions& middle, const PieceMotions& end,
                      bool last) const {
  const double way = end.way[piece], lately = way - middle.way[piece], size = pieces_[piece].size;
  const bool far = way > seen * size, keeps_speed = end.speed[piece] > kept * middle.speed[piece];
  if (end.moved[piece] > lost * size)
    return lately > 1e-3 * end.moved[piece] ? Course::failed : Course::stopped;
  const bool swings = way < swung * end.farthest[piece];
  const bool sure = way > plain * size && end.speed[piece] > all_kept * middle.speed[piece];
  const bool steadily = !swings && (last || sure);
  if (keeps_speed && lately > steady * way) return far && steadily ? Course::failed : Course::goes_on;
  // At a constant speed, after it gave way by more than that when its strength was cut.
  const bool crawls = lately > crept * way && lately > crawling * end.speed[piece] * (end.time - middle.time);
  if (keeps_speed && crawls) return lately > seen * size && steadily ? Course::failed : Course::goes_on;
  // It may come to rest, or slide on at a lower speed than that with which it was let go.
  const bool slows = far && lately > slowing * way && end.speed[piece] > slowing * middle.speed[piece];
  return slows ? Course::goes_on : Course::rests;
}

std::vector<std::size_t> Pieces::gone(const PieceMotions& motions) const {
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const std::size_t body = pieces_[i].body;
    if (motions.moved[i] > lost * pieces_[i].width && (bodies.empty() || bodies.back() != body))
      bodies.push_back(body);
  }
  return bodies;
}

double Pieces::times_to_tell(std::size_t piece, const PieceMotions& end) const {
  return std::sqrt(seen * pieces_[piece].size / end.way[piece]);
}

double Pieces::time_to_tell(double acceleration, double damping) const {
  double size = 0;
  for (const FollowedPiece& piece : pieces_) size = std::max(size, piece.size);
  const double way = seen * size, free = std::sqrt(2 * way / acceleration);
  if (!(damping * free > 1e-6)) return free;
  // v' = a − c v from rest: c² x/a = τ − (1 − e^−τ) with τ = c t, convex, so that Newton comes from above.
  const double due = damping * damping * way / acceleration;
  double at = due + 1;
  for (int i = 0; i < 50; ++i) at -= (at + std::expm1(-at) - due) / -std::expm1(-at);
  return at / damping;
}

}  // namespace talus
