#include "kernels/blocks.hpp"

#include "kernels/block_velocities.hpp"
#include "kernels/quads.hpp"

#include <talus/simd/pack.hpp>

#include <algorithm>
#include <cmath>

namespace talus::kernels::TALUS_KERNEL_LEVEL {
namespace {

double smaller(double p, double q) {
  return p < q ? p : q;
}
double larger(double p, double q) {
  return p > q ? p : q;
}

void follow_any(const BodyMotion& m, const CornerDrift* drift, const double* reference_x,
                const double* reference_y, BoundaryCorner* corners, std::uint32_t count,
                SpeedExtremes& speeds) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const double px = reference_x[i], py = reference_y[i];
    corners[i].x = px + (m.u.x + m.h.xx * px + m.h.xy * py);
    corners[i].y = py + (m.u.y + m.h.yx * px + m.h.yy * py);
    corners[i].vx = m.velocity.x + m.rate.xx * px + m.rate.xy * py;
    corners[i].vy = m.velocity.y + m.rate.yx * px + m.rate.yy * py;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const BoundaryCorner& next = corners[i + 1 == count ? 0 : i + 1];
    const double dx = next.x - corners[i].x, dy = next.y - corners[i].y;
    const double length = std::sqrt(dx * dx + dy * dy);
    corners[i].length = length;
    corners[i].tangent_x = length > 0 ? dx / length : 0;
    corners[i].tangent_y = length > 0 ? dy / length : 0;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const double vx = corners[i].vx, vy = corners[i].vy, here = vx * vx + vy * vy;
    const double off_x = vx - drift[i].x, off_y = vy - drift[i].y;
    speeds.squared = larger(speeds.squared, here);
    speeds.sum += here;
    speeds.stray_squared = larger(speeds.stray_squared, off_x * off_x + off_y * off_y);
    speeds.low_x = smaller(speeds.low_x, vx);
    speeds.high_x = larger(speeds.high_x, vx);
    speeds.low_y = smaller(speeds.low_y, vy);
    speeds.high_y = larger(speeds.high_y, vy);
  }
}

/// Speeds so far, of four corners at a time.
struct SpeedRows {
  Quad squared{}, sum{}, stray_squared{}, low_x, high_x, low_y, high_y;

  /// From the velocity of any corner on.
  explicit SpeedRows(Vec2 first) {
    low_x = high_x = Quad{} + first.x;
    low_y = high_y = Quad{} + first.y;
  }
  void add(const Quad& vx, const Quad& vy, const CornerDrift* drift) {
    Floats drifts;
    load(&drift[0].x, drifts);
    const Quad drift_x = __builtin_convertvector(__builtin_shufflevector(drifts, drifts, 0, 2, 4, 6), Quad),
               drift_y = __builtin_convertvector(__builtin_shufflevector(drifts, drifts, 1, 3, 5, 7), Quad);
    const Quad here = vx * vx + vy * vy, off_x = vx - drift_x, off_y = vy - drift_y,
               stray = off_x * off_x + off_y * off_y;
    stray_squared = stray_squared > stray ? stray_squared : stray;
    squared = squared > here ? squared : here;
    sum += here;
    low_x = low_x < vx ? low_x : vx;
    high_x = high_x > vx ? high_x : vx;
    low_y = low_y < vy ? low_y : vy;
    high_y = high_y > vy ? high_y : vy;
  }
  void add_to(SpeedExtremes& all) const {
    for (int i = 0; i < 4; ++i)
      all.add({squared[i], sum[i], low_x[i], high_x[i], low_y[i], high_y[i], stray_squared[i], true});
  }
};

