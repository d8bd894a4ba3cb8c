#include "kernels/elements.hpp"

namespace talus::kernels::TALUS_KERNEL_LEVEL {
namespace {

/// Eight lanes, in as many vectors as it takes; the compiler divides them.
using Lanes [[gnu::vector_size(8 * lanes)]] = double;
using LanesAnywhere [[gnu::vector_size(8 * lanes), gnu::aligned(8), gnu::may_alias]] = double;

double sum_of(const Lanes& lane) {
  return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

/// Puts `count` values into the first lanes. Vectors pass by reference: by value they would not be the same
/// to every instruction set.
void fill(const double* value, std::uint32_t count, Lanes& first) {
  for (std::uint32_t k = 0; k < count; ++k) first[k] = value[k];
}

const LanesAnywhere& at(const double* value) {
  return *reinterpret_cast<const LanesAnywhere*>(value);
}
LanesAnywhere& at(double* value) {
  return *reinterpret_cast<LanesAnywhere*>(value);
}

void move(std::uint32_t count, double dt, double* __restrict d, const double* __restrict v,
          double* __restrict x, double* __restrict y) {
  for (std::uint32_t i = 0; i < 2 * count; ++i) d[i] += dt * v[i];
  for (std::uint32_t i = 0; i < count; ++i) {
    x[i] = d[2 * i];
    y[i] = d[2 * i + 1];
  }
}

void lattice_gradient(std::uint32_t cells, const double gradient[4], const double* __restrict bottom_x,
                      const double* __restrict bottom_y, const double* __restrict top_x,
                      const double* __restrict top_y, double* const f[4]) {
  const double g1x = gradient[0], g1y = gradient[1], g2x = gradient[2], g2y = gradient[3];
  double* __restrict fxx = f[0], * __restrict fxy = f[1], * __restrict fyx = f[2], * __restrict fyy = f[3];
#pragma GCC ivdep
  for (std::uint32_t c = 0; c < cells; ++c) {
    const double along_x = bottom_x[c + 1] - bottom_x[c], along_y = bottom_y[c + 1] - bottom_y[c];
    const double up_x = top_x[c] - bottom_x[c], up_y = top_y[c] - bottom_y[c];
    fxx[c] = 1 + (along_x * g1x + up_x * g2x);
    fxy[c] = along_x * g1y + up_x * g2y;
    fyx[c] = along_y * g1x + up_y * g2x;
    fyy[c] = 1 + (along_y * g1y + up_y * g2y);
  }
#pragma GCC ivdep
  for (std::uint32_t c = 0; c < cells; ++c) {
    const double along_x = top_x[c + 1] - top_x[c], along_y = top_y[c + 1] - top_y[c];
    const double up_x = top_x[c + 1] - bottom_x[c + 1], up_y = top_y[c + 1] - bottom_y[c + 1];
    fxx[cells + c] = 1 + (along_x * g1x + up_x * g2x);
    fxy[cells + c] = along_x * g1y + up_x * g2y;
    fyx[cells + c] = along_y * g1x + up_y * g2x;
    fyy[cells + c] = 1 + (along_y * g1y + up_y * g2y);
  }
}

void lattice_force(std::uint32_t cells, const double gradient[4], double area, const double* const p[4],
                   double* __restrict bottom_x, double* __restrict bottom_y, double* __restrict top_x,
                   double* __restrict top_y, double* __restrict spare) {
  const double g1x = area * gradient[0], g1y = area * gradient[1];
  const double g2x = area * gradient[2], g2y = area * gradient[3];
  const double* __restrict pxx = p[0], * __restrict pxy = p[1], * __restrict pyx = p[2], * __restrict pyy = p[3];
  // What a cell gives to its left and to its right corner of each row.
  const std::uint32_t length = cells + 1;
  double* __restrict left_bottom_x = spare, * __restrict left_bottom_y = spare + length;
  double* __restrict left_top_x = spare + 2 * length, * __restrict left_top_y = spare + 3 * length;
  double* __restrict right_bottom_x = spare + 4 * length, * __restrict right_bottom_y = spare + 5 * length;
  double* __restrict right_top_x = spare + 6 * length, * __restrict right_top_y = spare + 7 * length;
#pragma GCC ivdep
  for (std::uint32_t c = 0; c < cells; ++c) {
    const double lower1_x = pxx[c] * g1x + pxy[c] * g1y, lower1_y = pyx[c] * g1x + pyy[c] * g1y;
    const double lower2_x = pxx[c] * g2x + pxy[c] * g2y, lower2_y = pyx[c] * g2x + pyy[c] * g2y;
    const std::uint32_t u = cells + c;
    const double upper1_x = pxx[u] * g1x + pxy[u] * g1y, upper1_y = pyx[u] * g1x + pyy[u] * g1y;
    const double upper2_x = pxx[u] * g2x + pxy[u] * g2y, upper2_y = pyx[u] * g2x + pyy[u] * g2y;
    left_bottom_x[c] = lower1_x + lower2_x;
    left_bottom_y[c] = lower1_y + lower2_y;
    right_bottom_x[c + 1] = upper2_x - lower1_x;
    right_bottom_y[c + 1] = upper2_y - lower1_y;
    left_top_x[c] = upper1_x - lower2_x;
    left_top_y[c] = upper1_y - lower2_y;
    right_top_x[c + 1] = upper1_x + upper2_x;
    right_top_y[c + 1] = upper1_y + upper2_y;
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    spare[k * length + cells] = 0;
    spare[(4 + k) * length] = 0;
  }
  for (std::uint32_t c = 0; c < length; ++c) {
    bottom_x[c] += left_bottom_x[c] + right_bottom_x[c];
    bottom_y[c] += left_bottom_y[c] + right_bottom_y[c];
    top_x[c] += left_top_x[c] - right_top_x[c];
    top_y[c] += left_top_y[c] - right_top_y[c];
  }
}

void triangle_gradient(std::uint32_t count, const Triangles& t, const double* __restrict x,
                       const double* __restrict y, double* const f[4]) {
  const std::uint32_t* __restrict i0 = t.corner[0], * __restrict i1 = t.corner[1], * __restrict i2 = t.corner[2];
  const double* __restrict g1x = t.gradient[0], * __restrict g1y = t.gradient[1], * __restrict g2x = t.gradient[2], * __restrict g2y = t.gradient[3];
  double* __restrict fxx = f[0], * __restrict fxy = f[1], * __restrict fyx = f[2], * __restrict fyy = f[3];
#pragma GCC ivdep
  for (std::uint32_t e = 0; e < count; ++e) {
    const double x0 = x[i0[e]], y0 = y[i0[e]];
    const double x1 = x[i1[e]] - x0, y1 = y[i1[e]] - y0, x2 = x[i2[e]] - x0, y2 = y[i2[e]] - y0;
    fxx[e] = 1 + (x1 * g1x[e] + x2 * g2x[e]);
    fxy[e] = x1 * g1y[e] + x2 * g2y[e];
    fyx[e] = y1 * g1x[e] + y2 * g2x[e];
    fyy[e] = 1 + (y1 * g1y[e] + y2 * g2y[e]);
  }
}

void triangle_force(std::uint32_t count, const Triangles& t, const double* const p[4], double* __restrict fx,
                    double* __restrict fy, double* __restrict spare) {
  const double* __restrict g1x = t.gradient[0], * __restrict g1y = t.gradient[1], * __restrict g2x = t.gradient[2], * __restrict g2y = t.gradient[3], * __restrict area = t.area;
  const double* __restrict pxx = p[0], * __restrict pxy = p[1], * __restrict pyx = p[2], * __restrict pyy = p[3];
  double* __restrict second_x = spare, * __restrict second_y = spare + count;
  double* __restrict third_x = spare + 2 * count, * __restrict third_y = spare + 3 * count;
#pragma GCC ivdep
  for (std::uint32_t e = 0; e < count; ++e) {
    second_x[e] = area[e] * (pxx[e] * g1x[e] + pxy[e] * g1y[e]);
    second_y[e] = area[e] * (pyx[e] * g1x[e] + pyy[e] * g1y[e]);
    third_x[e] = area[e] * (pxx[e] * g2x[e] + pxy[e] * g2y[e]);
    third_y[e] = area[e] * (pyx[e] * g2x[e] + pyy[e] * g2y[e]);
  }
  for (std::uint32_t e = 0; e < count; ++e) {
    const std::uint32_t i0 = t.corner[0][e], i1 = t.corner[1][e], i2 = t.corner[2][e];
    fx[i0] += second_x[e] + third_x[e];
    fy[i0] += second_y[e] + third_y[e];
    fx[i1] -= second_x[e];
    fy[i1] -= second_y[e];
    fx[i2] -= third_x[e];
    fy[i2] -= third_y[e];
  }
}

double sum(std::uint32_t count, const double* value) {
  Lanes total{};
  std::uint32_t i = 0;
  for (; i + lanes <= count; i += lanes) total += at(value + i);
  Lanes rest{};
  fill(value + i, count - i, rest);
  total += rest;
  return sum_of(total);
}

double weighted_sum(std::uint32_t count, const double* weight, const double* value) {
  Lanes total{};
  std::uint32_t i = 0;
  for (; i + lanes <= count; i += lanes) total += at(weight + i) * at(value + i);
  Lanes rest{}, rest_weight{};
  fill(value + i, count - i, rest);
  fill(weight + i, count - i, rest_weight);
  total += rest_weight * rest;
  return sum_of(total);
}

namespace {

struct Products {
  Lanes before{}, across{}, after{}, momentum{};

  void add(bool all, const Lanes& mass, const Lanes& v, const Lanes& next) {
    across += mass * (v * next);
    if (!all) return;
    before += mass * (v * v);
    after += mass * (next * next);
    momentum += mass * v;
  }
};

/// v := keep v + gain a of `count` numbers, with the products of old and new.
template <bool all, bool weighted>
void update(std::uint32_t count, double keep, double gain, const double* acceleration, const double* mass,
            double* v, Products& products) {
  Lanes weight = Lanes{} + 1;
  std::uint32_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const Lanes old = at(v + i), next = keep * old + gain * at(acceleration + i);
    if (weighted) weight = at(mass + i);
    products.add(all, weight, old, next);
    at(v + i) = next;
  }
  const std::uint32_t rest = count - i;
  Lanes old{}, change{};
  fill(v + i, rest, old);
  fill(acceleration + i, rest, change);
  if (weighted) fill(mass + i, rest, weight);
  const Lanes next = keep * old + gain * change;
  products.add(all, weight, old, next);
  for (std::uint32_t k = 0; k < rest; ++k) v[i + k] = next[k];
}

}  // namespace

void accelerate(std::uint32_t count, const VelocityUpdate& how, bool same_mass, const double* __restrict mass,
                const double* __restrict inverse_mass, const double* __restrict fx,
                const double* __restrict fy, double* __restrict v, double* __restrict middle, double share,
                double* __restrict spare, VelocitySums& sums) {
  const double gravity_x = how.gravity[0], gravity_y = how.gravity[1];
  double* __restrict acceleration = spare, * __restrict weight = spare + 2 * count;
  // x and y beside each other.
  if (same_mass) {
    const double inverse = inverse_mass[0];
    for (std::uint32_t i = 0; i < count; ++i) {
      acceleration[2 * i] = fx[i] * inverse + gravity_x;
      acceleration[2 * i + 1] = fy[i] * inverse + gravity_y;
    }
  } else {
    for (std::uint32_t i = 0; i < count; ++i) {
      acceleration[2 * i] = fx[i] * inverse_mass[i] + gravity_x;
      acceleration[2 * i + 1] = fy[i] * inverse_mass[i] + gravity_y;
      weight[2 * i] = weight[2 * i + 1] = mass[i];
    }
  }
  if (middle != nullptr) {
    for (std::uint32_t i = 0; i < 2 * count; ++i)
      middle[i] = v[i] + share * (how.keep * v[i] + how.gain * acceleration[i] - v[i]);
  }
  Products products;
  if (same_mass && !how.all_sums) {
    update<false, false>(2 * count, how.keep, how.gain, acceleration, weight, v, products);
  } else if (same_mass) {
    update<true, false>(2 * count, how.keep, how.gain, acceleration, weight, v, products);
  } else if (!how.all_sums) {
    update<false, true>(2 * count, how.keep, how.gain, acceleration, weight, v, products);
  } else {
    update<true, true>(2 * count, how.keep, how.gain, acceleration, weight, v, products);
  }
  const double factor = same_mass ? mass[0] : 1;
  sums.across += factor * sum_of(products.across);
  sums.before += factor * sum_of(products.before);
  sums.after += factor * sum_of(products.after);
  const Lanes& m = products.momentum;
  sums.momentum[0] += factor * ((m[0] + m[2]) + (m[4] + m[6]));
  sums.momentum[1] += factor * ((m[1] + m[3]) + (m[5] + m[7]));
}

}  // namespace

extern const ElementKernels element_kernels;
const ElementKernels element_kernels{move, lattice_gradient, lattice_force, triangle_gradient, triangle_force,
                                     sum,  weighted_sum,     accelerate};

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
