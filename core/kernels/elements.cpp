#include "kernels/elements.hpp"

#include <talus/simd/pack.hpp>

#include <type_traits>

namespace talus::kernels::TALUS_KERNEL_LEVEL {
namespace {

using simd::Pack;

/// Packs of one level that hold the eight lanes of a sum.
constexpr std::uint32_t packs = lanes / simd::lanes, width = simd::lanes;

/// How a row is read and written: by full packs, or the first lanes of one.
struct Whole {
  static constexpr std::uint32_t count = width;

  Pack load(const double* from) const { return simd::load(from); }
  void store(Pack p, double* to) const { simd::store(p, to); }
  Pack only(Pack p) const { return p; }
  /// Of the two packs in which as many vectors lie, x beside y.
  Whole half(std::uint32_t /*which*/) const { return {}; }
};
struct First {
  std::uint32_t count;

  Pack load(const double* from) const { return simd::load_first(from, count); }
  void store(Pack p, double* to) const { simd::store_first(p, to, count); }
  Pack only(Pack p) const { return simd::only_where(simd::mask_of((1u << count) - 1), p); }
  First half(std::uint32_t which) const {
    const std::uint32_t before = which * width, all = 2 * count;
    return {all <= before ? 0 : all - before < width ? all - before : width};
  }
};

/// Calls one of two ways through a loop.
template <class Ways>
void with(bool yes, const Ways& ways) {
  if (yes) {
    ways(std::true_type());
  } else {
    ways(std::false_type());
  }
}

struct Sum {
  Pack part[packs];