/// A quadrilateral, which most blocks are.
inline void follow_quadrilateral(const BodyMotion& m, const CornerDrift* drift, const double* reference_x,
                                 const double* reference_y, BoundaryCorner* corner, SpeedRows& speeds) {
  Quad px, py;
  load(reference_x, px);
  load(reference_y, py);
  const Quad x = px + (m.u.x + m.h.xx * px + m.h.xy * py), y = py + (m.u.y + m.h.yx * px + m.h.yy * py);
  const Quad vx = m.velocity.x + m.rate.xx * px + m.rate.xy * py,
             vy = m.velocity.y + m.rate.yx * px + m.rate.yy * py;
  speeds.add(vx, vy, drift);
  const Quad dx = __builtin_shufflevector(x, x, 1, 2, 3, 0) - x,
             dy = __builtin_shufflevector(y, y, 1, 2, 3, 0) - y;
  Quad length = dx * dx + dy * dy;
  for (int i = 0; i < 4; ++i) length[i] = std::sqrt(length[i]);
  const Quad tx = length > 0 ? dx / length : Quad{}, ty = length > 0 ? dy / length : Quad{};

  // Rows become corners: x, y, tangent of each, then its velocity.
  const Quad even = __builtin_shufflevector(x, y, 0, 4, 2, 6),
             odd = __builtin_shufflevector(x, y, 1, 5, 3, 7),
             even_t = __builtin_shufflevector(tx, ty, 0, 4, 2, 6),
             odd_t = __builtin_shufflevector(tx, ty, 1, 5, 3, 7);
  store(__builtin_shufflevector(even, even_t, 0, 1, 4, 5), &corner[0].x);
  store(__builtin_shufflevector(odd, odd_t, 0, 1, 4, 5), &corner[1].x);
  store(__builtin_shufflevector(even, even_t, 2, 3, 6, 7), &corner[2].x);
  store(__builtin_shufflevector(odd, odd_t, 2, 3, 6, 7), &corner[3].x);
  const Quad even_v = __builtin_shufflevector(vx, vy, 0, 4, 2, 6),
             odd_v = __builtin_shufflevector(vx, vy, 1, 5, 3, 7);
  store(__builtin_shufflevector(even_v, even_v, 0, 1), &corner[0].vx);
  store(__builtin_shufflevector(odd_v, odd_v, 0, 1), &corner[1].vx);
  store(__builtin_shufflevector(even_v, even_v, 2, 3), &corner[2].vx);
  store(__builtin_shufflevector(odd_v, odd_v, 2, 3), &corner[3].vx);
  for (int i = 0; i < 4; ++i) corner[i].length = length[i];
}

void follow(const Block* blocks, const BodyMotion* motion, const CornerDrift* drift,
            const double* reference_x, const double* reference_y, BoundaryCorner* corners, std::size_t begin,
            std::size_t end, SpeedExtremes& speeds) {
  while (begin < end && blocks[begin].corner_count == 0) ++begin;
  if (begin == end) return;
  const Vec2 any = motion[begin].velocity;
  if (!speeds.any) speeds = {0, 0, any.x, any.x, any.y, any.y, 0, true};
  SpeedRows rows(any);
  for (std::size_t b = begin; b < end; ++b) {
    const std::uint32_t first = blocks[b].corner_begin, count = blocks[b].corner_count;
    if (count == 4 && simd::lanes > 1) {
      follow_quadrilateral(motion[b], drift + first, reference_x + first, reference_y + first,
                           corners + first, rows);
    } else if (count > 0) {
      follow_any(motion[b], drift + first, reference_x + first, reference_y + first, corners + first, count,
                 speeds);
    }
  }
  rows.add_to(speeds);
}

void take_root(double& of) {
  of = std::sqrt(of);
}
void take_root(Quad& of) {
  for (int i = 0; i < 4; ++i) of[i] = std::sqrt(of[i]);
}

/// Cosine less one and sine of a rotation that goes on by an angle, without trigonometry in the step: series
/// to the seventh order, then normalised. No number known beforehand is divided by: such divisions took some
/// third of moving a body.
template <class Numbers>
inline void turn(const Numbers& angle, Numbers& cosine_less_one, Numbers& sine) {
  const Numbers a2 = angle * angle;
  const Numbers more_sine = angle * (1 - a2 * (1.0 / 6) * (1 - a2 * (1.0 / 20) * (1 - a2 * (1.0 / 42)))),
                more_cosine = 1 - a2 * 0.5 * (1 - a2 * (1.0 / 12) * (1 - a2 * (1.0 / 30)));
  const Numbers c = 1 + cosine_less_one;
  const Numbers to = more_cosine * c - more_sine * sine, up = more_sine * c + more_cosine * sine;
  Numbers size = to * to + up * up;
  take_root(size);
  const Numbers inverse = 1 / size;
  cosine_less_one = to * inverse - 1;
  sine = up * inverse;
}

/// R − I and its rate have two numbers each; the rate is that of the step.
void turn_body(double dt, double per_time, BodyMotion& m) {
  double xx = m.h.xx, yx = m.h.yx;
  turn(dt * m.spin, xx, yx);
  const double rate_xx = per_time * (xx - m.h.xx), rate_yx = per_time * (yx - m.h.yx);
  m.rate = {rate_xx, -rate_yx, rate_yx, rate_xx};
  m.h = {xx, -yx, yx, xx};
}

