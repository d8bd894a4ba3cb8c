#pragma once

#include <talus/cover_builder.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace talus {

struct LaidCover;

/// Elements whose stress is found together, side by side in the order of Model::elements: of a regular
/// lattice the lower triangles of some cells of one strip, then their upper ones; otherwise any triangles.
struct ElementChunk {
  std::uint32_t element;      ///< the first, from the first of its body
  std::uint32_t count;        ///< of elements
  std::uint32_t cells;        ///< of the lattice; 0: triangles of any shape
  std::uint32_t bottom, top;  ///< lattice: the leftmost patch below and above, in numbers of the subdomain
  std::uint32_t link, links;  ///< any shape: the first entry of Partition::corner, gradient, area; how many
  std::uint32_t run_needed;   ///< runs before this one are touched by now
  std::uint32_t run_done;     ///< runs before this one are not touched after it
  std::uint32_t slot_needed, slot_done;  ///< the same of slots
};

/// Patches of a subdomain that follow each other in its own numbers and in those of the model.
struct PatchRun {
  std::uint32_t patch, local, count;
  double mass;  ///< kg/m, of each; 0 where they differ
};

/// A part of a body that is worked on in one go, small enough for the cache. Its own patches are those that
/// only its elements touch and on which nothing else acts; the others are common patches.
struct Subdomain {
  std::uint32_t run_begin, run_end;      ///< own patches
  std::uint32_t slot_begin, slot_end;    ///< common patches
  std::uint32_t chunk_begin, chunk_end;  ///< elements
  std::uint32_t patch_count;             ///< room for those in use at once, own and common, from 0
};

/// A regular lattice of triangles: ∇w of the second and the third corner of a lower triangle; those of an
/// upper one are opposite.
struct RegularLattice {
  std::array<double, 4> gradient{};  ///< x, y, x, y, 1/m
  double area = 0;                   ///< m², of a triangle
};

/// How bodies of many elements are divided. Elements add their forces within a subdomain in a fixed order;
/// what they give to common patches waits in a slot each and is added in the order of the slots. So the bits
/// do not depend on who works on which subdomain.
struct Partition {
  std::vector<Subdomain> subdomains;  ///< body after body
  std::vector<PatchRun> runs;
  std::vector<ElementChunk> chunks;
  std::vector<std::uint32_t> slot_patch, slot_local;  ///< [slot] number in the model, in the subdomain
  std::vector<std::uint32_t> common_start;            ///< [common patch + 1] into common_slot
  std::vector<std::uint32_t> common_slot;
  std::vector<RegularLattice> lattices;  ///< [body] of many elements
  // Triangles of any shape, as the chains of chain_triangles(): what a link has makes a triangle with what
  // the two links before it have. Each chunk is a chain of its own, with as many links without triangle
  // before and after it as TriangleChain asks for.
  /// Numbers of the subdomain; twice that in bodies without a lattice, whose vectors have y beside x.
  std::vector<std::uint32_t> corner;
  std::array<std::vector<double>, 4> gradient;  ///< second corner x, y, third x, y, 1/m; or 0
  std::vector<double> area;                     ///< m²; 0: no triangle

  std::uint32_t common_count() const {
    return common_start.empty() ? 0 : static_cast<std::uint32_t>(common_start.size() - 1);
  }
};

/// How many patches of a body come first in the new numbers.
struct PartitionCounts {
  std::uint32_t own = 0;   ///< of one subdomain each
  std::uint32_t free = 0;  ///< with the common ones that are not steadied and steady no others
};

/// Numbers patches and elements of a cover anew, so that what is worked on together lies together, and adds
/// its subdomains: by row and column where a regular lattice is found in it, otherwise along a space-filling
/// curve. Elements of `loaded` and of the boundary have common patches only, and what steadied patches lean
/// on is common like them. Gradients and areas of triangles are left for later, as are masses; `first_patch`
/// is what the model adds to the numbers of patches.
PartitionCounts partition_cover(Partition& partition, LaidCover& cover,
                                const std::vector<std::uint32_t>& loaded, std::uint32_t first_patch);

}  // namespace talus
