#pragma once

#include "lattice.hpp"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace talus::hexagonal {

/// A body that cannot be covered, in words for the user.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Too much nearly coincides for one tolerance; another one may do.
class TooClose : public Refusal {
 public:
  TooClose()
      : Refusal(
            "outline, discontinuities and lattice nearly coincide in too many places; shift the lattice by "
            "another offset, or join what lies closer together than 1e-7 of the size") {}
};

/// Where several coincide, the first wins.
enum class EdgeKind : std::uint8_t { outline, discontinuity, lattice };

/// A straight piece between two nodes, directed: of the outline with the body on its left, of a side of the
/// lattice in its own direction.
struct Segment {
  std::uint32_t p, q;
  EdgeKind kind;
  std::uint32_t label;  ///< the side of outline or discontinuity, as CoverSink numbers it
  LatticeSide lattice{};
};

/// The nodes of the planar graph. Any two of them are farther apart than the tolerance.
class Nodes {
 public:
  explicit Nodes(std::int64_t tolerance) : tolerance_(tolerance) {}

  /// The node at a vertex of the lattice.
  std::uint32_t vertex(GridPoint at);

  /// The node at a place moved onto the lattice, or the nearest one within the tolerance, or a new one.
  std::uint32_t near(GridPoint at);

  const GridPoint& operator[](std::uint32_t node) const { return at_[node]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(at_.size()); }
  std::int64_t tolerance() const { return tolerance_; }

 private:
  struct Hash {
    std::size_t operator()(const GridPoint& square) const;
  };

  std::uint32_t add(GridPoint at);
  std::uint32_t nearest(GridPoint at, std::int64_t reach) const;

  std::int64_t tolerance_;
  std::vector<GridPoint> at_;
  std::vector<std::uint32_t> next_;  ///< [node] another one in the same square of the grid
  std::unordered_map<GridPoint, std::uint32_t, Hash> square_;  ///< one node of it; looked up, never walked
};

/// Splits segments until they meet in nodes only and no node lies within the tolerance of a segment that does
/// not end there. Throws TooClose if that has no end.
void node_segments(Nodes& nodes, std::vector<Segment>& segments);

}  // namespace talus::hexagonal