/// The same of four.
void turn_bodies(double dt, double per_time, BodyMotion* m) {
  const Quad spin{m[0].spin, m[1].spin, m[2].spin, m[3].spin}, xx{m[0].h.xx, m[1].h.xx, m[2].h.xx, m[3].h.xx},
      yx{m[0].h.yx, m[1].h.yx, m[2].h.yx, m[3].h.yx};
  Quad next_xx = xx, next_yx = yx;
  turn(Quad(dt * spin), next_xx, next_yx);
  const auto set = [m](const Quad& c, const Quad& s, Matrix2 BodyMotion::*which) {
    // To each c, −s, s, c.
    const Quad minus = -s, even = __builtin_shufflevector(c, minus, 0, 4, 2, 6),
               odd = __builtin_shufflevector(c, minus, 1, 5, 3, 7),
               even_s = __builtin_shufflevector(s, c, 0, 4, 2, 6),
               odd_s = __builtin_shufflevector(s, c, 1, 5, 3, 7);
    store(__builtin_shufflevector(even, even_s, 0, 1, 4, 5), &(m[0].*which).xx);
    store(__builtin_shufflevector(odd, odd_s, 0, 1, 4, 5), &(m[1].*which).xx);
    store(__builtin_shufflevector(even, even_s, 2, 3, 6, 7), &(m[2].*which).xx);
    store(__builtin_shufflevector(odd, odd_s, 2, 3, 6, 7), &(m[3].*which).xx);
  };
  set(per_time * (next_xx - xx), per_time * (next_yx - yx), &BodyMotion::rate);
  set(next_xx, next_yx, &BodyMotion::h);
}

bool all_turn(const Block* four) {
  return std::all_of(four, four + 4, [](const Block& block) { return block.rigid && block.mass != 0; });
}

void move_blocks(const Block* blocks, double dt, BodyMotion* motion, std::size_t begin, std::size_t end) {
  const double per_time = 1 / dt;
  const auto shift = [dt](BodyMotion& m) {
    m.u.x += dt * m.velocity.x;
    m.u.y += dt * m.velocity.y;
  };
  for (std::size_t b = begin; b < end; ++b) {
    if (simd::lanes > 1 && b + 4 <= end && all_turn(blocks + b)) {
      std::for_each(motion + b, motion + b + 4, shift);
      turn_bodies(dt, per_time, motion + b);
      b += 3;
      continue;
    }
    if (blocks[b].mass == 0) continue;
    BodyMotion& m = motion[b];
    shift(m);
    if (blocks[b].rigid) {
      turn_body(dt, per_time, m);
      continue;
    }
    m.h.xx += dt * m.rate.xx;
    m.h.xy += dt * m.rate.xy;
    m.h.yx += dt * m.rate.yx;
    m.h.yy += dt * m.rate.yy;
  }
}

/// p₀ + p₁, q₀ + q₁, p₂ + p₃, q₂ + q₃.
inline void add_neighbours(const Quad& p, const Quad& q, Quad& to) {
  to = __builtin_shufflevector(p, q, 0, 4, 2, 6) + __builtin_shufflevector(p, q, 1, 5, 3, 7);
}

/// ΣF and ΣF ⊗ X of loads x, y on corners that are at (px, py) in the reference.
inline void add_to(BodyForce& force, const Quad& x, const Quad& y, const Quad& px, const Quad& py) {
  Quad sum, of_x, of_y, moment;
  add_neighbours(x, y, sum);
  add_neighbours(x * px, x * py, of_x);
  add_neighbours(y * px, y * py, of_y);
  Pair total;
  load(&force.force.x, total);
  total += __builtin_shufflevector(sum, sum, 0, 1) + __builtin_shufflevector(sum, sum, 2, 3);
  store(total, &force.force.x);
  load(&force.moment.xx, moment);
  moment += __builtin_shufflevector(of_x, of_y, 0, 1, 4, 5) + __builtin_shufflevector(of_x, of_y, 2, 3, 6, 7);
  store(moment, &force.moment.xx);
}

