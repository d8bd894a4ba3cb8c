#pragma once

#include "model/lattice_places.hpp"
#include "model/partition.hpp"
#include "model/triangle_chain.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace talus {

/// What is being made of one cover.
struct PartitionWork {
  LaidCover& cover;
  std::optional<LatticePlaces> lattice;
  std::vector<std::uint32_t> order;            ///< elements by subdomain
  std::vector<std::uint32_t> subdomain_start;  ///< [subdomain + 1] into `order`
  std::vector<std::vector<ChainLink>> chain;   ///< [subdomain] without a lattice: all of it
  std::vector<std::uint8_t> common;            ///< [patch] 0 own, 1 common, 2 common and about slivers
  std::vector<std::uint32_t> home;             ///< [patch] its first subdomain
  std::vector<std::uint32_t> rank;             ///< [patch] by which patches of a subdomain are sorted
  std::vector<std::uint32_t> number;           ///< [patch] new
};

/// Adds to a partition the elements of one subdomain after another, their patches numbered within it.
class SubdomainMaker {
 public:
  SubdomainMaker(Partition& partition, PartitionWork& work, std::uint32_t first_patch);

  void make(std::uint32_t subdomain, std::vector<std::uint32_t>& final_order);

 private:
  void place_patch(std::uint32_t patch, std::uint32_t local, std::uint32_t first_run);
  /// From when to when patches are in use.
  void time_patches(const Subdomain& subdomain, const std::vector<std::uint32_t>& final_order);
  /// The same of runs or slots, whose patches are common or not: `starts` are their first numbers, ascending.
  void time(const Subdomain& subdomain, const std::vector<std::uint32_t>& final_order, bool common,
            std::uint32_t begin, const std::vector<std::uint32_t>& starts,
            std::uint32_t ElementChunk::*needed_by, std::uint32_t ElementChunk::*done_by);

  /// Cells side by side.
  struct Row {
    std::uint32_t first, cells;  ///< an entry of PartitionWork::order
    std::int32_t row;            ///< of the lattice
  };
  /// Of a lattice: rows of cells, and chains of what is no row.
  void add_chunks(std::uint32_t begin, std::uint32_t end, std::vector<std::uint32_t>& final_order);
  /// How many rows of cells an element of any shape waits for: those below it, those that give forces to its
  /// patches, and those that elements before it wait for. So each patch gets its forces first from rows of
  /// cells, then from other elements.
  std::uint32_t rows_before(std::uint32_t element, const std::vector<Row>& rows);
  /// How many whole cells stand side by side from an element on, with patches side by side.
  std::uint32_t cells_from(std::uint32_t begin, std::uint32_t end) const;
  void add_cells(std::uint32_t i, std::uint32_t cells, std::vector<std::uint32_t>& final_order);

  /// Chunk after chunk. Each begins with a triangle, and with the two links before it, without theirs.
  void add_chain(std::span<const ChainLink> chain, std::vector<std::uint32_t>& final_order);
  void begin_chunk(std::uint32_t patch, const std::vector<std::uint32_t>& final_order);
  void end_chunk(std::uint32_t patch);
  /// The area of a triangle comes later.
  void add_link(std::uint32_t patch, double area);

  Partition& partition_;
  PartitionWork& work_;
  std::uint32_t first_patch_;
  std::vector<std::uint32_t> local_, stamp_;  ///< [patch]
  std::vector<std::uint32_t> ready_;          ///< [patch] rows of cells after which its forces can go on
};

}  // namespace talus
