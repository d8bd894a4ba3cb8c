#pragma once

// From displacements to forces in one pass, for laws that give the stress of an element from its displacement
// gradient alone: what Material::sweep() calls. All else stays in registers. The law is any function object
//
//   template <int packs>
//   void law(const PlanePacks (&gradient)[packs], PlanePacks (&stress)[packs], Pack (&energy)[packs]) const
//
// over packs of elements: H = F − I, P in Pa, and energy in J/m³. It is inlined, for one or two packs, so
// that one need not wait for the other; each lane must get what it would get alone.

#include <talus/material.hpp>
#include <talus/simd/pack.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace talus::elements {
inline namespace TALUS_SIMD_LEVEL {

using simd::Pack;

/// xx, xy, yx, yy of a tensor in each lane.
struct PlanePacks {
  Pack xx, xy, yx, yy;
};

/// How rows are read and written: by full packs, or the first lanes of one.
struct WholePack {
  static constexpr std::uint32_t count = simd::lanes;

  static Pack load(const double* from) { return simd::load(from); }
  static void store(Pack p, double* to) { simd::store(p, to); }
  static Pack only(Pack p) { return p; }
};
struct PartOfPack {
  std::uint32_t count;

  Pack load(const double* from) const { return simd::load_first(from, count); }
  void store(Pack p, double* to) const { simd::store_first(p, to, count); }
  Pack only(Pack p) const { return simd::only_where(simd::mask_of((1u << count) - 1), p); }
};

/// A sum in eight lanes, whatever the width of packs: element i goes to lane i mod 8.
class EnergySum {
 public:
  static constexpr std::uint32_t lanes = 8, packs = lanes / simd::lanes;

  void add(std::uint32_t pack, Pack value) { part_[pack] = part_[pack] + value; }
  double total() const {
    double lane[lanes];
    for (std::uint32_t k = 0; k < packs; ++k) simd::store(part_[k], lane + k * simd::lanes);
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
  }

 private:
  Pack part_[packs] = {};
};

/// Calls some(i, k, row) for the packs of `count` elements, where element i goes to pack k of a sum.
template <class Some>
[[gnu::always_inline]] inline void in_packs(std::uint32_t count, const Some& some) {
  constexpr std::uint32_t width = simd::lanes;
  std::uint32_t i = 0;
  for (; i + EnergySum::lanes <= count; i += EnergySum::lanes) {
    for (std::uint32_t k = 0; k < EnergySum::packs; ++k) some(i + k * width, k, WholePack{});
  }
  std::uint32_t k = 0;
  for (; i + width <= count; i += width) some(i, k++, WholePack{});
  if (i < count) some(i, k, PartOfPack{count - i});
}

/// What a triangle pulls at its second and third corner with, N/m.
struct Pull {
  Pack x1, y1, x2, y2;
};

/// `level`: rows lie along x, so that the third corner has a gradient along y alone. A sum with a product
/// that is zero is what it is without: the bits are the same.
template <bool level, class Law>
double sweep_cells(const LatticeCells& cells, const Law& law) {
  const Pack g1x = cells.gradient[0], g1y = cells.gradient[1], g2x = cells.gradient[2],
             g2y = cells.gradient[3];
  const double area = cells.area;
  const Pack a1x = area * cells.gradient[0], a1y = area * cells.gradient[1], a2x = area * cells.gradient[2],
             a2y = area * cells.gradient[3];
  // Row pointers as locals: stores of forces cannot change them.
  const double *const bottom_x = cells.bottom_x, *const bottom_y = cells.bottom_y, *const top_x = cells.top_x,
                      *const top_y = cells.top_y;
  double *const on_bottom_x = cells.bottom_force_x, *const on_bottom_y = cells.bottom_force_y,
                *const on_top_x = cells.top_force_x, *const on_top_y = cells.top_force_y;
  // What the cells before gave to their right corners, of which the last lies here.
  Pack before_bottom_x = 0.0, before_bottom_y = 0.0, before_top_x = 0.0, before_top_y = 0.0;
  EnergySum energy;
  in_packs(
      cells.count, [&](std::uint32_t c, std::uint32_t k, auto row) __attribute__((always_inline)) {
        const Pack left_x = row.load(bottom_x + c), right_x = row.load(bottom_x + c + 1);
        const Pack left_y = row.load(bottom_y + c), right_y = row.load(bottom_y + c + 1);
        const Pack over_x = row.load(top_x + c), over_right_x = row.load(top_x + c + 1);
        const Pack over_y = row.load(top_y + c), over_right_y = row.load(top_y + c + 1);
        const auto gradient = [&](Pack along_x, Pack along_y, Pack up_x, Pack up_y)
            __attribute__((always_inline)) {
          if constexpr (level)
            return PlanePacks{along_x * g1x, along_x * g1y + up_x * g2y, along_y * g1x,
                              along_y * g1y + up_y * g2y};
          return PlanePacks{along_x * g1x + up_x * g2x, along_x * g1y + up_x * g2y,
                            along_y * g1x + up_y * g2x, along_y * g1y + up_y * g2y};
        };
        const PlanePacks h[2] = {
            gradient(right_x - left_x, right_y - left_y, over_x - left_x, over_y - left_y),
            gradient(over_right_x - over_x, over_right_y - over_y, over_right_x - right_x,
                     over_right_y - right_y)};
        PlanePacks p[2];
        Pack stored[2];
        law(h, p, stored);
        /// area · P ∇w of the second and the third corner of a lower triangle.
        const auto pull = [&](const PlanePacks& t) __attribute__((always_inline)) {
          if constexpr (level)
            return Pull{t.xx * a1x + t.xy * a1y, t.yx * a1x + t.yy * a1y, t.xy * a2y, t.yy * a2y};
          return Pull{t.xx * a1x + t.xy * a1y, t.yx * a1x + t.yy * a1y, t.xx * a2x + t.xy * a2y,
                      t.yx * a2x + t.yy * a2y};
        };
        const Pull lower = pull(p[0]), upper = pull(p[1]);
        const auto give = [&](double* to, Pack left, Pack right, Pack& before)
            __attribute__((always_inline)) {
          row.store(row.load(to) + (left + simd::shifted(before, right)), to);
          before = right;
        };
        give(on_bottom_x + c, lower.x1 + lower.x2, upper.x2 - lower.x1, before_bottom_x);
        give(on_bottom_y + c, lower.y1 + lower.y2, upper.y2 - lower.y1, before_bottom_y);
        give(on_top_x + c, upper.x1 - lower.x2, -(upper.x1 + upper.x2), before_top_x);
        give(on_top_y + c, upper.y1 - lower.y2, -(upper.y1 + upper.y2), before_top_y);
        energy.add(k, row.only(stored[0] + stored[1]));
      });
  const auto give_last = [&](double* to, Pack before) {
    double last[simd::lanes];
    simd::store(before, last);
    to[cells.count] += last[(cells.count - 1) % simd::lanes];
  };
  give_last(on_bottom_x, before_bottom_x);
  give_last(on_bottom_y, before_bottom_y);
  give_last(on_top_x, before_top_x);
  give_last(on_top_y, before_top_y);
  return area * energy.total();
}

template <class Law>
double sweep(const LatticeCells& cells, const Law& law) {
  return cells.gradient[2] == 0 ? sweep_cells<true>(cells, law) : sweep_cells<false>(cells, law);
}

/// x and y of a corner.
using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;
inline Pair load_pair(const double* from) {
  Pair p;
  std::memcpy(&p, from, sizeof p);
  return p;
}
inline void store_pair(Pair p, double* to) {
  std::memcpy(to, &p, sizeof p);
}

/// Vectors of corners, y beside x or in a row of its own.
template <bool beside>
struct Corners {
  static Pair load(const double* x, const double* y, std::uint32_t i) {
    if constexpr (beside) return load_pair(x + i);
    return Pair{x[i], y[i]};
  }
  static void store(Pair p, double* x, double* y, std::uint32_t i) {
    if constexpr (beside) {
      store_pair(p, x + i);
    } else {
      x[i] = p[0];
      y[i] = p[1];
    }
  }
  /// Of as many corners as a pack has lanes; lanes beyond `count` repeat the first.
  static simd::Packs2 gather(const double* x, const double* y, const std::uint32_t* at, std::uint32_t count) {
    const double* from[simd::lanes];
    double both[simd::lanes][2];
    for (std::uint32_t lane = 0; lane < simd::lanes; ++lane) {
      const std::uint32_t i = at[lane < count ? lane : 0];
      if constexpr (beside) {
        from[lane] = x + i;
      } else {
        store_pair(load(x, y, i), both[lane]);
        from[lane] = both[lane];
      }
    }
    return simd::gather_points(from);
  }
};

template <bool beside, class Law>
double sweep_triangles(const TriangleList& list, const Law& law) {
  using At = Corners<beside>;
  const std::uint32_t *const first = list.corner[0], *const second = list.corner[1],
                             *const third = list.corner[2];
  const double *const gradient_1x = list.gradient[0], *const gradient_1y = list.gradient[1],
                      *const gradient_2x = list.gradient[2], *const gradient_2y = list.gradient[3],
                      *const areas = list.area;
  const double *const x = list.x, *const y = list.y;
  double *const force_x = list.force_x, *const force_y = list.force_y;
  EnergySum energy;
  in_packs(
      list.count, [&](std::uint32_t e, std::uint32_t k, auto row) __attribute__((always_inline)) {
        const simd::Packs2 at = At::gather(x, y, first + e, row.count),
                           along = At::gather(x, y, second + e, row.count) - at,
                           up = At::gather(x, y, third + e, row.count) - at;
        const Pack g1x = row.load(gradient_1x + e), g1y = row.load(gradient_1y + e),
                   g2x = row.load(gradient_2x + e), g2y = row.load(gradient_2y + e),
                   area = row.load(areas + e);
        const PlanePacks h[1] = {{along.x * g1x + up.x * g2x, along.x * g1y + up.x * g2y,
                                  along.y * g1x + up.y * g2x, along.y * g1y + up.y * g2y}};
        PlanePacks p[1];
        Pack stored[1];
        law(h, p, stored);
        energy.add(k, row.only(area * stored[0]));
        // What is taken off the second and the third corner, x and y of each.
        const Pack off[4] = {area * (p[0].xx * g1x + p[0].xy * g1y), area * (p[0].yx * g1x + p[0].yy * g1y),
                             area * (p[0].xx * g2x + p[0].xy * g2y), area * (p[0].yx * g2x + p[0].yy * g2y)};
        alignas(64) double of[simd::lanes][4];
        double* rows[simd::lanes];
        for (std::uint32_t lane = 0; lane < simd::lanes; ++lane) rows[lane] = of[lane];
        simd::scatter_rows(off, rows);
        for (std::uint32_t lane = 0; lane < row.count; ++lane) {
          const Pair to_second = load_pair(of[lane]), to_third = load_pair(of[lane] + 2);
          const std::uint32_t i = first[e + lane], j = second[e + lane], l = third[e + lane];
          At::store(At::load(force_x, force_y, i) + (to_second + to_third), force_x, force_y, i);
          At::store(At::load(force_x, force_y, j) - to_second, force_x, force_y, j);
          At::store(At::load(force_x, force_y, l) - to_third, force_x, force_y, l);
        }
      });
  return energy.total();
}

template <class Law>
double sweep(const TriangleList& list, const Law& law) {
  return list.beside != 0 ? sweep_triangles<true>(list, law) : sweep_triangles<false>(list, law);
}

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::elements
