#include "simulation/blocks.hpp"

#include "simulation/velocity_update.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr std::size_t covered_at_once = 4, others_at_once = 64;
constexpr std::uint32_t sides_at_once = 128;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Of no corner, to add to.
constexpr kernels::SpeedExtremes of_nothing{0, 0, infinite, -infinite, infinite, -infinite, 0, false};

void add(kernels::SpeedExtremes& all, Vec2 v, const kernels::CornerDrift& drift) {
  const double squared = v.x * v.x + v.y * v.y, off_x = v.x - drift.x, off_y = v.y - drift.y;
  all.squared = std::max(all.squared, squared);
  all.sum += squared;
  all.low_x = std::min(all.low_x, v.x), all.high_x = std::max(all.high_x, v.x);
  all.low_y = std::min(all.low_y, v.y), all.high_y = std::max(all.high_y, v.y);
  all.stray_squared = std::max(all.stray_squared, off_x * off_x + off_y * off_y);
  all.any = true;
}

kernels::SpeedExtremes speeds_of_corners(const Model& model, const MotionState& motion, const Body& body,
                                         std::span<const kernels::CornerDrift> drift) {
  kernels::SpeedExtremes all = of_nothing;
  model.visit_boundary(body, [&](std::uint32_t c) {
    add(all, {motion.corners[c].vx, motion.corners[c].vy}, drift[c]);
  });
  return all;
}

}  // namespace

Blocks::Blocks(const Model& model, SimdLevel level, Workers& workers, bool boundary_seen)
    : kernels_(kernels::block_kernels(level)),
      workers_(workers),
      moving_(model.moving_bodies),
      left_to_others_(moving_.begin(), moving_.end()),
      boundary_seen_(boundary_seen) {
  blocks_.reserve(model.bodies.size());
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    kernels::Block& block = blocks_.emplace_back();
    block.corner_begin = body.corner_begin;
    const bool whole = body.kinematics == Kinematics::rigid || body.kinematics == Kinematics::affine;
    if (whole) {
      const double density = body.density();
      block.mass = body.mass;
      block.rigid = body.kinematics == Kinematics::rigid;
      block.moment_xx = density * body.moments.xx;
      block.moment_xy = density * body.moments.xy;
      block.moment_yy = density * body.moments.yy;
      if (block.rigid) block.inertia() = body.inertia();
      const Matrix2 inverse = body.inverse_moment();
      block.inverse_xx = inverse.xx;
      block.inverse_xy = inverse.xy;
      block.inverse_yy = inverse.yy;
      if (body.strain_mass_scale != 1) with_scaled_strain_.push_back(i);
      if (body.piece_end == body.piece_begin + 1) block.corner_count = body.corner_end - body.corner_begin;
    }
    some_fixed_ = some_fixed_ || body.kinematics == Kinematics::fixed;
  }
  list_others(model);
  find_stretches();
}

void Blocks::list_others(const Model& model) {
  for (const std::uint32_t body : moving_) {
    if (blocks_[body].corner_count > 0) continue;
    if (!model.covered(body)) {
      others_.push_back({body, 0, 0});
      continue;
    }
    const CoverRanges& ranges = model.ranges(model.bodies[body]);
    for (std::uint32_t side = ranges.side_begin; side < ranges.side_end; side += sides_at_once)
      others_.push_back({body, side, std::min(side + sides_at_once, ranges.side_end)});
  }
  other_speeds_.resize(others_.size());
}

/// Chunks are those of all bodies, so that sums do not depend on what is fixed or sleeps.
void Blocks::find_stretches() {
  stretches_.clear();
  chunks_.clear();
  for (std::size_t begin = 0; begin < blocks_.size(); begin += chunk) {
    const std::size_t end = std::min(begin + chunk, blocks_.size()), first = stretches_.size();
    bool open = false;
    for (std::size_t i = begin; i < end; ++i) {
      const bool whole = blocks_[i].mass > 0;
      if (whole && !open) stretches_.push_back({i, i});
      if (whole) stretches_.back().end = i + 1;
      open = whole;
    }
    if (stretches_.size() > first) chunks_.push_back({first, stretches_.size()});
  }
  speeds_.resize(chunks_.size());
  sums_.resize(chunks_.size());
}

template <class Each>
void Blocks::over_chunks(const Each& each) {
  workers_.over(chunks_.size(), 1, [&](std::size_t number, std::size_t, std::size_t) {
    const auto [begin, end] = chunks_[number];
    each(number, std::span(stretches_).subspan(begin, end - begin));
  });
}

void Blocks::set_supports(std::span<const Support> supports) {
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    blocks_[i].free = blocks_[i].mass > 0 && !support_of(supports, i).any();
  left_to_others_ = {};  // mostly few; all of them were there
  for (const std::uint32_t body : moving_) {
    if (!blocks_[body].free) left_to_others_.push_back(body);
  }
  scaled_.clear();
  for (const std::uint32_t body : with_scaled_strain_) {
    if (!blocks_[body].free) continue;
    blocks_[body].free = false;  // to the kernels, which know no scale
    scaled_.push_back(body);
  }
  scaled_work_.resize((scaled_.size() + chunk - 1) / chunk);
}

/// To the loops of the step what sleeps is a fixed body.
void Blocks::set_asleep(std::span<const std::uint32_t> asleep) {
  if (awake_.empty()) awake_ = blocks_;
  asleep_.assign(asleep.begin(), asleep.end());
  for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
    blocks_[i] = is_asleep(i) ? kernels::Block{} : awake_[i];
    blocks_[i].corner_begin = awake_[i].corner_begin;
  }
  if (asleep_.empty()) awake_.clear();
  find_stretches();
}

