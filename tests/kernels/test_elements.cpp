#include "kernels/level.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace talus::kernels;
using talus::best_simd_level;
using talus::SimdLevel;
using talus::TriangleChain;

namespace {

/// Those that this machine has.
std::vector<SimdLevel> levels() {
  std::vector<SimdLevel> all;
  for (int i = 0; i <= static_cast<int>(best_simd_level()); ++i) all.push_back(static_cast<SimdLevel>(i));
  return all;
}

struct Random {
  std::mt19937 source{11};
  double operator()() { return static_cast<double>(source()) / 2147483648.0 - 1; }
  std::vector<double> numbers(std::size_t count, double shift = 0) {
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back((*this)() + shift);
    return result;
  }
};

/// Four arrays, xx, xy, yx, yy.
struct Tensors {
  std::vector<double> component[4];
  std::array<double*, 4> rows{};

  explicit Tensors(std::size_t count, Random* random = nullptr) {
    for (std::size_t k = 0; k < 4; ++k) {
      component[k] = random != nullptr ? random->numbers(count) : std::vector<double>(count);
      rows[k] = component[k].data();
    }
  }
};

/// Vectors of patches, apart or beside each other.
struct Vectors {
  std::vector<double> value;
  LocalVectors local;

  Vectors(const std::vector<double>& x, const std::vector<double>& y, bool apart) : value(2 * x.size()) {
    double* first = value.data();
    local = apart ? LocalVectors{first, first + x.size(), 1} : LocalVectors{first, first + 1, 2};
    for (std::uint32_t i = 0; i < x.size(); ++i) {
      *local.from(i).x = x[i];
      *local.from(i).y = y[i];
    }
  }
};

/// The cells of a lattice, whose corners are numbered bottom row 0, 1, ..., then top row, as a chain that
/// breaks off after each third cell. Vectors apart or beside each other.
struct CellsAsChain {
  std::vector<std::uint32_t> corner;
  std::vector<double> gradient[4], area;
  std::vector<std::size_t> cell_order;  ///< [triangle] its place among lower triangles, then upper ones
  std::uint32_t stride;

  CellsAsChain(std::uint32_t cells, const std::array<double, 4>& g, double each, bool apart)
      : stride(apart ? 1 : 2) {
    const std::uint32_t top = cells + 1;
    for (std::uint32_t i = 0; i < TriangleChain::links_before; ++i) add(0, {}, 0);
    for (std::uint32_t c = 0; c < cells; ++c) {
      if (c % 3 == 0) {
        add(c, {}, 0);
        add(top + c, {}, 0);
      }
      add(c + 1, {g[2], g[3], g[0], g[1]}, each);
      add(top + c + 1, {-g[2], -g[3], g[0] + g[2], g[1] + g[3]}, each);
      cell_order.insert(cell_order.end(), {c, cells + c});
    }
    for (std::uint32_t i = 0; i < TriangleChain::links_after || count() % TriangleChain::multiple != 0; ++i)
      add(0, {}, 0);
  }
  std::uint32_t count() const {
    return static_cast<std::uint32_t>(corner.size()) - TriangleChain::links_before;
  }
  void add(std::uint32_t at, const std::array<double, 4>& g, double each) {
    corner.push_back(stride * at);
    for (std::size_t k = 0; k < 4; ++k) gradient[k].push_back(g[k]);
    area.push_back(each);
  }
  TriangleChain chain(const LocalVectors& at, const LocalVectors& force) const {
    constexpr std::size_t first = TriangleChain::links_before;
    return {count(),
            stride - 1,
            corner.data() + first,
            {gradient[0].data() + first, gradient[1].data() + first, gradient[2].data() + first,
             gradient[3].data() + first},
            area.data() + first,
            at.x,
            at.y,
            force.x,
            force.y,
            {}};
  }
};

const std::array<double, 4> steep{2.5, -1.25, 0.5, 3};

}  // namespace

