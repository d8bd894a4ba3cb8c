#include "model/partition.hpp"

#include "model/space_filling.hpp"
#include "model/subdomain_maker.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace talus {
namespace {

constexpr std::int32_t tile_columns = 128;  ///< cells of a lattice in a row of a subdomain
/// Elements of a subdomain of triangles, of a lattice twice as many: the more, the fewer patches are common,
/// up to what a core's own cache holds; and some subdomains for each thread.
constexpr std::uint32_t least_elements = 4096, most_elements = 16384, wanted_subdomains = 16;

using Kind = LatticePlaces::Kind;

std::int32_t floor_divide(std::int32_t value, std::int32_t by) {
  return value >= 0 ? value / by : -((by - 1 - value) / by);
}

/// By the elements of a body, how many times as large as the least its subdomains are: a power of two.
std::uint32_t enlargement(std::size_t elements, std::uint32_t least) {
  std::uint32_t times = 1;
  while (2 * times * least_elements <= most_elements &&
         elements / (2 * std::size_t{times} * least) >= wanted_subdomains)
    times *= 2;
  return times;
}

void order_by_tile(PartitionWork& work) {
  const auto& element = work.lattice->element;
  const auto tile_rows = static_cast<std::int32_t>(enlargement(element.size(), 2 * least_elements) *
                                                   least_elements / tile_columns);
  const auto tile = [&](std::uint32_t e) {
    return std::pair(floor_divide(element[e].cell.row, tile_rows),
                     floor_divide(element[e].cell.column, tile_columns));
  };
  std::sort(work.order.begin(), work.order.end(), [&](std::uint32_t d, std::uint32_t e) {
    const auto key = [&](std::uint32_t i) {
      return std::tuple(tile(i), element[i].kind == Kind::other, element[i].cell, element[i].kind, i);
    };
    return key(d) < key(e);
  });
  for (std::uint32_t i = 0; i < work.order.size(); ++i) {
    if (i == 0 || tile(work.order[i - 1]) != tile(work.order[i])) work.subdomain_start.push_back(i);
  }
}

void order_along_curve(PartitionWork& work) {
  const LaidCover& cover = work.cover;
  std::vector<Vec2> centres;
  centres.reserve(cover.elements.size());
  for (const LaidCover::LaidElement& element : cover.elements) {
    const Vec2 a = cover.patches[element.patches[0]], b = cover.patches[element.patches[1]],
               c = cover.patches[element.patches[2]];
    centres.push_back((a + b + c) / 3);
  }
  const std::vector<std::uint64_t> along = along_curve(centres);
  std::sort(work.order.begin(), work.order.end(), [&](std::uint32_t d, std::uint32_t e) {
    return along[d] != along[e] ? along[d] < along[e] : d < e;
  });
  const std::uint32_t triangles = enlargement(work.order.size(), least_elements) * least_elements;
  for (std::uint32_t i = 0; i < work.order.size(); i += triangles) work.subdomain_start.push_back(i);
}

/// Subdomain after subdomain, so that patches are ranked by when the chain needs them.
void order_by_chain(PartitionWork& work) {
  for (std::size_t s = 0; s + 1 < work.subdomain_start.size(); ++s) {
    const std::uint32_t begin = work.subdomain_start[s], end = work.subdomain_start[s + 1];
    work.chain.push_back(chain_triangles(work.cover, std::span(work.order).subspan(begin, end - begin)));
    auto next = work.order.begin() + begin;
    for (const ChainLink& link : work.chain.back()) {
      if (link.element != ChainLink::no_element) *next++ = link.element;
    }
  }
}

void find_common(PartitionWork& work, const std::vector<std::uint32_t>& loaded) {
  constexpr std::uint32_t none = 0xFFFFFFFFu;
  const LaidCover& cover = work.cover;
  work.common.assign(cover.patches.size(), 0);
  work.home.assign(cover.patches.size(), none);
  const auto mark = [&](std::uint32_t element) {
    for (const std::uint32_t patch : cover.elements[element].patches) work.common[patch] = 1;
  };
  for (const auto& loop : cover.loops) {
    for (const LaidCover::BoundaryVertex& vertex : loop) mark(vertex.element);
  }
  for (const std::uint32_t element : loaded) mark(element);
  for (std::uint32_t s = 0; s + 1 < work.subdomain_start.size(); ++s) {
    for (std::uint32_t i = work.subdomain_start[s]; i < work.subdomain_start[s + 1]; ++i) {
      for (const std::uint32_t patch : cover.elements[work.order[i]].patches) {
        if (work.home[patch] == none) work.home[patch] = s;
        if (work.home[patch] != s) work.common[patch] = 1;
      }
    }
  }
  for (std::size_t p = 0; p < work.home.size(); ++p) {
    if (work.home[p] == none) work.common[p] = 1;
  }
  constexpr std::uint8_t last = 2;
  for (const LaidCover::Steadied& one : cover.steadied) {
    work.common[one.patch] = last;
    for (const std::uint32_t patch : one.to) work.common[patch] = last;
  }
}

/// Rows of a lattice stay together; elsewhere patches follow the elements, own ones first.
void rank_patches(PartitionWork& work) {
  const std::size_t count = work.cover.patches.size();
  work.rank.assign(count, 0xFFFFFFFFu);
  std::vector<std::uint32_t> sorted(count);
  std::iota(sorted.begin(), sorted.end(), 0u);
  if (work.lattice) {
    const auto& place = work.lattice->patch;
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t p, std::uint32_t q) {
      return std::tuple(place[p], p) < std::tuple(place[q], q);
    });
    for (std::uint32_t i = 0; i < count; ++i) work.rank[sorted[i]] = i;
  } else {
    std::uint32_t next = 0;
    for (const bool common : {false, true}) {
      for (const std::uint32_t e : work.order) {
        for (const std::uint32_t patch : work.cover.elements[e].patches) {
          if (work.rank[patch] == 0xFFFFFFFFu && (work.common[patch] != 0) == common)
            work.rank[patch] = next++;
        }
      }
    }
    for (std::uint32_t& rank : work.rank) rank = std::min(rank, next);
  }
}