void Blocks::move(double dt, MotionState& motion) {
  over_chunks([&](std::size_t, std::span<const Stretch> stretches) {
    for (const auto [begin, end] : stretches)
      kernels_.move(blocks_.data(), dt, motion.bodies.data(), begin, end);
  });
}

MotionState::Speeds Blocks::follow(const Model& model, std::span<const kernels::CornerDrift> drift,
                                   MotionState& motion) {
  over_chunks([&](std::size_t number, std::span<const Stretch> stretches) {
    kernels::SpeedExtremes here;
    for (const auto [begin, end] : stretches) {
      const auto forces = motion.forces.begin();
      std::fill(forces + static_cast<std::ptrdiff_t>(begin), forces + static_cast<std::ptrdiff_t>(end),
                BodyForce{});
      kernels_.follow(blocks_.data(), motion.bodies.data(), drift.data(), model.reference_x.data(),
                      model.reference_y.data(), motion.corners.data(), begin, end, here);
    }
    speeds_[number] = here;
  });
  kernels::SpeedExtremes all;
  for (const kernels::SpeedExtremes& part : speeds_) all.add(part);
  if (!asleep_.empty()) {
    for (const std::uint32_t body : moving_) {
      if (is_asleep(body)) motion.forces[body] = {};
    }
  }
  const std::size_t at_once = model.mostly_covered() ? covered_at_once : others_at_once;
  workers_.over(others_.size(), at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      other_speeds_[i] = follow_other(model, drift, others_[i], motion);
  });
  for (const kernels::SpeedExtremes& part : other_speeds_) all.add(part);
  if (!all.any) return {};
  if (some_fixed_ || !asleep_.empty()) all.add({0, 0, 0, 0, 0, 0, 0, true});
  if (!std::isfinite(all.sum)) return {std::numeric_limits<double>::quiet_NaN(), 0, 0};
  const double dx = all.high_x - all.low_x, dy = all.high_y - all.low_y;
  return {std::sqrt(all.squared), std::sqrt(dx * dx + dy * dy), std::sqrt(all.stray_squared)};
}

kernels::SpeedExtremes Blocks::follow_other(const Model& model, std::span<const kernels::CornerDrift> drift,
                                            const Other& other, MotionState& motion) const {
  const Body& body = model.bodies[other.body];
  if (!model.covered(other.body)) {
    motion.forces[other.body] = {};
    if (is_asleep(other.body)) return {};
    motion.move_corners(model, other.body);
    return speeds_of_corners(model, motion, body, drift);
  }
  if (other.side_begin == model.ranges(body).side_begin) motion.forces[other.body] = {};
  if (is_asleep(other.body)) return {};
  kernels::SpeedExtremes all = of_nothing;
  for (std::uint32_t side = other.side_begin; side < other.side_end; ++side) {
    const Vec2 speed = boundary_seen_ ? motion.move_start(model, body, side)
                                      : carried(model.sides[side].start.carrier, motion.patch_velocity);
    add(all, speed, drift[model.side_corner(body, side)]);
  }
  return all;
}

/// Bodies [begin, end) of a chunk; of their motion at t_n the velocity is kept.
void Blocks::accelerate_and_keep(std::size_t begin, std::size_t end, const kernels::BlockUpdate& update,
                                 MotionState& motion, kernels::BlockSums& sums) const {
  std::array<BodyMotion, chunk> at_step;
  kernels_.accelerate(blocks_.data() + begin, motion.forces.data() + begin, update,
                      motion.bodies.data() + begin, at_step.data(), 0, end - begin, sums);
  for (std::size_t i = begin; i < end; ++i) {
    if (blocks_[i].free) motion.leave_velocity(i, {at_step[i - begin].velocity, at_step[i - begin].rate});
  }
}

void Blocks::accelerate(const StepConditions& conditions, bool observed, MotionState& motion,
                        AccelerationWork& work) {
  const Update factors = update_of(conditions);
  const kernels::BlockUpdate update{factors.keep,
                                    factors.gain,
                                    conditions.gravity.x,
                                    conditions.gravity.y,
                                    share_of_after(conditions),
                                    conditions.dt_behind == conditions.dt_ahead,
                                    conditions.dt_behind > 0,
                                    conditions.damping > 0};
  over_chunks([&](std::size_t number, std::span<const Stretch> stretches) {
    kernels::BlockSums here;
    for (const auto [begin, end] : stretches) {
      if (observed)
        accelerate_and_keep(begin, end, update, motion, here);
      else
        kernels_.accelerate(blocks_.data(), motion.forces.data(), update, motion.bodies.data(), nullptr,
                            begin, end, here);
    }
    sums_[number] = here;
  });
  for (const kernels::BlockSums& part : sums_) {
    work.kinetic += part.all_kinetic();
    work.external_work += gravity_work(conditions, {part.momentum[0], part.momentum[1]});
    work.damping_loss += conditions.damping * part.behind.all() * conditions.dt_behind / 2;
    work.damping_loss_ahead += conditions.damping * part.ahead.all() * conditions.dt_ahead / 2;
  }
  // What loads a body that sleeps is used up by nobody.
  if (!observed || asleep_.empty()) return;
  for (const std::uint32_t body : moving_) {
    if (is_asleep(body)) motion.leave_velocity(body, {});
  }
}

}  // namespace talus
