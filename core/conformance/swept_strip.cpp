#include "conformance/swept_strip.hpp"

#include "conformance/driven_element.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace talus::conformance {

SweptStrip::SweptStrip(std::uint32_t count, double strain, bool wild)
    : cells(count), force_x(2 * std::size_t{count} + 2, 0.5), force_y(2 * std::size_t{count} + 2, -0.25) {
  std::mt19937 source(7);
  const auto random = [&] { return static_cast<double>(source()) / 2147483648.0 - 1; };
  const double volume = gradient[0] * gradient[3] - gradient[1] * gradient[2];
  const double along[2] = {gradient[3] / volume, -gradient[2] / volume},
               up[2] = {-gradient[1] / volume, gradient[0] / volume};
  const double c = std::cos(1.1) - 1, s = std::sin(1.1);
  for (const double row : {0.0, 1.0}) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double at_x = i * along[0] + row * up[0], at_y = i * along[1] + row * up[1];
      const double moved = strain / 4 + (wild && i % 5 == 3 ? 0.025 : 0);
      x.push_back(c * at_x - s * at_y + moved * random());
      y.push_back(s * at_x + c * at_y + moved * random());
    }
  }
}

double SweptStrip::sweep(const Material& law) {
  const std::uint32_t top = cells + 1;
  LatticeCells given{cells,
                     {},
                     area,
                     x.data(),
                     y.data(),
                     x.data() + top,
                     y.data() + top,
                     force_x.data(),
                     force_y.data(),
                     force_x.data() + top,
                     force_y.data() + top,
                     {}};
  std::copy(gradient.begin(), gradient.end(), given.gradient);
  return law.sweep(given);
}

double SweptStrip::sweep_as_chain(const Material& law, bool beside) {
  const std::uint32_t stride = beside ? 2 : 1, all = 2 * cells + 2, top = cells + 1;
  const std::uint32_t to_y = beside ? 1 : all;
  std::vector<std::uint32_t> corner;
  std::vector<double> gradients[4], areas;
  const auto add = [&](std::uint32_t at, double its_area, const std::array<double, 4>& its_gradient) {
    corner.push_back(stride * at);
    for (std::size_t k = 0; k < 4; ++k) gradients[k].push_back(its_gradient[k]);
    areas.push_back(its_area);
  };
  const auto add_without_triangle = [&](std::uint32_t at) { add(at, 0, {}); };
  const auto& g = gradient;
  for (std::uint32_t i = 0; i < TriangleChain::links_before; ++i) add_without_triangle(0);
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    if (cell % 5 == 0) {  // a strip ends, and another begins
      add_without_triangle(cell);
      add_without_triangle(top + cell);
    }
    add(cell + 1, area, {g[2], g[3], g[0], g[1]});
    add(top + cell + 1, area, {-g[2], -g[3], g[0] + g[2], g[1] + g[3]});
  }
  const auto links = [&] { return static_cast<std::uint32_t>(corner.size()) - TriangleChain::links_before; };
  for (std::uint32_t i = 0; i < TriangleChain::links_after || links() % TriangleChain::multiple != 0; ++i)
    add_without_triangle(0);

  std::vector<double> at(2 * std::size_t{all}), force(2 * std::size_t{all});
  for (std::size_t i = 0; i < all; ++i) {
    at[stride * i] = x[i];
    at[stride * i + to_y] = y[i];
    force[stride * i] = force_x[i];
    force[stride * i + to_y] = force_y[i];
  }
  constexpr std::uint32_t first = TriangleChain::links_before;
  const TriangleChain chain{links(),
                            beside ? 1U : 0U,
                            corner.data() + first,
                            {gradients[0].data() + first, gradients[1].data() + first,
                             gradients[2].data() + first, gradients[3].data() + first},
                            areas.data() + first,
                            at.data(),
                            at.data() + to_y,
                            force.data(),
                            force.data() + to_y,
                            {}};
  const double stored = law.sweep(chain);
  for (std::size_t i = 0; i < all; ++i) {
    force_x[i] = force[stride * i];
    force_y[i] = force[stride * i + to_y];
  }
  return stored;
}

double SweptStrip::one_by_one(const Material& law) {
  double stored = 0;
  for (std::uint32_t e = 0; e < 2 * cells; ++e) {
    const std::array<std::uint32_t, 3> at = corners_of(e);
    Tensor f{1, 0, 0, 1};
    double g[4];
    for (std::size_t k = 0; k < 4; ++k) g[k] = sign_of(e) * gradient[k];
    for (std::size_t k = 0; k < 2; ++k) {
      const double edge_x = x[at[k + 1]] - x[at[0]], edge_y = y[at[k + 1]] - y[at[0]];
      f[0] += edge_x * g[2 * k];
      f[1] += edge_x * g[2 * k + 1];
      f[2] += edge_y * g[2 * k];
      f[3] += edge_y * g[2 * k + 1];
    }
    const Response response = DrivenElement(law).to(f);
    const Tensor& p = response.stress;
    stored += area * response.energy;
    for (std::size_t k = 0; k < 2; ++k) {
      const double pull_x = area * (p[0] * g[2 * k] + p[1] * g[2 * k + 1]),
                   pull_y = area * (p[2] * g[2 * k] + p[3] * g[2 * k + 1]);
      force_x[at[k + 1]] -= pull_x;
      force_y[at[k + 1]] -= pull_y;
      force_x[at[0]] += pull_x;
      force_y[at[0]] += pull_y;
    }
  }
  return stored;
}

std::array<std::uint32_t, 3> SweptStrip::corners_of(std::uint32_t element) const {
  const std::uint32_t cell = element % cells, top = cells + 1;
  if (element < cells) return {cell, cell + 1, top + cell};
  return {top + cell + 1, top + cell, cell + 1};
}

double largest_difference(const SweptStrip& p, const SweptStrip& q) {
  double largest = 0;
  for (std::size_t i = 0; i < p.force_x.size(); ++i) {
    const double each = std::abs(p.force_x[i] - q.force_x[i]) + std::abs(p.force_y[i] - q.force_y[i]);
    if (!(each <= largest)) largest = each;
  }
  return largest;
}

}  // namespace talus::conformance