  Sum() {
    for (Pack& p : part) p = 0.0;
  }
  double total() const {
    double lane[lanes];
    store(lane);
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
  }
  void store(double* lane) const {
    for (std::uint32_t k = 0; k < packs; ++k) simd::store(part[k], lane + k * width);
  }
};

/// Calls add(k, i, row) for the packs of `count` values, where value i goes to pack k of a sum.
template <class Add>
void in_lanes(std::uint32_t count, const Add& add) {
  std::uint32_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    for (std::uint32_t k = 0; k < packs; ++k) add(k, i + k * width, Whole{});
  }
  for (std::uint32_t k = 0; i < count; i += width, ++k) {
    const std::uint32_t rest = count - i < width ? count - i : width;
    add(k, i, First{rest});
  }
}

void move(std::uint32_t count, double dt, double* __restrict d, const double* __restrict v,
          const LocalVectors& at) {
  std::uint32_t i = 0;
  double* __restrict x = at.x, * __restrict y = at.y;
  if (!at.apart()) {
    for (; i < 2 * count; ++i) x[i] = d[i] += dt * v[i];
    return;
  }
  const auto some = [&](std::uint32_t from, auto row) __attribute__((always_inline)) {
    Pack both[2], apart[2];
    for (std::uint32_t k = 0; k < 2; ++k) {
      const std::uint32_t j = 2 * from + k * width;
      const auto half = row.half(k);
      both[k] = half.load(d + j) + dt * half.load(v + j);
      half.store(both[k], d + j);
    }
    simd::separate(both, apart[0], apart[1]);
    row.store(apart[0], x + from);
    row.store(apart[1], y + from);
  };
  for (; i + width <= count; i += width) some(i, Whole{});
  if (i < count) some(i, First{count - i});
}

void lattice_gradient(std::uint32_t cells, const double gradient[4], const double* bottom_x,
                      const double* bottom_y, const double* top_x, const double* top_y, double* const f[4]) {
  const Pack g1x = gradient[0], g1y = gradient[1], g2x = gradient[2], g2y = gradient[3];
  double *fxx = f[0], *fxy = f[1], *fyx = f[2], *fyy = f[3];
  const auto some = [&](std::uint32_t c, auto row) __attribute__((always_inline)) {
    const auto triangles = [&](std::uint32_t to, Pack along_x, Pack along_y, Pack up_x, Pack up_y) {
      row.store(1.0 + (along_x * g1x + up_x * g2x), fxx + to);
      row.store(along_x * g1y + up_x * g2y, fxy + to);
      row.store(along_y * g1x + up_y * g2x, fyx + to);
      row.store(1.0 + (along_y * g1y + up_y * g2y), fyy + to);
    };
    const Pack left_x = row.load(bottom_x + c), right_x = row.load(bottom_x + c + 1);
    const Pack left_y = row.load(bottom_y + c), right_y = row.load(bottom_y + c + 1);
    const Pack over_x = row.load(top_x + c), over_right_x = row.load(top_x + c + 1);
    const Pack over_y = row.load(top_y + c), over_right_y = row.load(top_y + c + 1);
    triangles(c, right_x - left_x, right_y - left_y, over_x - left_x, over_y - left_y);
    triangles(cells + c, over_right_x - over_x, over_right_y - over_y, over_right_x - right_x,
              over_right_y - right_y);
  };
  std::uint32_t c = 0;
  for (; c + width <= cells; c += width) some(c, Whole{});
  if (c < cells) some(c, First{cells - c});
}

void lattice_force(std::uint32_t cells, const double gradient[4], double area, const double* const p[4],
                   double* bottom_x, double* bottom_y, double* top_x, double* top_y) {
  const Pack g1x = area * gradient[0], g1y = area * gradient[1];
  const Pack g2x = area * gradient[2], g2y = area * gradient[3];
  const double *pxx = p[0], *pxy = p[1], *pyx = p[2], *pyy = p[3];
  // What the cells before gave to their right corners, of which the last lies here.
  Pack before_bottom_x = 0.0, before_bottom_y = 0.0, before_top_x = 0.0, before_top_y = 0.0;
  const auto some = [&](std::uint32_t c, auto cell, auto node) __attribute__((always_inline)) {
    const Pack lxx = cell.load(pxx + c), lxy = cell.load(pxy + c), lyx = cell.load(pyx + c),
               lyy = cell.load(pyy + c);
    const std::uint32_t u = cells + c;
    const Pack uxx = cell.load(pxx + u), uxy = cell.load(pxy + u), uyx = cell.load(pyx + u),
               uyy = cell.load(pyy + u);
    const auto add = [&](double* to, Pack left, Pack right, Pack& before) {
      node.store(node.load(to) + (left + simd::shifted(before, right)), to);
      before = right;
    };
    const Pack lower1_x = lxx * g1x + lxy * g1y, lower2_x = lxx * g2x + lxy * g2y;
    const Pack upper1_x = uxx * g1x + uxy * g1y, upper2_x = uxx * g2x + uxy * g2y;
    add(bottom_x + c, lower1_x + lower2_x, upper2_x - lower1_x, before_bottom_x);
    add(top_x + c, upper1_x - lower2_x, -(upper1_x + upper2_x), before_top_x);
    const Pack lower1_y = lyx * g1x + lyy * g1y, lower2_y = lyx * g2x + lyy * g2y;
    const Pack upper1_y = uyx * g1x + uyy * g1y, upper2_y = uyx * g2x + uyy * g2y;
    add(bottom_y + c, lower1_y + lower2_y, upper2_y - lower1_y, before_bottom_y);
    add(top_y + c, upper1_y - lower2_y, -(upper1_y + upper2_y), before_top_y);
  };
  std::uint32_t c = 0;
  for (; c + width <= cells; c += width) some(c, Whole{}, Whole{});
  some(c, First{cells - c}, First{cells - c + 1});
}

/// Calls some(e, row) for packs of triangles; the last row may be shorter.
template <class Some>
void in_packs(std::uint32_t count, const Some& some) {
  std::uint32_t e = 0;
  for (; e + width <= count; e += width) some(e, Whole{});
  if (e < count) some(e, First{count - e});
}

/// The patches with these numbers; lanes beyond `count` repeat the first.
template <bool apart>
simd::Packs2 patches_at(const LocalVectors& at, const std::uint32_t* number, std::uint32_t count) {
  const double* from[width];
  double both[2 * width];
  for (std::uint32_t lane = 0; lane < width; ++lane) {
    const std::uint32_t i = number[lane < count ? lane : 0];
    if constexpr (apart) {
      both[2 * lane] = at.x[i];
      both[2 * lane + 1] = at.y[i];
      from[lane] = both + 2 * lane;
    } else {
      from[lane] = at.x + i;
    }
  }
  return simd::gather_points(from);
}

template <bool apart>
void gradient_of_triangles(std::uint32_t count, const Triangles& t, const LocalVectors& at,
                           double* const f[4]) {
  double *fxx = f[0], *fxy = f[1], *fyx = f[2], *fyy = f[3];
  in_packs(
      count, [&](std::uint32_t e, auto row) __attribute__((always_inline)) {
        const simd::Packs2 first = patches_at<apart>(at, t.corner[0] + e, row.count),
                           second = patches_at<apart>(at, t.corner[1] + e, row.count) - first,
                           third = patches_at<apart>(at, t.corner[2] + e, row.count) - first;
        const Pack g1x = row.load(t.gradient[0] + e), g1y = row.load(t.gradient[1] + e),
                   g2x = row.load(t.gradient[2] + e), g2y = row.load(t.gradient[3] + e);
        row.store(1.0 + (second.x * g1x + third.x * g2x), fxx + e);
        row.store(second.x * g1y + third.x * g2y, fxy + e);
        row.store(second.y * g1x + third.y * g2x, fyx + e);
        row.store(1.0 + (second.y * g1y + third.y * g2y), fyy + e);
      });
}

void triangle_gradient(std::uint32_t count, const Triangles& t, const LocalVectors& at, double* const f[4]) {
  with(at.apart(), [&](auto apart) { gradient_of_triangles<apart>(count, t, at, f); });
}

void triangle_force(std::uint32_t count, const Triangles& t, const double* const p[4],
                    const LocalVectors& force) {
  const auto give = [&](std::uint32_t i, double x, double y) __attribute__((always_inline)) {
    force.x[i] += x;
    force.y[i] += y;
  };
  in_packs(
      count, [&](std::uint32_t e, auto row) __attribute__((always_inline)) {
        const Pack pxx = row.load(p[0] + e), pxy = row.load(p[1] + e), pyx = row.load(p[2] + e),
                   pyy = row.load(p[3] + e), area = row.load(t.area + e);
        const Pack g1x = row.load(t.gradient[0] + e), g1y = row.load(t.gradient[1] + e),
                   g2x = row.load(t.gradient[2] + e), g2y = row.load(t.gradient[3] + e);
        // What is taken off the second and the third corner, x and y of each.
        const Pack off[4] = {area * (pxx * g1x + pxy * g1y), area * (pyx * g1x + pyy * g1y),
                             area * (pxx * g2x + pxy * g2y), area * (pyx * g2x + pyy * g2y)};
        double of[width][4], *rows[width];
        for (std::uint32_t lane = 0; lane < width; ++lane) rows[lane] = of[lane];
        simd::scatter_rows(off, rows);
        for (std::uint32_t lane = 0; lane < row.count; ++lane) {
          const double* o = of[lane];
          give(t.corner[0][e + lane], o[0] + o[2], o[1] + o[3]);
          give(t.corner[1][e + lane], -o[0], -o[1]);
          give(t.corner[2][e + lane], -o[2], -o[3]);
        }
      });
}

double sum(std::uint32_t count, const double* value) {
  Sum total;
  in_lanes(count, [&](std::uint32_t k, std::uint32_t i, auto row) {
    total.part[k] = total.part[k] + row.load(value + i);
  });
  return total.total();
}

double weighted_sum(std::uint32_t count, const double* weight, const double* value) {
  Sum total;
  in_lanes(count, [&](std::uint32_t k, std::uint32_t i, auto row) {
    total.part[k] = total.part[k] + row.load(weight + i) * row.load(value + i);
  });
  return total.total();
}

/// Products of velocities before and after; x and y are lanes beside each other.
struct Products {
  Sum before, across, after, momentum;

