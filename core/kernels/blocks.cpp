#include "kernels/blocks.hpp"

#include <cmath>

namespace talus::kernels::TALUS_KERNEL_LEVEL {
namespace {

double smaller(double p, double q) {
  return p < q ? p : q;
}
double larger(double p, double q) {
  return p > q ? p : q;
}

/// `count` is a constant where this is inlined for quadrilaterals, which most blocks are.
inline __attribute__((always_inline)) void follow_one(const BodyMotion& m, const double* reference_x,
                                                      const double* reference_y, BoundaryCorner* corners,
                                                      std::uint32_t count, SpeedExtremes& speeds) {
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
    speeds.squared = larger(speeds.squared, here);
    speeds.sum += here;
    speeds.low_x = smaller(speeds.low_x, vx);
    speeds.high_x = larger(speeds.high_x, vx);
    speeds.low_y = smaller(speeds.low_y, vy);
    speeds.high_y = larger(speeds.high_y, vy);
  }
}

void follow(const Block* blocks, const BodyMotion* motion, const double* reference_x,
            const double* reference_y, BoundaryCorner* corners, std::size_t begin, std::size_t end,
            SpeedExtremes& speeds) {
  for (std::size_t b = begin; b < end; ++b) {
    const std::uint32_t first = blocks[b].corner_begin, count = blocks[b].corner_count;
    if (count == 0) continue;
    if (!speeds.any) {
      const double vx = motion[b].velocity.x, vy = motion[b].velocity.y;
      speeds = {0, 0, vx, vx, vy, vy, true};
    }
    if (count == 4) {
      follow_one(motion[b], reference_x + first, reference_y + first, corners + first, 4, speeds);
    } else {
      follow_one(motion[b], reference_x + first, reference_y + first, corners + first, count, speeds);
    }
  }
}

void move_blocks(const Block* blocks, double dt, BodyMotion* motion, std::size_t begin, std::size_t end) {
  for (std::size_t b = begin; b < end; ++b) {
    if (blocks[b].mass == 0) continue;
    BodyMotion& m = motion[b];
    m.u.x += dt * m.velocity.x;
    m.u.y += dt * m.velocity.y;
    if (blocks[b].rigid) {
      const Matrix2 next = turned(m.h, dt * m.spin);
      m.rate = {(next.xx - m.h.xx) / dt, (next.xy - m.h.xy) / dt, (next.yx - m.h.yx) / dt,
                (next.yy - m.h.yy) / dt};
      m.h = next;
      continue;
    }
    m.h.xx += dt * m.rate.xx;
    m.h.xy += dt * m.rate.xy;
    m.h.yx += dt * m.rate.yx;
    m.h.yy += dt * m.rate.yy;
  }
}

inline __attribute__((always_inline)) void sum_loads(std::uint32_t count, const PieceLoads* begin,
                                                     const PieceLoads* end, const BodyPair* pairs,
                                                     const double* fx, const double* fy, double* sum_x,
                                                     double* sum_y) {
  for (std::uint32_t i = 0; i < count; ++i) sum_x[i] = sum_y[i] = 0;
  for (const PieceLoads* at = begin; at != end; ++at) {
    if (pairs[at->pair].contact_count == 0) continue;
    for (std::uint32_t i = 0; i < count; ++i) sum_x[i] += fx[at->load + i];
    for (std::uint32_t i = 0; i < count; ++i) sum_y[i] += fy[at->load + i];
  }
}

void add_loads(std::uint32_t count, const double* reference_x, const double* reference_y,
               const PieceLoads* begin, const PieceLoads* end, const BodyPair* pairs, const double* fx,
               const double* fy, BodyForce& force) {
  constexpr std::uint32_t most = 16;
  double sum_x[most], sum_y[most];
  for (std::uint32_t part = 0; part < count; part += most) {
    const std::uint32_t here = count - part < most ? count - part : most;
    if (count == 4) {
      sum_loads(4, begin, end, pairs, fx, fy, sum_x, sum_y);
    } else {
      sum_loads(here, begin, end, pairs, fx + part, fy + part, sum_x, sum_y);
    }
    for (std::uint32_t i = 0; i < here; ++i) {
      const double px = reference_x[part + i], py = reference_y[part + i];
      force.force.x += sum_x[i];
      force.force.y += sum_y[i];
      force.moment.xx += sum_x[i] * px;
      force.moment.xy += sum_x[i] * py;
      force.moment.yx += sum_y[i] * px;
      force.moment.yy += sum_y[i] * py;
    }
  }
}

/// ½ pᵀ M q, twice over.
double product(const Block& b, const BodyMotion& p, const BodyMotion& q) {
  const double translation = b.mass * (p.velocity.x * q.velocity.x + p.velocity.y * q.velocity.y);
  if (b.rigid) return translation + b.inertia * p.spin * q.spin;
  const Matrix2 &r = p.rate, &s = q.rate;
  return translation +
         (r.xx * (b.moment_xx * s.xx + b.moment_xy * s.xy) +
          r.xy * (b.moment_xy * s.xx + b.moment_yy * s.xy)) +
         (r.yx * (b.moment_xx * s.yx + b.moment_xy * s.yy) +
          r.yy * (b.moment_xy * s.yx + b.moment_yy * s.yy));
}

void accelerate(const Block* blocks, const BodyForce* forces, const BlockUpdate& update, BodyMotion* motion,
                BodyMotion* middle, std::size_t begin, std::size_t end, BlockSums& sums) {
  const double keep = update.keep, gain = update.gain;
  for (std::size_t b = begin; b < end; ++b) {
    const Block& block = blocks[b];
    if (!block.free) continue;
    const BodyForce& f = forces[b];
    BodyMotion& now = motion[b];
    const BodyMotion before = now;
    now.velocity.x = keep * before.velocity.x + gain * (f.force.x / block.mass + update.gravity_x);
    now.velocity.y = keep * before.velocity.y + gain * (f.force.y / block.mass + update.gravity_y);
    const Matrix2& q = f.moment;
    if (block.rigid) {
      now.spin = keep * before.spin + gain * torque(before, f) / block.inertia;
    } else {
      now.rate.xx = keep * before.rate.xx + gain * (q.xx * block.inverse_xx + q.xy * block.inverse_xy);
      now.rate.xy = keep * before.rate.xy + gain * (q.xx * block.inverse_xy + q.xy * block.inverse_yy);
      now.rate.yx = keep * before.rate.yx + gain * (q.yx * block.inverse_xx + q.yy * block.inverse_xy);
      now.rate.yy = keep * before.rate.yy + gain * (q.yx * block.inverse_xy + q.yy * block.inverse_yy);
    }
    sums.momentum_x += block.mass * before.velocity.x;
    sums.momentum_y += block.mass * before.velocity.y;
    if (update.even_steps && !update.damped && middle == nullptr) {
      sums.kinetic += product(block, before, now) / 2;
      continue;
    }
    const auto between = [&](double p, double q_) { return p + update.share_of_after * (q_ - p); };
    BodyMotion at = now;
    at.velocity = {between(before.velocity.x, now.velocity.x), between(before.velocity.y, now.velocity.y)};
    at.spin = between(before.spin, now.spin);
    at.rate = {between(before.rate.xx, now.rate.xx), between(before.rate.xy, now.rate.xy),
               between(before.rate.yx, now.rate.yx), between(before.rate.yy, now.rate.yy)};
    if (update.damped) sums.damped += product(block, at, at);
    if (update.even_steps) {
      sums.kinetic += product(block, before, now) / 2;
    } else {
      // The velocity mirrored about t_n: that of uneven steps would miss energy of first order.
      const BodyMotion& side = update.from_behind ? before : now;
      const auto mirror = [](double centre, double value) { return 2 * centre - value; };
      BodyMotion other = at;
      other.velocity = {mirror(at.velocity.x, side.velocity.x), mirror(at.velocity.y, side.velocity.y)};
      other.spin = mirror(at.spin, side.spin);
      other.rate = {mirror(at.rate.xx, side.rate.xx), mirror(at.rate.xy, side.rate.xy),
                    mirror(at.rate.yx, side.rate.yx), mirror(at.rate.yy, side.rate.yy)};
      sums.kinetic += product(block, side, other) / 2;
    }
    if (middle == nullptr) continue;
    if (block.rigid) {
      at.rate = {-at.spin * at.h.yx, -at.spin * (1 + at.h.yy), at.spin * (1 + at.h.xx), at.spin * at.h.xy};
    }
    middle[b] = at;
  }
}

}  // namespace

extern const BlockKernels block_kernels;
const BlockKernels block_kernels{follow, move_blocks, add_loads, accelerate};

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
