#pragma once

#include "kernels/blocks.hpp"
#include "kernels/quads.hpp"

namespace talus::kernels::TALUS_KERNEL_LEVEL {

/// ½ pᵀ M q, twice over.
inline double product(const Block& b, const BodyMotion& p, const BodyMotion& q) {
  const double translation = b.mass * (p.velocity.x * q.velocity.x + p.velocity.y * q.velocity.y);
  if (b.rigid) return translation + b.inertia() * p.spin * q.spin;
  const Matrix2 &r = p.rate, &s = q.rate;
  return translation +
         (r.xx * (b.moment_xx * s.xx + b.moment_xy * s.xy) +
          r.xy * (b.moment_xy * s.xx + b.moment_yy * s.xy)) +
         (r.yx * (b.moment_xx * s.yx + b.moment_xy * s.yy) +
          r.yy * (b.moment_xy * s.yx + b.moment_yy * s.yy));
}

/// VelocityProducts as they are added up: rates and moments are rows of four, xx, xy, yx, yy.
struct ProductRows {
  Pair translation;
  Quad strain;
  double rotation;

  explicit ProductRows(const VelocityProducts& from) : rotation(from.rotation) {
    load(from.translation, translation);
    load(from.strain, strain);
  }
  void leave(VelocityProducts& to) const {
    store(translation, to.translation);
    store(strain, to.strain);
    to.rotation = rotation;
  }
};

/// The velocity update of bodies, one after the other. Half a symmetric matrix serves both its halves.
template <bool damped>
class BlockVelocities {
 public:
  BlockVelocities(const BlockUpdate& update, const BlockSums& sums)
      : keep_(update.keep),
        gain_(update.gain),
        even_(update.even_steps),
        gravity_{update.gravity_x, update.gravity_y},
        across_(sums.across),
        behind_(sums.behind),
        ahead_(sums.ahead) {
    load(sums.momentum, momentum_);
  }

  /// v₊, and what the sums want of it.
  void accelerate(const Block& block, const BodyForce& f, BodyMotion& now) {
    Pair v, force;
    load(&now.velocity.x, v);
    load(&f.force.x, force);
    const Pair momentum = block.mass * v, next_v = keep_ * v + gain_ * (force / block.mass + gravity_);
    momentum_ += momentum;
    if (even_) across_.translation += momentum * next_v;
    if constexpr (damped) {
      const Pair at = block.mass * (v + half * (next_v - v));
      behind_.translation += at * v;
      ahead_.translation += at * next_v;
    }
    store(next_v, &now.velocity.x);
    if (block.rigid) {
      const double before = now.spin, next = keep_ * before + gain_ * torque(now, f) / block.inertia();
      if (even_) across_.rotation += block.inertia() * before * next;
      if constexpr (damped) {
        const double at = block.inertia() * (before + half * (next - before));
        behind_.rotation += at * before;
        ahead_.rotation += at * next;
      }
      now.spin = next;
      return;
    }
    Quad rate, q, acceleration, moment;
    load(&now.rate.xx, rate);
    load(&f.moment.xx, q);
    times_symmetric(q, &block.inverse_xx, acceleration);
    const Quad next_rate = keep_ * rate + gain_ * acceleration;
    store(next_rate, &now.rate.xx);
    if (even_) {
      times_symmetric(next_rate, &block.moment_xx, moment);
      across_.strain += rate * moment;
    }
    if constexpr (damped) {
      times_symmetric(rate + half * (next_rate - rate), &block.moment_xx, moment);
      behind_.strain += rate * moment;
      ahead_.strain += next_rate * moment;
    }
  }

  void leave(BlockSums& sums) const {
    store(momentum_, sums.momentum);
    across_.leave(sums.across);
    behind_.leave(sums.behind);
    ahead_.leave(sums.ahead);
  }

 private:
  /// Damping is taken with the mean of both velocities, also where steps are uneven.
  static constexpr double half = 0.5;

  /// Row by row of a matrix times the symmetric one of which xx, xy, yy are given.
  static void times_symmetric(const Quad& rows, const double* symmetric, Quad& product) {
    Pair first, second;
    load(symmetric, first);
    load(symmetric + 1, second);
    product =
        __builtin_shufflevector(rows, rows, 0, 0, 2, 2) * __builtin_shufflevector(first, first, 0, 1, 0, 1) +
        __builtin_shufflevector(rows, rows, 1, 1, 3, 3) * __builtin_shufflevector(second, second, 0, 1, 0, 1);
  }

  double keep_, gain_;
  bool even_;
  Pair gravity_, momentum_;
  ProductRows across_, behind_, ahead_;
};

/// Adds to `kinetic` of uneven steps and gives the velocity at t_n. The kinetic energy is that of one side
/// and its mirror image about t_n: one side alone would miss energy of first order.
inline void look_between(const Block& block, const BlockUpdate& update, const BodyMotion& before,
                         const BodyMotion& now, BodyMotion* middle, double& kinetic) {
  const auto between = [&](double p, double q) { return p + update.share_of_after * (q - p); };
  BodyMotion at = now;
  at.velocity = {between(before.velocity.x, now.velocity.x), between(before.velocity.y, now.velocity.y)};
  at.spin = between(before.spin, now.spin);
  at.rate = {between(before.rate.xx, now.rate.xx), between(before.rate.xy, now.rate.xy),
             between(before.rate.yx, now.rate.yx), between(before.rate.yy, now.rate.yy)};
  if (!update.even_steps) {
    const BodyMotion& side = update.from_behind ? before : now;
    const auto mirror = [](double centre, double value) { return 2 * centre - value; };
    BodyMotion other = at;
    other.velocity = {mirror(at.velocity.x, side.velocity.x), mirror(at.velocity.y, side.velocity.y)};
    other.spin = mirror(at.spin, side.spin);
    other.rate = {mirror(at.rate.xx, side.rate.xx), mirror(at.rate.xy, side.rate.xy),
                  mirror(at.rate.yx, side.rate.yx), mirror(at.rate.yy, side.rate.yy)};
    kinetic += product(block, side, other) / 2;
  }
  if (middle == nullptr) return;
  if (block.rigid) {
    at.rate = {-at.spin * at.h.yx, -at.spin * (1 + at.h.yy), at.spin * (1 + at.h.xx), at.spin * at.h.xy};
  }
  *middle = at;
}

template <bool damped>
void accelerate_all(const Block* blocks, const BodyForce* forces, const BlockUpdate& update,
                    BodyMotion* motion, BodyMotion* middle, std::size_t begin, std::size_t end,
                    BlockSums& sums) {
  BlockVelocities<damped> velocities(update, sums);
  const bool no_more = update.even_steps && middle == nullptr;
  for (std::size_t b = begin; b < end; ++b) {
    const Block& block = blocks[b];
    if (!block.free) continue;
    if (no_more) {
      velocities.accelerate(block, forces[b], motion[b]);
      continue;
    }
    const BodyMotion before = motion[b];
    velocities.accelerate(block, forces[b], motion[b]);
    look_between(block, update, before, motion[b], middle == nullptr ? nullptr : middle + b, sums.kinetic);
  }
  velocities.leave(sums);
}

inline void accelerate(const Block* blocks, const BodyForce* forces, const BlockUpdate& update,
                       BodyMotion* motion, BodyMotion* middle, std::size_t begin, std::size_t end,
                       BlockSums& sums) {
  (update.damped ? accelerate_all<true> : accelerate_all<false>)(blocks, forces, update, motion, middle,
                                                                 begin, end, sums);
}

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