TEST_CASE("cells of a lattice strain like the triangles that they are", "[kernels]") {
  const ElementKernels& loops = element_kernels(GENERATE(from_range(levels())));
  const bool apart = GENERATE(true, false);
  Random random;
  for (const std::uint32_t cells : {1u, 7u, 8u, 21u, 128u}) {
    const std::uint32_t row = cells + 1;
    const std::vector<double> x = random.numbers(2 * row), y = random.numbers(2 * row);
    Tensors as_cells(2 * cells), as_chain(2 * cells);
    loops.lattice_gradient(cells, steep.data(), x.data(), y.data(), x.data() + row, y.data() + row,
                           as_cells.rows.data());
    const CellsAsChain same(cells, steep, 1, apart);
    const Vectors at(x, y, apart);
    loops.chain_gradient(same.chain(at.local, {}), as_chain.rows.data());
    double largest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t e = 0; e < 2 * cells; ++e)
        largest =
            std::max(largest, std::abs(as_cells.component[k][same.cell_order[e]] - as_chain.component[k][e]));
    }
    CHECK(largest <= 1e-15 * 20);
  }
}

TEST_CASE("cells of a lattice push like the triangles that they are", "[kernels]") {
  const ElementKernels& loops = element_kernels(GENERATE(from_range(levels())));
  const bool apart = GENERATE(true, false);
  Random random;
  for (const std::uint32_t cells : {1u, 7u, 8u, 21u, 128u}) {
    const std::uint32_t row = cells + 1;
    const Tensors stress(2 * cells, &random);
    const std::vector<double> before_x = random.numbers(2 * row), before_y = random.numbers(2 * row);
    std::vector<double> x = before_x, y = before_y;
    const Vectors force(before_x, before_y, apart);
    loops.lattice_force(cells, steep.data(), 0.75, stress.rows.data(), x.data(), y.data(), x.data() + row,
                        y.data() + row);
    const CellsAsChain same(cells, steep, 0.75, apart);
    Tensors in_chain(2 * cells);
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t e = 0; e < 2 * cells; ++e)
        in_chain.component[k][e] = stress.component[k][same.cell_order[e]];
    }
    loops.chain_force(same.chain({}, force.local), in_chain.rows.data());
    double largest = 0, sum_x = 0, moved = 0;
    for (std::size_t i = 0; i < 2 * row; ++i) {
      const LocalVectors at = force.local.from(static_cast<std::uint32_t>(i));
      largest = std::max({largest, std::abs(x[i] - *at.x), std::abs(y[i] - *at.y)});
      sum_x += x[i] - before_x[i];
      moved = std::max(moved, std::abs(x[i] - before_x[i]));
    }
    CHECK(largest <= 1e-15 * 30);
    CHECK(std::abs(sum_x) <= 1e-14 * row);  // elements push nothing but each other
    CHECK(moved > 0.1);
  }
}

namespace {

double total(const double* l) {
  return ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]));
}

}  // namespace

TEST_CASE("work of a step is the mean stress times the change, which then are those of a step ago",
          "[kernels]") {
  const ElementKernels& loops = element_kernels(GENERATE(from_range(levels())));
  Random random;
  for (const std::uint32_t count : {0u, 1u, 5u, 8u, 9u, 255u}) {
    const Tensors p(count, &random), f(count, &random);
    Tensors former_p(count, &random), former_f(count, &random);
    std::vector<double> work = random.numbers(count), due = work;
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 4; ++k)
        due[i] += (former_p.component[k][i] + p.component[k][i]) / 2 *
                  (f.component[k][i] - former_f.component[k][i]);
    }
    loops.work_of_step(count, p.rows.data(), f.rows.data(), former_p.rows.data(), former_f.rows.data(),
                       work.data());
    for (std::uint32_t i = 0; i < count; ++i) CHECK(work[i] == Approx(due[i]).margin(1e-15));
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(former_p.component[k] == p.component[k]);
      CHECK(former_f.component[k] == f.component[k]);
    }
  }
}

TEST_CASE("sums go to eight lanes, whatever the number of values", "[kernels]") {
  const ElementKernels& loops = element_kernels(GENERATE(from_range(levels())));
  Random random;
  for (const std::uint32_t count : {0u, 1u, 5u, 8u, 9u, 16u, 255u}) {
    const std::vector<double> value = random.numbers(count);
    double plain[8] = {};
    for (std::uint32_t i = 0; i < count; ++i) plain[i % 8] += value[i];
    CHECK(loops.sum(count, value.data()) == total(plain));
  }
}

