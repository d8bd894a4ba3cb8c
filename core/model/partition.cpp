#include "model/partition.hpp"

#include "model/lattice_places.hpp"
#include "model/shared_places.hpp"
#include "model/space_filling.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace talus {
namespace {

constexpr std::int32_t tile_columns = 128;       ///< cells of a lattice in a row of a subdomain
constexpr std::uint32_t elements_at_once = 256;  ///< in a chunk
/// Elements of a subdomain of triangles, of a lattice twice as many: the more, the fewer patches are common,
/// up to what a core's own cache holds; and some subdomains for each thread.
constexpr std::uint32_t least_elements = 4096, most_elements = 16384, wanted_subdomains = 16;
constexpr std::uint32_t patches_in_run = 256;
/// Rows of cells after which triangles of any shape follow that lie among them.
constexpr std::uint32_t rows_between = 16;
constexpr std::uint32_t row_start = 8;  ///< numbers of rows of a lattice start at multiples: vectors align

using Place = LatticePlaces::Place;
using Kind = LatticePlaces::Kind;

std::int32_t floor_divide(std::int32_t value, std::int32_t by) {
  return value >= 0 ? value / by : -((by - 1 - value) / by);
}

/// What is being made of one cover.
struct Work {
  LaidCover& cover;
  std::optional<LatticePlaces> lattice;
  std::vector<std::uint32_t> order;            ///< elements by subdomain
  std::vector<std::uint32_t> subdomain_start;  ///< [subdomain + 1] into `order`
  std::vector<std::uint8_t> common;            ///< [patch]
  std::vector<std::uint32_t> home;             ///< [patch] its first subdomain
  std::vector<std::uint32_t> rank;             ///< [patch] by which patches of a subdomain are sorted
  std::vector<std::uint32_t> number;           ///< [patch] new
};

/// By the elements of a body, how many times as large as the least its subdomains are: a power of two.
std::uint32_t enlargement(std::size_t elements, std::uint32_t least) {
  std::uint32_t times = 1;
  while (2 * times * least_elements <= most_elements &&
         elements / (2 * std::size_t{times} * least) >= wanted_subdomains)
    times *= 2;
  return times;
}

void order_by_tile(Work& work) {
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

void order_along_curve(Work& work) {
  const LaidCover& cover = work.cover;
  std::vector<Vec2> centres;
  centres.reserve(cover.elements.size());
  for (const LaidCover::LaidElement& element : cover.elements) {
    const Vec2 a = cover.patches[element.patches[0]], b = cover.patches[element.patches[1]],
               c = cover.patches[element.patches[2]];
    centres.push_back({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
  }
  const std::vector<std::uint64_t> along = along_curve(centres);
  std::sort(work.order.begin(), work.order.end(), [&](std::uint32_t d, std::uint32_t e) {
    return along[d] != along[e] ? along[d] < along[e] : d < e;
  });
  const std::uint32_t triangles = enlargement(work.order.size(), least_elements) * least_elements;
  for (std::uint32_t i = 0; i < work.order.size(); i += triangles) work.subdomain_start.push_back(i);
}

void find_common(Work& work, const std::vector<std::uint32_t>& loaded) {
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
  for (const LaidCover::Steadied& one : cover.steadied) {
    work.common[one.patch] = 1;
    for (const std::uint32_t patch : one.to) work.common[patch] = 1;
  }
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
}

/// Rows of a lattice stay together; elsewhere patches follow the elements, own ones first.
void rank_patches(Work& work) {
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

/// Own patches subdomain after subdomain, then the common ones. Returns how many are own.
std::uint32_t number_patches(Work& work) {
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
  std::uint32_t own = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    work.number[sorted[i]] = i;
    own += work.common[sorted[i]] == 0 ? 1 : 0;
  }
  return own;
}

/// The elements of one subdomain, their patches numbered within it.
class SubdomainMaker {
 public:
  SubdomainMaker(Partition& partition, Work& work, std::uint32_t first_patch)
      : partition_(partition),
        work_(work),
        first_patch_(first_patch),
        local_(work.cover.patches.size(), 0),
        stamp_(work.cover.patches.size(), 0xFFFFFFFFu),
        ready_(work.cover.patches.size(), 0) {}

  void make(std::uint32_t s, std::vector<std::uint32_t>& final_order) {
    const std::uint32_t begin = work_.subdomain_start[s], end = work_.subdomain_start[s + 1];
    std::vector<std::uint32_t> patches;
    for (std::uint32_t i = begin; i < end; ++i) {
      for (const std::uint32_t patch : work_.cover.elements[work_.order[i]].patches) {
        if (stamp_[patch] == s) continue;
        stamp_[patch] = s;
        ready_[patch] = 0;
        patches.push_back(patch);
      }
    }
    std::sort(patches.begin(), patches.end(),
              [&](std::uint32_t p, std::uint32_t q) { return work_.rank[p] < work_.rank[q]; });
    Subdomain subdomain{};
    subdomain.run_begin = static_cast<std::uint32_t>(partition_.runs.size());
    subdomain.slot_begin = static_cast<std::uint32_t>(partition_.slot_patch.size());
    std::uint32_t local = 0;
    std::vector<std::uint32_t> rows{0};
    for (std::uint32_t i = 0; i < patches.size(); ++i, ++local) {
      if (i > 0 && work_.lattice &&
          work_.lattice->patch[patches[i]].row != work_.lattice->patch[patches[i - 1]].row) {
        local = up_to_row_start(local);
        rows.push_back(local);
      }
      place_patch(patches[i], local, subdomain.run_begin);
    }
    rows.push_back(up_to_row_start(local));
    subdomain.run_end = static_cast<std::uint32_t>(partition_.runs.size());
    subdomain.slot_end = static_cast<std::uint32_t>(partition_.slot_patch.size());
    subdomain.chunk_begin = static_cast<std::uint32_t>(partition_.chunks.size());
    add_chunks(begin, end, final_order);
    subdomain.chunk_end = static_cast<std::uint32_t>(partition_.chunks.size());
    time_patches(subdomain, final_order);
    share_places(partition_, subdomain, std::move(rows));
    partition_.subdomains.push_back(subdomain);
  }

 private:
  static std::uint32_t up_to_row_start(std::uint32_t local) {
    return (local + row_start - 1) / row_start * row_start;
  }

  void place_patch(std::uint32_t patch, std::uint32_t local, std::uint32_t first_run) {
    local_[patch] = local;
    const std::uint32_t number = first_patch_ + work_.number[patch];
    if (work_.common[patch] != 0) {
      partition_.slot_patch.push_back(number);
      partition_.slot_local.push_back(local);
      return;
    }
    if (partition_.runs.size() > first_run) {
      PatchRun& last = partition_.runs.back();
      if (last.patch + last.count == number && last.local + last.count == local &&
          last.count < patches_in_run) {
        ++last.count;
        return;
      }
    }
    partition_.runs.push_back({number, local, 1, 0});
  }

  /// From when to when patches are in use.
  void time_patches(const Subdomain& subdomain, const std::vector<std::uint32_t>& final_order) {
    std::vector<std::uint32_t> runs;
    for (std::uint32_t r = subdomain.run_begin; r < subdomain.run_end; ++r)
      runs.push_back(partition_.runs[r].local);
    time(subdomain, final_order, false, subdomain.run_begin, runs, &ElementChunk::run_needed,
         &ElementChunk::run_done);
    const auto slots = partition_.slot_local.begin();
    time(subdomain, final_order, true, subdomain.slot_begin,
         {slots + subdomain.slot_begin, slots + subdomain.slot_end}, &ElementChunk::slot_needed,
         &ElementChunk::slot_done);
  }

  /// The same of runs or slots, whose patches are common or not: `starts` are their first numbers, ascending.
  void time(const Subdomain& subdomain, const std::vector<std::uint32_t>& final_order, bool common,
            std::uint32_t begin, const std::vector<std::uint32_t>& starts,
            std::uint32_t ElementChunk::*needed_by, std::uint32_t ElementChunk::*done_by) {
    const auto end = begin + static_cast<std::uint32_t>(starts.size());
    std::vector<std::uint32_t> least,
        greatest;  // [chunk] those that it touches, from the first to past the last
    for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
      const ElementChunk& chunk = partition_.chunks[c];
      least.push_back(end);
      greatest.push_back(begin);
      for (std::uint32_t e = chunk.element; e < chunk.element + chunk.count; ++e) {
        for (const std::uint32_t patch : work_.cover.elements[final_order[e]].patches) {
          if ((work_.common[patch] != 0) != common) continue;
          const auto past =
              begin + static_cast<std::uint32_t>(
                          std::upper_bound(starts.begin(), starts.end(), local_[patch]) - starts.begin());
          least.back() = std::min(least.back(), past - 1);
          greatest.back() = std::max(greatest.back(), past);
        }
      }
    }
    std::uint32_t needed = begin, done = end;
    for (std::size_t i = 0; i < least.size(); ++i) {
      needed = std::max(needed, greatest[i]);
      partition_.chunks[subdomain.chunk_begin + i].*needed_by = needed;
    }
    for (std::size_t i = least.size(); i-- > 0;) {
      partition_.chunks[subdomain.chunk_begin + i].*done_by = done;
      done = std::min(done, least[i]);
    }
  }

  /// Cells side by side.
  struct Row {
    std::uint32_t first, cells;  ///< an entry of Work::order
    std::int32_t row;            ///< of the lattice
  };

  void add_chunks(std::uint32_t begin, std::uint32_t end, std::vector<std::uint32_t>& final_order) {
    for (std::uint32_t i = begin; work_.lattice && i < end; ++i) {
      const LatticePlaces::ElementPlace& place = work_.lattice->element[work_.order[i]];
      LaidCover::LaidElement& laid = work_.cover.elements[work_.order[i]];
      laid.patches = place.patch;
      laid.lattice = place.kind == Kind::other ? 0 : place.kind == Kind::lower ? 1 : -1;
    }
    std::vector<Row> rows;
    std::vector<std::uint32_t> rest;
    for (std::uint32_t i = begin; i < end;) {
      const std::uint32_t cells = work_.lattice ? cells_from(i, end) : 0;
      if (cells == 0) {
        rest.push_back(work_.order[i++]);
        continue;
      }
      rows.push_back({i, cells, work_.lattice->element[work_.order[i]].cell.row});
      for (const std::uint32_t past = i + 2 * cells; i < past; ++i) {
        for (const std::uint32_t patch : work_.cover.elements[work_.order[i]].patches)
          ready_[patch] = static_cast<std::uint32_t>(rows.size());
      }
    }
    std::vector<std::vector<std::uint32_t>> after(rows.size() / rows_between + 2);
    for (const std::uint32_t e : rest)
      after[(rows_before(e, rows) + rows_between - 1) / rows_between].push_back(e);
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
      if (r % rows_between == 0) add_triangles(after[r / rows_between], final_order);
      add_cells(rows[r].first, rows[r].cells, final_order);
    }
    for (std::size_t i = (rows.size() + rows_between - 1) / rows_between; i < after.size(); ++i)
      add_triangles(after[i], final_order);
  }

  /// How many rows of cells an element of any shape waits for: those below it, those that give forces to its
  /// patches, and those that elements before it wait for. So each patch gets its forces first from rows of
  /// cells, then from other elements, both in their order.
  std::uint32_t rows_before(std::uint32_t element, const std::vector<Row>& rows) {
    if (rows.empty()) return 0;
    const std::int32_t row = work_.lattice->element[element].cell.row;
    auto count = static_cast<std::uint32_t>(
        std::partition_point(rows.begin(), rows.end(), [&](const Row& r) { return r.row <= row; }) -
        rows.begin());
    const auto& patches = work_.cover.elements[element].patches;
    for (const std::uint32_t patch : patches) count = std::max(count, ready_[patch]);
    for (const std::uint32_t patch : patches) ready_[patch] = count;
    return count;
  }

  void add_cells(std::uint32_t i, std::uint32_t cells, std::vector<std::uint32_t>& final_order) {
    const auto first = static_cast<std::uint32_t>(final_order.size());
    for (std::uint32_t c = 0; c < cells; ++c) final_order.push_back(work_.order[i + 2 * c]);
    for (std::uint32_t c = 0; c < cells; ++c) final_order.push_back(work_.order[i + 2 * c + 1]);
    const auto& corner = work_.lattice->element[work_.order[i]].patch;
    partition_.chunks.push_back(
        {first, 2 * cells, cells, local_[corner[0]], local_[corner[2]], 0, 0, 0, 0, 0});
  }

  void add_triangles(const std::vector<std::uint32_t>& elements, std::vector<std::uint32_t>& final_order) {
    const std::uint32_t stride = work_.lattice ? 1 : 2;
    for (std::uint32_t k = 0; k < elements.size(); k += elements_at_once) {
      const auto count =
          std::min<std::uint32_t>(elements_at_once, static_cast<std::uint32_t>(elements.size()) - k);
      partition_.chunks.push_back({static_cast<std::uint32_t>(final_order.size()), count, 0, 0, 0,
                                   static_cast<std::uint32_t>(partition_.corner[0].size()), 0, 0, 0, 0});
      for (std::uint32_t n = k; n < k + count; ++n) {
        final_order.push_back(elements[n]);
        for (std::size_t c = 0; c < 3; ++c)
          partition_.corner[c].push_back(stride * local_[work_.cover.elements[elements[n]].patches[c]]);
      }
    }
  }

  /// How many whole cells stand side by side from an element on, with patches side by side.
  std::uint32_t cells_from(std::uint32_t begin, std::uint32_t end) const {
    std::uint32_t cells = 0;
    std::uint32_t bottom = 0, top = 0;
    Place first{};
    for (std::uint32_t i = begin; i + 1 < end && 2 * cells + 2 <= elements_at_once; i += 2, ++cells) {
      const auto &lower = work_.lattice->element[work_.order[i]],
                 &upper = work_.lattice->element[work_.order[i + 1]];
      if (lower.kind != Kind::lower || upper.kind != Kind::upper || lower.cell != upper.cell) break;
      const std::uint32_t left = local_[lower.patch[0]], above = local_[lower.patch[2]];
      if (cells == 0) bottom = left, top = above, first = lower.cell;
      const bool follows = lower.cell.row == first.row &&
                           lower.cell.column == first.column + static_cast<std::int32_t>(cells) &&
                           left == bottom + cells && above == top + cells;
      const bool joined = local_[lower.patch[1]] == left + 1 && upper.patch[2] == lower.patch[1] &&
                          upper.patch[1] == lower.patch[2] && local_[upper.patch[0]] == above + 1;
      if (!follows || !joined) break;
    }
    return cells;
  }

  Partition& partition_;
  Work& work_;
  std::uint32_t first_patch_;
  std::vector<std::uint32_t> local_, stamp_;  ///< [patch]
  std::vector<std::uint32_t> ready_;          ///< [patch] rows of cells after which its forces can go on
};

/// Puts the cover into the new order.
void renumber(Work& work, const std::vector<std::uint32_t>& final_order) {
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

std::uint32_t partition_cover(Partition& partition, LaidCover& cover,
                              const std::vector<std::uint32_t>& loaded, std::uint32_t first_patch) {
  Work work{cover, find_lattice(cover), {}, {}, {}, {}, {}, {}};
  work.order.resize(cover.elements.size());
  std::iota(work.order.begin(), work.order.end(), 0u);
  if (work.lattice) {
    order_by_tile(work);
  } else {
    order_along_curve(work);
  }
  work.subdomain_start.push_back(static_cast<std::uint32_t>(work.order.size()));
  find_common(work, loaded);
  rank_patches(work);
  const std::uint32_t own = number_patches(work);
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
  return own;
}

}  // namespace talus