/// Of a body with three or four corners: x and y of the first two side by side, and of the others.
template <int count>
inline void add_to_small(const double* reference_x, const double* reference_y, const GatheredLoads& loads,
                         const BodyLoads& body, BodyForce& force, Quad& all) {
  Quad first{}, others{}, px{}, py{};
  if (body.begun) {
    load(&loads.sum[body.sum].x, first);
    load(&loads.sum[body.sum + 2].x, others);
  }
  const std::uint32_t* const end = loads.first + (&body)[1].begin;
  for (const std::uint32_t* at = loads.first + body.begin; at != end; ++at) {
    const CornerLoad* const from = loads.corner + *at;
    Quad more, more_others;
    load(&from[0].x, more);
    load(&from[2].x, more_others);
    first += more;
    others += more_others;
  }
  // What came last of three corners belongs to the next piece.
  if constexpr (count == 3) others = __builtin_shufflevector(others, Quad{}, 0, 1, 4, 4);
  all += first + others;
  if (body.goes_on) {
    store(first, &loads.sum[body.sum].x);
    store(others, &loads.sum[body.sum + 2].x);
    return;
  }
  if constexpr (count == 4) {
    load(reference_x, px);
    load(reference_y, py);
  } else {
    for (int i = 0; i < 3; ++i) px[i] = reference_x[i];
    for (int i = 0; i < 3; ++i) py[i] = reference_y[i];
  }
  add_to(force, __builtin_shufflevector(first, others, 0, 2, 4, 6),
         __builtin_shufflevector(first, others, 1, 3, 5, 7), px, py);
}

/// Apart from the loop over small bodies, which needs all registers.
[[gnu::noinline]] void add_to_any(const double* reference_x, const double* reference_y,
                                  const GatheredLoads& loads, const BodyLoads& body, BodyForce& force,
                                  double& all) {
  const std::uint32_t count = body.corner_count;
  constexpr std::uint32_t most = 16;
  CornerLoad sum[most];
  for (std::uint32_t part = 0; part < count; part += most) {
    const std::uint32_t here = count - part < most ? count - part : most;
    const std::uint32_t kept = body.sum + part;
    for (std::uint32_t i = 0; i < here; ++i) {
      sum[i] = body.begun ? loads.sum[kept + i] : CornerLoad{0, 0};
    }
    for (std::uint32_t at = body.begin; at != (&body)[1].begin; ++at) {
      const CornerLoad* const from = loads.corner + loads.first[at] + part;
      for (std::uint32_t i = 0; i < here; ++i) {
        sum[i].x += from[i].x;
        sum[i].y += from[i].y;
      }
    }
    for (std::uint32_t i = 0; i < here; ++i) {
      const auto [x, y] = sum[i];
      all += x + y;
      if (body.goes_on) {
        loads.sum[kept + i] = sum[i];
        continue;
      }
      const double px = reference_x[part + i], py = reference_y[part + i];
      force.force.x += x;
      force.force.y += y;
      force.moment.xx += x * px;
      force.moment.xy += x * py;
      force.moment.yx += y * px;
      force.moment.yy += y * py;
    }
  }
}

/// Bodies of a wave lie scattered: what is looked up of them is fetched so many before its turn.
constexpr std::ptrdiff_t bodies_ahead = 8;

double add_loads(const GatheredLoads& given, const double* reference_x, const double* reference_y,
                 BodyForce* forces, std::size_t begin, std::size_t end) {
  const GatheredLoads loads = given;  // which no store below can change
  double all = 0;
  Quad all_small{};
  const BodyLoads* const last = loads.bodies + end;
  for (const BodyLoads* body = loads.bodies + begin; body != last; ++body) {
    if (last - body > bodies_ahead) {
      const BodyLoads& next = body[bodies_ahead];
      __builtin_prefetch(&forces[next.body], 1);
      __builtin_prefetch(reference_x + next.corner_begin);
      __builtin_prefetch(reference_y + next.corner_begin);
    }
    if (loads.still != nullptr && loads.still[body->body] != 0) continue;
    const double *x = reference_x + body->corner_begin, *y = reference_y + body->corner_begin;
    BodyForce& force = forces[body->body];
    if (body->corner_count == 4) {
      add_to_small<4>(x, y, loads, *body, force, all_small);
    } else if (body->corner_count == 3) {
      add_to_small<3>(x, y, loads, *body, force, all_small);
    } else if (body->corner_count > 0) {
      add_to_any(x, y, given, *body, force, all);
    }
  }
  return all + ((all_small[0] + all_small[1]) + (all_small[2] + all_small[3]));
}

}  // namespace

extern const BlockKernels block_kernels;
const BlockKernels block_kernels{follow, move_blocks, add_loads, accelerate};

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
