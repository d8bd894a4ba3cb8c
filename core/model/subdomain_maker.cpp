#include "model/subdomain_maker.hpp"

#include "model/laid_cover.hpp"
#include "model/shared_places.hpp"

#include <talus/material.hpp>

#include <algorithm>
#include <utility>

namespace talus {
namespace {

constexpr std::uint32_t elements_at_once = 256;  ///< in a chunk
constexpr std::uint32_t patches_in_run = 256;
/// Rows of cells after which triangles of any shape follow that lie among them.
constexpr std::uint32_t rows_between = 16;
constexpr std::uint32_t row_start = 8;  ///< numbers of rows of a lattice start at multiples: vectors align

using Kind = LatticePlaces::Kind;

std::uint32_t up_to_row_start(std::uint32_t local) {
  return (local + row_start - 1) / row_start * row_start;
}

}  // namespace

SubdomainMaker::SubdomainMaker(Partition& partition, PartitionWork& work, std::uint32_t first_patch)
    : partition_(partition),
      work_(work),
      first_patch_(first_patch),
      local_(work.cover.patches.size(), 0),
      stamp_(work.cover.patches.size(), 0xFFFFFFFFu),
      ready_(work.cover.patches.size(), 0) {}

void SubdomainMaker::make(std::uint32_t s, std::vector<std::uint32_t>& final_order) {
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
  if (work_.lattice) {
    add_chunks(begin, end, final_order);
  } else {
    add_chain(work_.chain[s], final_order);
  }
  subdomain.chunk_end = static_cast<std::uint32_t>(partition_.chunks.size());
  time_patches(subdomain, final_order);
  share_places(partition_, subdomain, std::move(rows));
  partition_.subdomains.push_back(subdomain);
}

void SubdomainMaker::place_patch(std::uint32_t patch, std::uint32_t local, std::uint32_t first_run) {
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

void SubdomainMaker::time_patches(const Subdomain& subdomain, const std::vector<std::uint32_t>& final_order) {
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

void SubdomainMaker::time(const Subdomain& subdomain, const std::vector<std::uint32_t>& final_order,
                          bool common, std::uint32_t begin, const std::vector<std::uint32_t>& starts,
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
            begin + static_cast<std::uint32_t>(std::upper_bound(starts.begin(), starts.end(), local_[patch]) -
                                               starts.begin());
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

void SubdomainMaker::add_chunks(std::uint32_t begin, std::uint32_t end,
                                std::vector<std::uint32_t>& final_order) {
  for (std::uint32_t i = begin; i < end; ++i) {
    const LatticePlaces::ElementPlace& place = work_.lattice->element[work_.order[i]];
    LaidCover::LaidElement& laid = work_.cover.elements[work_.order[i]];
    laid.patches = place.patch;
    laid.lattice = place.kind == Kind::other ? 0 : place.kind == Kind::lower ? 1 : -1;
  }
  std::vector<Row> rows;
  std::vector<std::uint32_t> rest;
  for (std::uint32_t i = begin; i < end;) {
    const std::uint32_t cells = cells_from(i, end);
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
    if (r % rows_between == 0) add_chain(chain_triangles(work_.cover, after[r / rows_between]), final_order);
    add_cells(rows[r].first, rows[r].cells, final_order);
  }
  for (std::size_t i = (rows.size() + rows_between - 1) / rows_between; i < after.size(); ++i)
    add_chain(chain_triangles(work_.cover, after[i]), final_order);
}

std::uint32_t SubdomainMaker::rows_before(std::uint32_t element, const std::vector<Row>& rows) {
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

void SubdomainMaker::add_cells(std::uint32_t i, std::uint32_t cells,
                               std::vector<std::uint32_t>& final_order) {
  const auto first = static_cast<std::uint32_t>(final_order.size());
  for (std::uint32_t c = 0; c < cells; ++c) final_order.push_back(work_.order[i + 2 * c]);
  for (std::uint32_t c = 0; c < cells; ++c) final_order.push_back(work_.order[i + 2 * c + 1]);
  const auto& corner = work_.lattice->element[work_.order[i]].patch;
  partition_.chunks.push_back(
      {first, 2 * cells, cells, local_[corner[0]], local_[corner[2]], 0, 0, 0, 0, 0, 0});
}

void SubdomainMaker::add_chain(std::span<const ChainLink> chain, std::vector<std::uint32_t>& final_order) {
  std::uint32_t room = 0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const ChainLink& link = chain[i];
    const bool triangle = link.element != ChainLink::no_element;
    if (!triangle) {
      if (room > 0) add_link(link.patch, 0);
      continue;
    }
    if (room == 0) {
      room = elements_at_once;
      begin_chunk(chain[i - 2].patch, final_order);
      add_link(chain[i - 2].patch, 0);
      add_link(chain[i - 1].patch, 0);
    }
    add_link(link.patch, 1);
    final_order.push_back(link.element);
    work_.cover.elements[link.element].patches = {chain[i - 2].patch, chain[i - 1].patch, link.patch};
    ++partition_.chunks.back().count;
    if (--room == 0 || i + 1 == chain.size()) end_chunk(link.patch);
  }
}

void SubdomainMaker::begin_chunk(std::uint32_t patch, const std::vector<std::uint32_t>& final_order) {
  for (std::uint32_t i = 0; i < TriangleChain::links_before; ++i) add_link(patch, 0);
  partition_.chunks.push_back({static_cast<std::uint32_t>(final_order.size()), 0, 0, 0, 0,
                               static_cast<std::uint32_t>(partition_.corner.size()), 0, 0, 0, 0, 0});
}

void SubdomainMaker::end_chunk(std::uint32_t patch) {
  ElementChunk& chunk = partition_.chunks.back();
  const auto links = [&] { return static_cast<std::uint32_t>(partition_.corner.size()) - chunk.link; };
  for (std::uint32_t i = 0; i < TriangleChain::links_after || links() % TriangleChain::multiple != 0; ++i)
    add_link(patch, 0);
  chunk.links = links();
}

void SubdomainMaker::add_link(std::uint32_t patch, double area) {
  partition_.corner.push_back((work_.lattice ? 1 : 2) * local_[patch]);
  partition_.area.push_back(area);
}

std::uint32_t SubdomainMaker::cells_from(std::uint32_t begin, std::uint32_t end) const {
  std::uint32_t cells = 0;
  std::uint32_t bottom = 0, top = 0;
  LatticePlaces::Place first{};
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

}  // namespace talus
