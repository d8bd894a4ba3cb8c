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
#include <type_traits>

namespace talus::elements {
inline namespace TALUS_SIMD_LEVEL {

using simd::Pack;

/// xx, xy, yx, yy of a tensor in each lane.
struct PlanePacks {
  Pack xx, xy, yx, yy;
};

/// How rows are read and written: by full packs, or the first lanes of one.
struct WholePack {
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

/// What lies so many bytes on from where a row starts, which may be beyond its end: no pointer may leave its
/// row.
[[gnu::always_inline]] inline void fetch_line(const void* row, std::size_t bytes) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(row) + bytes));
}

/// `count` entries from i on. Where there are fewer nothing is lost but the time.
template <std::uint32_t count>
[[gnu::always_inline]] inline void fetch(const RowsAhead& ahead, std::uint32_t i) {
  constexpr std::uint32_t in_line = 64 / sizeof(double);
  for (std::uint32_t line = 0; line < count; line += in_line) {
    for (const double* row : ahead.from) fetch_line(row, sizeof(double) * (i + line));
  }
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
  const RowsAhead ahead = cells.ahead;
  // What the cells before gave to their right corners below, and took off those above, of which the last lies
  // here.
  Pack before_bottom_x = 0.0, before_bottom_y = 0.0, before_top_x = 0.0, before_top_y = 0.0;
  EnergySum energy;
  in_packs(
      cells.count, [&](std::uint32_t c, std::uint32_t k, auto row) __attribute__((always_inline)) {
        fetch<2 * simd::lanes>(ahead, 2 * c);
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
        const auto give_and_take = [&](double* to, Pack left, Pack right, Pack& before)
            __attribute__((always_inline)) {
          row.store(row.load(to) + (left - simd::shifted(before, right)), to);
          before = right;
        };
        give(on_bottom_x + c, lower.x1 + lower.x2, upper.x2 - lower.x1, before_bottom_x);
        give(on_bottom_y + c, lower.y1 + lower.y2, upper.y2 - lower.y1, before_bottom_y);
        give_and_take(on_top_x + c, upper.x1 - lower.x2, upper.x1 + upper.x2, before_top_x);
        give_and_take(on_top_y + c, upper.y1 - lower.y2, upper.y1 + upper.y2, before_top_y);
        energy.add(k, row.only(stored[0] + stored[1]));
      });
  const auto give_last = [&](double* to, Pack before) {
    double last[simd::lanes];
    simd::store(before, last);
    to[cells.count] += last[(cells.count - 1) % simd::lanes];
  };
  give_last(on_bottom_x, before_bottom_x);
  give_last(on_bottom_y, before_bottom_y);
  give_last(on_top_x, -before_top_x);
  give_last(on_top_y, -before_top_y);
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
  /// Of as many links as a pack has lanes.
  static simd::Packs2 gather(const double* x, const double* y, const std::uint32_t* at) {
    const double* from[simd::lanes];
    double both[simd::lanes][2];
    for (std::uint32_t lane = 0; lane < simd::lanes; ++lane) {
      if constexpr (beside) {
        from[lane] = x + at[lane];
      } else {
        store_pair(load(x, y, at[lane]), both[lane]);
        from[lane] = both[lane];
      }
    }
    return simd::gather_points(from);
  }
  /// Adds to those of as many links as a pack has lanes, one after the other: some may be the same.
  static void add(simd::Packs2 what, double* x, double* y, const std::uint32_t* at) {
    alignas(64) double both[2 * simd::lanes];
    Pack halves[2];
    simd::interleave(what.x, what.y, halves);
    simd::store(halves[0], both);
    simd::store(halves[1], both + simd::lanes);
    for (std::uint32_t lane = 0; lane < simd::lanes; ++lane)
      store(load(x, y, at[lane]) + load_pair(both + 2 * lane), x, y, at[lane]);
  }
};

/// What links had one pack before, to be handed on along the chain.
class Handed {
 public:
  /// Of the link before each.
  Pack on(Pack here) {
    const Pack result = simd::shifted(before_, here);
    before_ = here;
    return result;
  }

 private:
  Pack before_ = 0.0;
};

/// H of the triangles of a chain, pack after pack from its first link on.
template <bool beside>
class ChainStrain {
 public:
  explicit ChainStrain(const TriangleChain& chain) : chain_(chain) {}