/// Own patches subdomain after subdomain, then the common ones, those last that slivers are about.
PartitionCounts number_patches(PartitionWork& work) {
  const std::size_t count = work.cover.patches.size();
  std::vector<std::uint32_t> sorted(count);
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t p, std::uint32_t q) {
    const auto key = [&](std::uint32_t i) {
      return std::tuple(work.common[i], work.common[i] != 0 ? 0 : work.home[i], work.rank[i], i);
    };
    return key(p) < key(q);
  });
  work.number.resize(count);
  PartitionCounts counts;
  for (std::uint32_t i = 0; i < count; ++i) {
    work.number[sorted[i]] = i;
    counts.own += work.common[sorted[i]] == 0 ? 1 : 0;
    counts.free += work.common[sorted[i]] <= 1 ? 1 : 0;
  }
  return counts;
}

/// Puts the cover into the new order.
void renumber(PartitionWork& work, const std::vector<std::uint32_t>& final_order) {
  LaidCover& cover = work.cover;
  std::vector<Vec2> patches(cover.patches.size());
  for (std::size_t p = 0; p < patches.size(); ++p) patches[work.number[p]] = cover.patches[p];
  cover.patches = std::move(patches);
  std::vector<LaidCover::LaidElement> elements;
  elements.reserve(cover.elements.size());
  std::vector<std::uint32_t> position(cover.elements.size());
  for (std::uint32_t i = 0; i < final_order.size(); ++i) {
    position[final_order[i]] = i;
    LaidCover::LaidElement& element = elements.emplace_back(std::move(cover.elements[final_order[i]]));
    for (std::uint32_t& patch : element.patches) patch = work.number[patch];
  }
  cover.elements = std::move(elements);
  for (auto& loop : cover.loops) {
    for (LaidCover::BoundaryVertex& vertex : loop) vertex.element = position[vertex.element];
  }
  for (LaidCover::Steadied& one : cover.steadied) {
    one.patch = work.number[one.patch];
    for (std::uint32_t& patch : one.to) patch = work.number[patch];
  }
}

}  // namespace

PartitionCounts partition_cover(Partition& partition, LaidCover& cover,
                                const std::vector<std::uint32_t>& loaded, std::uint32_t first_patch) {
  PartitionWork work{cover, find_lattice(cover), {}, {}, {}, {}, {}, {}, {}};
  work.order.resize(cover.elements.size());
  std::iota(work.order.begin(), work.order.end(), 0u);
  if (work.lattice) {
    order_by_tile(work);
  } else {
    order_along_curve(work);
  }
  work.subdomain_start.push_back(static_cast<std::uint32_t>(work.order.size()));
  if (!work.lattice) order_by_chain(work);
  find_common(work, loaded);
  rank_patches(work);
  const PartitionCounts counts = number_patches(work);
  std::vector<std::uint32_t> final_order;
  final_order.reserve(work.order.size());
  SubdomainMaker maker(partition, work, first_patch);
  for (std::uint32_t s = 0; s + 1 < work.subdomain_start.size(); ++s) maker.make(s, final_order);
  renumber(work, final_order);

  RegularLattice lattice;
  if (work.lattice) {
    const Vec2 a = work.lattice->along, b = work.lattice->up;
    const double cell = a.x * b.y - a.y * b.x;
    lattice = {{b.y / cell, -b.x / cell, -a.y / cell, a.x / cell}, cell / 2};
  }
  partition.lattices.push_back(lattice);
  return counts;
}

}  // namespace talus
