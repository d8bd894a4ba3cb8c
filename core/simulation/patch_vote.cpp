#include "simulation/body_vote.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>

namespace talus {
namespace {

constexpr int most_steps = 200;        ///< of Lanczos; some 30 suffice
constexpr double close_enough = 1e-4;  ///< relative residual at which it ends

using Field = std::vector<Vec2>;  ///< on the patches of the body
using Operator = std::function<void(ConstPatchValues from, PatchValues to)>;

struct Tangent {
  std::array<double, 9> d{};
  double viscous_time = 0;
};

/// Adds factor · Bᵀ D B v A of the elements of a body. Some are strained before any of them pulls: what is
/// read of a patch would wait for what has just been written of it, which lies as many whole pages away.
void add_elastic(const Model& model, const Body& body, const Tangent& tangent, double factor,
                 ConstPatchValues from, PatchValues to) {
  constexpr std::uint32_t at_once = 64;
  std::array<double, 9> d = tangent.d;
  for (double& entry : d) entry *= factor;
  std::array<std::array<double, 3>, at_once> stress;  // times area
  const std::uint32_t first = model.first_element(body), end = first + body.element_end - body.element_begin;
  for (std::uint32_t begin = first; begin < end; begin += at_once) {
    const std::uint32_t count = std::min(at_once, end - begin);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Matrix2 h = gradient(model.elements[begin + i], from);
      const double area = model.element_area[begin + i];
      const std::array<double, 3> strain{area * h.xx, area * h.yy, area * (h.xy + h.yx)};
      for (std::size_t r = 0; r < 3; ++r)
        stress[i][r] = d[3 * r] * strain[0] + d[3 * r + 1] * strain[1] + d[3 * r + 2] * strain[2];
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const Element& element = model.elements[begin + i];
      __builtin_prefetch(&model.elements[std::min(begin + i + at_once, end - 1)]);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 g = element.gradient[k];
        Vec2& force = to[element.patch[k]];
        force.x += stress[i][0] * g.x + stress[i][2] * g.y;
        force.y += stress[i][2] * g.x + stress[i][1] * g.y;
      }
    }
  }
}

void add_load(const Carrier& carrier, double size, Vec2 direction, PatchValues to) {
  for (std::size_t k = 0; k < 3; ++k) {
    to[carrier.patch[k]].x += carrier.weight[k] * size * direction.x;
    to[carrier.patch[k]].y += carrier.weight[k] * size * direction.y;
  }
}

/// Halves of springs or of dashpots of a side, as SideSprings has them.
struct Strengths {
  double across;
  Reach reach;  ///< of those across
  double along, support;
};

/// Adds the springs or dashpots of each side.
template <class StrengthsOf>
void add_springs(const Model& model, const Body& body, const SpringsOfSides& springs,
                 const StrengthsOf& strengths_of, ConstPatchValues from, PatchValues to) {
  const CoverRanges& ranges = model.ranges(body);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const BoundarySide& side = model.sides[ranges.side_begin + i];
    const Vec2 start = side.start.reference, end = side.end.reference;
    const double length =
        std::sqrt((end.x - start.x) * (end.x - start.x) + (end.y - start.y) * (end.y - start.y));
    if (!(length > 0)) continue;
    const Vec2 along = (end - start) / length, across{along.y, -along.x};
    const Strengths strengths = strengths_of(springs[i]);
    const auto add = [&](Vec2 direction, double half, Reach reach) {
      const double first = dot(carried(side.start.carrier, from), direction),
                   last = dot(carried(side.end.carrier, from), direction);
      const double mean = half * reach.mean * (first + last) / 2,
                   change = 2 * half * reach.change * (last - first);
      add_load(side.start.carrier, mean - change, direction, to);
      add_load(side.end.carrier, mean + change, direction, to);
    };
    add(across, strengths.across, strengths.reach);
    add(across, strengths.support, at_ends);
    add(along, strengths.along + strengths.support, at_ends);  // one overlap may load one side of many
  }
}

/// The largest eigenvalue of a tridiagonal matrix and the last component of its vector.
struct TopMode {
  double value, last;
};

/// By Newton's method on the characteristic polynomial, from `bound` above all its roots; with q the last of
/// the pivots the component is 1/√−q′. Good to 1e-6, at a small part of what all modes cost.
TopMode estimate_top_mode(const std::vector<double>& diagonal, const std::vector<double>& beside,
                          double bound) {
  double value = bound, slope = -1;
  for (int round = 0; round < 100; ++round) {
    double pivot = diagonal[0] - value, inverse_step = -1 / pivot;
    slope = -1;
    for (std::size_t i = 1; i < diagonal.size(); ++i) {
      const double ratio = beside[i - 1] / pivot;
      slope = -1 + ratio * ratio * slope;
      pivot = diagonal[i] - value - ratio * beside[i - 1];
      inverse_step += slope / pivot;
    }
    const double step = 1 / inverse_step;
    if (!(step > 1e-12 * std::abs(value))) break;
    value -= step;
  }
  return {value, 1 / std::sqrt(-slope)};
}