TEST_CASE("sums over the triangles of a chain go to eight lanes by their links", "[kernels]") {
  const ElementKernels& loops = element_kernels(GENERATE(from_range(levels())));
  Random random;
  for (const std::uint32_t cells : {1u, 7u, 8u, 21u}) {
    CellsAsChain same(cells, steep, 1, true);
    for (double& area : same.area) area *= 2 + random();
    const std::vector<double> value = random.numbers(2 * cells);
    const TriangleChain chain = same.chain({}, {});
    double lane[8] = {};
    for (std::uint32_t i = 0, next = 0; i < chain.count; ++i) {
      if (chain.area[i] != 0) lane[i % 8] += chain.area[i] * value[next++];
    }
    CHECK(loops.chain_sum(chain, value.data()) == total(lane));
  }
}

TEST_CASE("patches take their accelerations, and the products of their velocities are right", "[kernels]") {
  const ElementKernels& loops = element_kernels(GENERATE(from_range(levels())));
  const bool apart = GENERATE(true, false);
  Random random;
  for (const std::uint32_t count : {1u, 3u, 4u, 9u, 130u}) {
    for (const bool same : {true, false}) {
      std::vector<double> mass = random.numbers(count, 3), inverse;
      if (same) std::fill(mass.begin(), mass.end(), mass[0]);
      for (const double m : mass) inverse.push_back(1 / m);
      const std::vector<double> fx = random.numbers(count), fy = random.numbers(count);
      const Vectors given(fx, fy, apart);
      const std::vector<double> before = random.numbers(2 * count);
      std::vector<double> v = before, middle(2 * count);
      VelocitySums sums{};
      const VelocityUpdate update{0.75, 0.5, {0.25, -9.81}, true};
      loops.accelerate(count, update, same, mass.data(), inverse.data(), given.local, v.data(), middle.data(),
                       0.25, sums);
      double across = 0, old = 0, after = 0, momentum[2] = {};
      for (std::uint32_t i = 0; i < 2 * count; ++i) {
        const double force = i % 2 == 0 ? fx[i / 2] : fy[i / 2], m = mass[i / 2];
        const double next = 0.75 * before[i] + 0.5 * (force * inverse[i / 2] + update.gravity[i % 2]);
        CHECK(v[i] == next);
        CHECK(middle[i] == before[i] + 0.25 * (next - before[i]));
        across += m * before[i] * next;
        old += m * before[i] * before[i];
        after += m * next * next;
        momentum[i % 2] += m * before[i];
      }
      const double scale = std::sqrt(old * after);
      CHECK(std::abs(sums.across - across) <= 1e-14 * scale);
      CHECK(std::abs(sums.before - old) <= 1e-14 * old);
      CHECK(std::abs(sums.after - after) <= 1e-14 * after);
      CHECK(std::abs(sums.momentum[0] - momentum[0]) <= 1e-14 * 4 * count);
      CHECK(std::abs(sums.momentum[1] - momentum[1]) <= 1e-14 * 4 * count);

      VelocitySums one{};
      std::vector<double> again = before;
      loops.accelerate(count, {0.75, 0.5, {0.25, -9.81}, false}, same, mass.data(), inverse.data(),
                       given.local, again.data(), nullptr, 0.25, one);
      CHECK(again == v);
      CHECK(one.across == sums.across);
      CHECK(one.before == 0);
    }
  }
}

TEST_CASE("patches move and lie down by components", "[kernels]") {
  const ElementKernels& loops = element_kernels(GENERATE(from_range(levels())));
  Random random;
  const std::vector<double> before = random.numbers(22), v = random.numbers(22);
  const Vectors at(std::vector<double>(11), std::vector<double>(11), GENERATE(true, false));
  std::vector<double> d = before;
  loops.move(11, 0.5, d.data(), v.data(), at.local);
  for (std::uint32_t i = 0; i < 11; ++i) {
    CHECK(d[2 * i] == before[2 * i] + 0.5 * v[2 * i]);
    CHECK(*at.local.from(i).x == d[2 * i]);
    CHECK(*at.local.from(i).y == d[2 * i + 1]);
  }
}
