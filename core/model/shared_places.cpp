#include "model/shared_places.hpp"

#include <talus/material.hpp>

#include <algorithm>
#include <utility>

namespace talus {
namespace {

/// Rows of patches by the numbers that they start with.
class PatchRows {
 public:
  explicit PatchRows(std::vector<std::uint32_t> starts) : starts_(std::move(starts)) {}

  std::uint32_t of(std::uint32_t local) const {
    return static_cast<std::uint32_t>(std::upper_bound(starts_.begin(), starts_.end(), local) -
                                      starts_.begin()) -
           1;
  }
  std::uint32_t start(std::uint32_t row) const { return starts_[row]; }
  std::uint32_t widest() const {
    std::uint32_t width = 0;
    for (std::size_t i = 0; i + 1 < starts_.size(); ++i) width = std::max(width, starts_[i + 1] - starts_[i]);
    return width;
  }

 private:
  std::vector<std::uint32_t> starts_;
};

/// How many rows in a row are in use at once, at most.
std::uint32_t rows_at_once(const Partition& partition, const Subdomain& subdomain, const PatchRows& rows) {
  std::uint32_t most = 1;
  std::uint32_t run = subdomain.run_begin, slot = subdomain.slot_begin;  // the first in use
  for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
    const ElementChunk& chunk = partition.chunks[c];
    std::uint32_t first = 0xFFFFFFFFu, last = 0;
    const auto use = [&](std::uint32_t from, std::uint32_t to) {
      first = std::min(first, rows.of(from));
      last = std::max(last, rows.of(to));
    };
    if (run < chunk.run_needed) use(partition.runs[run].local, partition.runs[chunk.run_needed - 1].local);
    if (slot < chunk.slot_needed)
      use(partition.slot_local[slot], partition.slot_local[chunk.slot_needed - 1]);
    most = std::max(most, last - first + 1);
    run = chunk.run_done;
    slot = chunk.slot_done;
  }
  return most;
}

}  // namespace

void share_places(Partition& partition, Subdomain& subdomain, std::vector<std::uint32_t> starts) {
  subdomain.patch_count = starts.back();
  if (starts.size() == 2) return;
  // Rows that one run joins stay together.
  for (std::uint32_t r = subdomain.run_begin; r < subdomain.run_end; ++r) {
    const PatchRun& run = partition.runs[r];
    std::erase_if(starts, [&](std::uint32_t row) { return row > run.local && row < run.local + run.count; });
  }
  const PatchRows rows(std::move(starts));
  const std::uint32_t at_once = rows_at_once(partition, subdomain, rows), width = rows.widest();
  const auto place = [&](std::uint32_t& local) {
    const std::uint32_t row = rows.of(local);
    local = row % at_once * width + (local - rows.start(row));
  };
  for (std::uint32_t r = subdomain.run_begin; r < subdomain.run_end; ++r) place(partition.runs[r].local);
  for (std::uint32_t i = subdomain.slot_begin; i < subdomain.slot_end; ++i) place(partition.slot_local[i]);
  for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
    ElementChunk& chunk = partition.chunks[c];
    if (chunk.cells > 0) {
      place(chunk.bottom);
      place(chunk.top);
      continue;
    }
    for (std::uint32_t i = chunk.link - TriangleChain::links_before; i < chunk.link + chunk.links; ++i)
      place(partition.corner[i]);
  }
  subdomain.patch_count = at_once * width;
}

}  // namespace talus
