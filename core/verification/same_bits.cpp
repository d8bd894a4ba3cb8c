#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::verification {
namespace {

void origin(const Bench& bench, Rows& rows) {
  const Scene near = bench.shipped("incline"), far = bench.shipped("incline", {{"/origin", "[5e5, 5e6]"}});
  rows.same("incline through origin (5e5, 5e6) m", hash_after(near, {}) == hash_after(far, {}),
            "state at the origin");
}

/// Coordinates written far away are rounded by 1e-9 m where they stand, and the slope with them.
void absolute_coordinates(const Bench& bench, Rows& rows) {
  const Scene near = bench.shipped("incline");
  Scene far = near;
  for (SceneBody& body : far.bodies) {
    for (Vec2& vertex : body.outer.vertices) vertex = {vertex.x + 5e5, vertex.y + 5e6};
  }
  const Course here = run(near, "block"), there = run(far, "block");
  double apart = 0;
  for (std::size_t i = 0; i < here.time.size(); ++i) {
    const Vec2 p = here.motion[i].displacement, q = there.motion[i].displacement;
    apart = std::max(apart, std::hypot(p.x - q.x, p.y - q.y));
  }
  rows.below(Kind::bound, "incline written at (5e5, 5e6) m: displacement apart in 10 s", apart, 1e-7, "m");
}

void threads(const Bench& bench, Rows& rows) {
  const Scene scene = bench.shipped("brick_wall", {{"/time/end", "0.01"}});
  const std::string one = hash_after(scene, {.threads = 1});
  rows.same("brick_wall with 2 threads", hash_after(scene, {.threads = 2}) == one, "state as with 1");
  rows.same("brick_wall with 3 threads", hash_after(scene, {.threads = 3}) == one, "state as with 1");
  rows.same("brick_wall, neighbours sought in every step",
            hash_after(scene, {.threads = 1, .neighbour_skin = false}) == one, "state as with the skin");
}

}  // namespace

std::span<const Case> same_bits_cases() {
  static constexpr Case cases[] = {
      {"same_bits", "origin", "A scene far from zero moves the same through its origin.", 1, origin},
      {"same_bits", "absolute_coordinates",
       "Written far away, coordinates are rounded to 1e-9 m; the motion parts by no more than that suggests.",
       1, absolute_coordinates},
      {"same_bits", "threads", "Neither threads nor the skin of the neighbour search change a bit.", 3,
       threads},
  };
  return cases;
}

}  // namespace talus::verification
