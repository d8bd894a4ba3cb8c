#include "kernels/elements.hpp"

#include <talus/elements/sweep.hpp>
#include <talus/simd/pack.hpp>

#include <type_traits>

namespace talus::kernels::TALUS_KERNEL_LEVEL {
namespace {

using simd::Pack;

/// Packs of one level that hold the eight lanes of a sum.
constexpr std::uint32_t packs = lanes / simd::lanes, width = simd::lanes;

/// How a row is read and written: by full packs, or the first lanes of one.
struct Whole {
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

/// Calls each(link of the pack, triangle) for the links from i on that have a triangle.
template <class Each>
void triangles_of_pack(const TriangleChain& chain, std::uint32_t i, std::uint32_t& next, const Each& each) {
  for (std::uint32_t link = 0; link < width; ++link) {
    if (chain.area[i + link] != 0) each(link, next++);
  }
}

template <bool beside>
void gradient_of_chain(const TriangleChain& chain, double* const f[4]) {
  elements::ChainStrain<beside> strain(chain);
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < chain.count; i += width) {
    const elements::PlanePacks h = strain.at(i);
    double of[4][width];
    simd::store(1.0 + h.xx, of[0]);
    simd::store(h.xy, of[1]);
    simd::store(h.yx, of[2]);
    simd::store(1.0 + h.yy, of[3]);
    triangles_of_pack(chain, i, next, [&](std::uint32_t link, std::uint32_t triangle) {
      for (std::uint32_t k = 0; k < 4; ++k) f[k][triangle] = of[k][link];
    });
  }
}

void chain_gradient(const TriangleChain& chain, double* const f[4]) {
  with(chain.beside != 0, [&](auto beside) { gradient_of_chain<beside>(chain, f); });
}

template <bool beside>
void force_of_chain(const TriangleChain& chain, const double* const p[4]) {
  elements::ChainPull<beside> pull(chain);
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < chain.count; i += width) {
    double of[4][width] = {};
    triangles_of_pack(chain, i, next, [&](std::uint32_t link, std::uint32_t triangle) {
      for (std::uint32_t k = 0; k < 4; ++k) of[k][link] = p[k][triangle];
    });
    pull.take(i, {simd::load(of[0]), simd::load(of[1]), simd::load(of[2]), simd::load(of[3])});
  }
}

void chain_force(const TriangleChain& chain, const double* const p[4]) {
  with(chain.beside != 0, [&](auto beside) { force_of_chain<beside>(chain, p); });
}

void work_of_step(std::uint32_t count, const double* const p[4], const double* const f[4],
                  double* const former_p[4], double* const former_f[4], double* work) {
  const auto some = [&](std::uint32_t i, auto row) __attribute__((always_inline)) {
    Pack twice[4];
    for (std::uint32_t k = 0; k < 4; ++k) {
      const Pack stress = row.load(p[k] + i), place = row.load(f[k] + i);
      twice[k] = (row.load(former_p[k] + i) + stress) * (place - row.load(former_f[k] + i));
      row.store(stress, former_p[k] + i);
      row.store(place, former_f[k] + i);
    }
    row.store(row.load(work + i) + 0.5 * ((twice[0] + twice[1]) + (twice[2] + twice[3])), work + i);
  };
  std::uint32_t i = 0;
  for (; i + width <= count; i += width) some(i, Whole{});
  if (i < count) some(i, First{count - i});
}

double sum(std::uint32_t count, const double* value) {
  Sum total;
  in_lanes(count, [&](std::uint32_t k, std::uint32_t i, auto row) {
    total.part[k] = total.part[k] + row.load(value + i);
  });
  return total.total();
}

double chain_sum(const TriangleChain& chain, const double* value) {
  Sum total;
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < chain.count; i += width) {
    double of[width] = {};
    triangles_of_pack(chain, i, next,
                      [&](std::uint32_t link, std::uint32_t triangle) { of[link] = value[triangle]; });
    Pack& part = total.part[i / width % packs];
    part = part + simd::load(chain.area + i) * simd::load(of);
  }
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
const ElementKernels element_kernels{move,        lattice_gradient, lattice_force, chain_gradient,
                                     chain_force, work_of_step,     sum,           chain_sum,
                                     accelerate};

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