  void add(bool all, std::uint32_t k, Pack mass, Pack v, Pack next) {
    across.part[k] = across.part[k] + mass * (v * next);
    if (!all) return;
    before.part[k] = before.part[k] + mass * (v * v);
    after.part[k] = after.part[k] + mass * (next * next);
    momentum.part[k] = momentum.part[k] + mass * v;
  }
};

/// What accelerate() is given.
struct Patches {
  const double *mass, *inverse_mass;
  LocalVectors force;
  double *v, *middle;
};

/// The patches of a row from patch i on; their velocities go to packs k and k + 1 of the sums.
template <bool all, bool same_mass, bool apart, class Row>
[[gnu::always_inline]] inline void accelerate_some(const VelocityUpdate& how, const Patches& patches,
                                                   double share, std::uint32_t i, std::uint32_t k, Row row,
                                                   Products& products) {
  const Pack inverse = same_mass ? Pack(patches.inverse_mass[0]) : row.load(patches.inverse_mass + i);
  Pack acceleration[2], mass[2];
  if constexpr (apart) {
    simd::interleave(row.load(patches.force.x + i) * inverse + how.gravity[0],
                     row.load(patches.force.y + i) * inverse + how.gravity[1], acceleration);
  } else {
    Pack beside[2] = {inverse, inverse}, gravity[2];
    if constexpr (!same_mass) simd::interleave(inverse, inverse, beside);
    simd::interleave(how.gravity[0], how.gravity[1], gravity);
    for (std::uint32_t half = 0; half < 2; ++half)
      acceleration[half] =
          row.half(half).load(patches.force.x + 2 * i + half * width) * beside[half] + gravity[half];
  }
  if (!same_mass) simd::interleave(row.load(patches.mass + i), row.load(patches.mass + i), mass);
  for (std::uint32_t half = 0; half < 2; ++half) {
    const auto part = row.half(half);
    // Lanes beyond the row weigh nothing, so what gravity does to them does not count.
    if (same_mass) mass[half] = part.only(1.0);
    double* at = patches.v + 2 * i + half * width;
    const Pack old = part.load(at), next = how.keep * old + how.gain * acceleration[half];
    part.store(next, at);
    if (patches.middle != nullptr)
      part.store(old + share * (next - old), patches.middle + 2 * i + half * width);
    products.add(all, (k + half) % packs, mass[half], old, next);
  }
}

template <bool all, bool same_mass, bool apart>
void accelerate_all(std::uint32_t count, const VelocityUpdate& how, const Patches& patches, double share,
                    Products& products) {
  const auto some = [&](std::uint32_t i, std::uint32_t part, auto row) __attribute__((always_inline)) {
    accelerate_some<all, same_mass, apart>(how, patches, share, i + part * width, 2 * part, row, products);
  };
  // Patches i and i + 4 share their lanes of the sums.
  constexpr std::uint32_t most = lanes / 2 > width ? lanes / 2 : width;
  std::uint32_t i = 0;
  for (; i + most <= count; i += most) {
    for (std::uint32_t part = 0; part < most / width; ++part) some(i, part, Whole{});
  }
  for (std::uint32_t part = 0; i + part * width < count; ++part) {
    const std::uint32_t rest = count - i - part * width;
    some(i, part, First{rest < width ? rest : width});
  }
}

void accelerate(std::uint32_t count, const VelocityUpdate& how, bool same_mass, const double* mass,
                const double* inverse_mass, const LocalVectors& force, double* v, double* middle,
                double share, VelocitySums& sums) {
  const Patches patches{mass, inverse_mass, force, v, middle};
  Products products;
  with(how.all_sums, [&](auto all) {
    with(same_mass, [&](auto same) {
      with(force.apart(),
           [&](auto apart) { accelerate_all<all, same, apart>(count, how, patches, share, products); });
    });
  });
  const double factor = same_mass ? mass[0] : 1;
  sums.across += factor * products.across.total();
  sums.before += factor * products.before.total();
  sums.after += factor * products.after.total();
  double m[lanes];
  products.momentum.store(m);
  sums.momentum[0] += factor * ((m[0] + m[2]) + (m[4] + m[6]));
  sums.momentum[1] += factor * ((m[1] + m[3]) + (m[5] + m[7]));
}

}  // namespace

extern const ElementKernels element_kernels;
const ElementKernels element_kernels{move, lattice_gradient, lattice_force, triangle_gradient, triangle_force,
                                     sum,  weighted_sum,     accelerate};

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