/// The same to rounding.
TopMode find_top_mode(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const Eigen::Map<const Eigen::VectorXd> d(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
  const Eigen::Map<const Eigen::VectorXd> e(beside.data(), static_cast<Eigen::Index>(beside.size()));
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(d, e);
  const Eigen::Index last = solver.eigenvalues().size() - 1;
  return {solver.eigenvalues()[last], std::abs(solver.eigenvectors()(last, last))};
}

/// Largest eigenvalue of M⁻¹A, with the residual of its approximation on top.
double largest_eigenvalue(const Model& model, const PatchMass& mass, std::uint32_t index,
                          const Operator& apply) {
  const Body& body = model.bodies[index];
  const CoverRanges& ranges = model.ranges(body);
  const auto product = [&](const Field& p, const Field& q) { return mass.product(model, index, p, q); };
  const auto add = [&](Field& to, double factor, const Field& from) {
    for (std::size_t p = 0; p < to.size(); ++p) {
      to[p].x += factor * from[p].x;
      to[p].y += factor * from[p].y;
    }
  };
  const auto by_number = [&](Field& field) { return PatchValues(field, ranges.patch_begin); };
  Field now(ranges.patch_end - ranges.patch_begin), before(now.size()), image(now.size());
  std::uint64_t seed = 1;  // any start with a share of the mode sought will do; the same every time
  const auto random = [&] {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(seed >> 40) / 16777216.0 - 0.5;
  };
  for (Vec2& v : now) v = {random(), random()};
  PatchMass::tie(model, index, by_number(now));
  const double size = std::sqrt(product(now, now));
  for (Vec2& v : now) v = v / size;

  std::vector<double> diagonal, beside;
  double coupling = 0, bound = 0, best = 0;
  for (int step = 0; step < most_steps; ++step) {
    std::fill(image.begin(), image.end(), Vec2{});
    apply({now, ranges.patch_begin}, by_number(image));
    mass.accelerations(model, index, by_number(image));
    diagonal.push_back(product(now, image));
    add(image, -diagonal.back(), now);
    add(image, -coupling, before);
    bound = std::max(bound, diagonal.back()) + coupling;
    coupling = std::sqrt(std::max(0.0, product(image, image)));
    const TopMode near = estimate_top_mode(diagonal, beside, bound);
    const bool goes_on = coupling * near.last > 1.1 * close_enough * std::abs(near.value);
    if (!goes_on || step + 1 == most_steps) {
      const TopMode top = find_top_mode(diagonal, beside);
      const double residual = coupling * top.last;
      best = top.value + residual;
      if (residual <= close_enough * std::abs(top.value) || !(coupling > 0)) break;
    }
    bound = near.value;
    beside.push_back(coupling);
    before.swap(now);
    for (std::size_t p = 0; p < now.size(); ++p) now[p] = image[p] / coupling;
  }
  return std::max(0.0, best);
}

}  // namespace

BodyVote vote_of_patches(const Scene& scene, const Model& model, const PatchMass& mass, std::uint32_t index,
                         const SpringsOfSides& springs, double factor) {
  const Body& body = model.bodies[index];
  const Choice& choice = scene.materials[scene.bodies[index].material].model;
  const auto material = make<Material>(*choice.component, choice.values);
  Tangent tangent;
  material->stiffest_tangent(tangent.d.data());
  tangent.viscous_time = material->viscous_time();

  const Operator elastic = [&](ConstPatchValues from, PatchValues to) {
    add_elastic(model, body, tangent, 1, from, to);
  };
  const auto add_sprung = [&](double times, ConstPatchValues from, PatchValues to) {
    add_springs(
        model, body, springs,
        [times](const SideSprings& s) {
          return Strengths{times * s.normal, s.spread ? spread_evenly : at_ends, times * s.tangential,
                           s.support};
        },
        from, to);
  };
  const Operator among_fixed = [&](ConstPatchValues from, PatchValues to) { add_sprung(1, from, to); };
  const Operator stiffness = [&](ConstPatchValues from, PatchValues to) {
    elastic(from, to);
    add_sprung(factor, from, to);
  };
  const Operator damping = [&](ConstPatchValues from, PatchValues to) {
    if (tangent.viscous_time > 0) add_elastic(model, body, tangent, tangent.viscous_time, from, to);
    add_springs(
        model, body, springs,
        [](const SideSprings& s) {
          return Strengths{s.normal_damping, s.spread ? spread_dashpot : at_ends, s.tangential_damping,
                           s.support_damping};
        },
        from, to);
  };
  const auto any = [&](const auto& wanted) { return std::any_of(springs.begin(), springs.end(), wanted); };
  const bool has_springs = any([](const SideSprings& s) { return s.normal + s.tangential + s.support > 0; });
  const bool damped = tangent.viscous_time > 0 || any([](const SideSprings& s) {
                        return s.normal_damping + s.tangential_damping + s.support_damping > 0;
                      });
  BodyVote vote;
  vote.elastic_lambda = largest_eigenvalue(model, mass, index, elastic);
  vote.lambda = has_springs ? largest_eigenvalue(model, mass, index, stiffness) : vote.elastic_lambda;
  if (has_springs) vote.spring_lambda = largest_eigenvalue(model, mass, index, among_fixed);
  if (damped) vote.gamma = largest_eigenvalue(model, mass, index, damping);
  return vote;
}

}  // namespace talus
