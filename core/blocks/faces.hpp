#pragma once

#include "blocks/cut.hpp"

#include <vector>

namespace talus {

/// Lengths and areas that rounding alone tells apart, of a block metres wide as far away as coordinates go,
/// count as equal, so that it does not decide.
constexpr double all_but_rounding = 1 - 1e-7;

/// m, of all rings.
double perimeter_of(const Loops& loops);

/// Merges faces below `smallest` (m²) or thinner than `thinnest` (m) into neighbours as cut_domain says.
/// Faces that touch have the same vertices along their common boundary. Areas must be set.
std::vector<Block> merge_small_faces(std::vector<Block> faces, double smallest, double thinnest,
                                     const Geos& geos);

/// Turns loops the right way round and lets each begin at its lowest, leftmost vertex; sets area and
/// centroid.
/// Surfaces of edges that are known go with them, where the loops are the right way round already.
void orient(Block& block);

/// Sorts by centroid and area; places less than `same` (m) apart count as one.
void sort_blocks(std::vector<Block>& blocks, double same);

/// Drops vertices within `most` (m) of the one before or of the line between their neighbours, where both
/// edges are of the same surface. Beside thin blocks less is allowed: what one block loses there its
/// neighbour may keep, and the two must not overlap by more than rounding.
void drop_idle_vertices(std::vector<Block>& blocks, double most);

/// Splits a share of the convex quadrilaterals along their shorter diagonals, at random by their order,
/// where no triangle is below `smallest` (m²) or thinner than `thinnest` (m), as faces are that merge.
void split_quadrilaterals(std::vector<Block>& blocks, double share, std::uint64_t seed, double smallest,
                          double thinnest);

/// Which surface each edge belongs to: that of the first line which it lies on, within `tolerance` (m); where
/// a corner was cut off, of the first line that the sides of the corner lie on. Returns the names of those
/// that lie on others.
NamesOfOneLine name_edges(std::vector<Block>& blocks, const Block& domain, const std::vector<Cut>& cuts,
                          const std::vector<Chord>& chords, double tolerance, const Geos& geos);

}  // namespace talus
