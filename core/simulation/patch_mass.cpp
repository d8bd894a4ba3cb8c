#include "simulation/patch_mass.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace talus {
namespace {

/// Deviation of a patch from the affine continuation, rᵀ v.
template <class Values>
Vec2 deviation(const SteadyPatch& steady, const Values& values) {
  Vec2 sum = values[steady.patch];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 other = values[steady.to.patch[i]];
    sum.x -= steady.to.weight[i] * other.x;
    sum.y -= steady.to.weight[i] * other.y;
  }
  return sum;
}

std::vector<SteadyPatch> heavier_patches(const Model& model, const Body& body) {
  const CoverRanges& ranges = model.ranges(body);
  std::vector<SteadyPatch> result;
  for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s) {
    if (std::isfinite(model.steady[s].inertia)) result.push_back(model.steady[s]);
  }
  return result;
}

}  // namespace

PatchMass::PatchMass(const Model& model) : core_inverse_(model.steady.empty() ? 0 : model.bodies.size()) {
  inverse_.reserve(model.patch_mass.size());
  for (const double mass : model.patch_mass) inverse_.push_back(mass > 0 ? 1 / mass : 0);
  if (model.steady.empty()) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    const CoverRanges& ranges = model.ranges(body);
    const std::vector<SteadyPatch> heavier = heavier_patches(model, body);
    if (heavier.empty()) continue;
    const auto count = static_cast<Eigen::Index>(heavier.size());
    const auto patches = static_cast<Eigen::Index>(ranges.patch_end - ranges.patch_begin);
    Eigen::MatrixXd deviations = Eigen::MatrixXd::Zero(patches, count);
    Eigen::VectorXd mass(patches);
    for (Eigen::Index p = 0; p < patches; ++p) {
      const double own = model.patch_mass[ranges.patch_begin + static_cast<std::uint32_t>(p)];
      mass[p] = own > 0 ? own : 1;  // of a tied patch: no deviation names it
    }
    Eigen::MatrixXd core = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index s = 0; s < count; ++s) {
      const SteadyPatch& steady = heavier[static_cast<std::size_t>(s)];
      deviations(steady.patch - ranges.patch_begin, s) = 1;
      for (std::size_t i = 0; i < 3; ++i)
        deviations(steady.to.patch[i] - ranges.patch_begin, s) -= steady.to.weight[i];
      core(s, s) = 1 / steady.inertia;
    }
    core += deviations.transpose() * mass.cwiseInverse().asDiagonal() * deviations;
    const Eigen::MatrixXd inverse = core.llt().solve(Eigen::MatrixXd::Identity(count, count));
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < count; ++j) core_inverse_[b].push_back(inverse(i, j));
    }
  }
}

void PatchMass::accelerations(const Model& model, std::uint32_t index, std::uint32_t first,
                              PatchValues patches) const {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s) {
    const SteadyPatch& steady = model.steady[s];
    if (std::isfinite(steady.inertia)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      patches[steady.to.patch[i]].x += steady.to.weight[i] * patches[steady.patch].x;
      patches[steady.to.patch[i]].y += steady.to.weight[i] * patches[steady.patch].y;
    }
  }
  for (std::uint32_t p = first; p < ranges.patch_end; ++p) {
    patches[p].x *= inverse_[p];
    patches[p].y *= inverse_[p];
  }
  const std::span<const double> core = core_inverse(index);
  if (!core.empty()) {
    static thread_local std::vector<Vec2> deviations;  // keeps its room: a step asks for no memory
    deviations.clear();
    for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s) {
      if (std::isfinite(model.steady[s].inertia)) deviations.push_back(deviation(model.steady[s], patches));
    }
    const double* row = core.data();
    for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s) {
      const SteadyPatch& steady = model.steady[s];
      if (!std::isfinite(steady.inertia)) continue;
      Vec2 pull;
      for (const Vec2& each : deviations) {
        pull.x += *row * each.x;
        pull.y += *row++ * each.y;
      }
      const auto give = [&](std::uint32_t patch, double factor) {
        patches[patch].x -= factor * pull.x * inverse_[patch];
        patches[patch].y -= factor * pull.y * inverse_[patch];
      };
      give(steady.patch, 1);
      for (std::size_t k = 0; k < 3; ++k) give(steady.to.patch[k], -steady.to.weight[k]);
    }
  }
  tie(model, index, patches);
}

void PatchMass::tie(const Model& model, std::uint32_t index, PatchValues patches) {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s) {
    const SteadyPatch& steady = model.steady[s];
    if (std::isfinite(steady.inertia)) continue;
    Vec2 sum;
    for (std::size_t i = 0; i < 3; ++i) {
      sum.x += steady.to.weight[i] * patches[steady.to.patch[i]].x;
      sum.y += steady.to.weight[i] * patches[steady.to.patch[i]].y;
    }
    patches[steady.patch] = sum;
  }
}

double PatchMass::product(const Model& model, std::uint32_t index, std::uint32_t first,
                          std::span<const Vec2> p, std::span<const Vec2> q) const {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  double sum = 0;
  for (std::uint32_t i = first; i < ranges.patch_end; ++i) {
    const Vec2 a = p[i - first], b = q[i - first];
    sum += model.patch_mass[i] * (a.x * b.x + a.y * b.y);
  }
  if (core_inverse(index).empty()) return sum;
  for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s) {
    const SteadyPatch& steady = model.steady[s];
    if (!std::isfinite(steady.inertia)) continue;
    const Vec2 a = deviation(steady, ConstPatchValues(p, first)),
               b = deviation(steady, ConstPatchValues(q, first));
    sum += steady.inertia * (a.x * b.x + a.y * b.y);
  }
  return sum;
}

}  // namespace talus