  [[gnu::always_inline]] PlanePacks at(std::uint32_t i) {
    const simd::Packs2 third = Corners<beside>::gather(chain_.x, chain_.y, chain_.corner + i),
                       second{second_x_.on(third.x), second_y_.on(third.y)},
                       first{first_x_.on(second.x), first_y_.on(second.y)}, along = second - first,
                       up = third - first;
    const Pack g1x = simd::load(chain_.gradient[0] + i), g1y = simd::load(chain_.gradient[1] + i),
               g2x = simd::load(chain_.gradient[2] + i), g2y = simd::load(chain_.gradient[3] + i);
    return {along.x * g1x + up.x * g2x, along.x * g1y + up.x * g2y, along.y * g1x + up.y * g2x,
            along.y * g1y + up.y * g2y};
  }

 private:
  const TriangleChain chain_;
  Handed second_x_, second_y_, first_x_, first_y_;
};

/// Takes area · P ∇w off the corners of a chain, pack after pack from its first link on: what a link takes
/// goes back along the chain, and is given two links late.
template <bool beside>
class ChainPull {
 public:
  explicit ChainPull(const TriangleChain& chain) : chain_(chain) {}

  [[gnu::always_inline]] void take(std::uint32_t i, const PlanePacks& p) {
    const Pack g1x = simd::load(chain_.gradient[0] + i), g1y = simd::load(chain_.gradient[1] + i),
               g2x = simd::load(chain_.gradient[2] + i), g2y = simd::load(chain_.gradient[3] + i),
               area = simd::load(chain_.area + i);
    const Pull off{area * (p.xx * g1x + p.xy * g1y), area * (p.yx * g1x + p.yy * g1y),
                   area * (p.xx * g2x + p.xy * g2y), area * (p.yx * g2x + p.yy * g2y)};
    Corners<beside>::add({(off.x1 + off.x2) - second_x_.on(off.x1) - third_x_.on(next_third_x_.on(off.x2)),
                          (off.y1 + off.y2) - second_y_.on(off.y1) - third_y_.on(next_third_y_.on(off.y2))},
                         chain_.force_x, chain_.force_y, chain_.corner + i - TriangleChain::links_before);
  }

 private:
  const TriangleChain chain_;
  Handed second_x_, second_y_, next_third_x_, next_third_y_, third_x_, third_y_;
};

/// What links further on need from memory: chains lie one after the other.
[[gnu::always_inline]] inline void fetch_ahead(const TriangleChain& chain, std::uint32_t i) {
  const std::size_t further = std::size_t{i} + 128;
  for (const double* row : chain.gradient) fetch_line(row, sizeof(double) * further);
  fetch_line(chain.area, sizeof(double) * further);
  fetch_line(chain.corner, sizeof(std::uint32_t) * further);
  fetch<simd::lanes>(chain.ahead, i);
}

template <bool beside, class Law>
double sweep_chain(const TriangleChain& chain, const Law& law) {
  ChainStrain<beside> strain(chain);
  ChainPull<beside> pull(chain);
  const double* const area = chain.area;
  EnergySum energy;
  const auto some = [&]<int packs>(std::uint32_t i, std::integral_constant<int, packs>)
      __attribute__((always_inline)) {
    PlanePacks h[packs], p[packs];
    Pack stored[packs];
    for (int k = 0; k < packs; ++k) fetch_ahead(chain, i + k * simd::lanes);
    for (int k = 0; k < packs; ++k) h[k] = strain.at(i + k * simd::lanes);
    law(h, p, stored);
    for (int k = 0; k < packs; ++k) {
      const std::uint32_t at = i + k * simd::lanes;
      energy.add(at / simd::lanes % EnergySum::packs, simd::load(area + at) * stored[k]);
      pull.take(at, p[k]);
    }
  };
  std::uint32_t i = 0;
  for (; i + 2 * simd::lanes <= chain.count; i += 2 * simd::lanes) some(i, std::integral_constant<int, 2>());
  if (i < chain.count) some(i, std::integral_constant<int, 1>());
  return energy.total();
}

template <class Law>
double sweep(const TriangleChain& chain, const Law& law) {
  return chain.beside != 0 ? sweep_chain<true>(chain, law) : sweep_chain<false>(chain, law);
}

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::elements
