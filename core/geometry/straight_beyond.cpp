#include "geometry/straight_beyond.hpp"

#include "geometry/vec2.hpp"

#include <algorithm>
#include <optional>

namespace talus {
namespace {

/// Cosine of the turn below which two sides count as one straight stretch.
constexpr double straight = 1 - 1e-9;

/// Walks around a body over the cuts between its pieces.
class Outline {
 public:
  Outline(std::span<const BoundaryCorner> corners, std::span<const std::uint32_t> piece_start)
      : corners_(corners), next_(corners.size()), previous_(corners.size()) {
    for (std::size_t p = 0; p + 1 < piece_start.size(); ++p) {
      const std::uint32_t begin = piece_start[p] - piece_start[0], end = piece_start[p + 1] - piece_start[0];
      for (std::uint32_t c = begin; c < end; ++c) {
        next_[c] = c + 1 == end ? begin : c + 1;
        previous_[next_[c]] = c;
        if (is_cut(c)) banks_.push_back(c);
      }
    }
    std::ranges::sort(banks_, {}, [&](std::uint32_t side) { return std::pair{corners_[side].cut, side}; });
  }

  struct Beyond {
    double straight = 0, spanned = 0;  ///< m
  };
  /// How far it goes on beyond the cut at the end (`forward`) or at the start of a side.
  Beyond beyond(std::uint32_t side, bool forward) const {
    if (is_cut(side) || !(corners_[side].length > 0) || !is_cut(beside(side, forward))) return {};
    Beyond way;
    std::uint32_t before = side;
    for (auto at = neighbour(side, forward); at && *at != side; at = neighbour(*at, forward)) {
      const auto share_from = [&](std::uint32_t from) {
        return forward ? goes_on(from, *at) : goes_on(*at, from);
      };
      const double share = share_from(side);
      if (!(share > 0 && share_from(before) > 0)) break;  // nor over a bend that is taken back
      const bool straight_on = share == 1 && way.spanned == 0;
      (straight_on ? way.straight : way.spanned) += share * corners_[*at].length;
      before = *at;
    }
    return way;
  }

 private:
  bool is_cut(std::uint32_t side) const { return corners_[side].surface == internal_side; }
  std::uint32_t beside(std::uint32_t side, bool forward) const {
    return forward ? next_[side] : previous_[side];
  }

  /// How much of a later side counts as straight on from an earlier: cos 2θ of one turned inwards by θ, for
  /// what lies flat on the one spans the corner to the other.
  double goes_on(std::uint32_t earlier, std::uint32_t later) const {
    const BoundaryCorner &p = corners_[earlier], &q = corners_[later];
    const double cosine = p.tangent_x * q.tangent_x + p.tangent_y * q.tangent_y;
    if (cosine >= straight) return 1;
    const bool inwards = p.tangent_x * q.tangent_y - p.tangent_y * q.tangent_x < 0;
    return inwards && cosine > 0 ? 2 * cosine * cosine - 1 : 0;
  }

  /// The next side of the boundary in that direction.
  std::optional<std::uint32_t> neighbour(std::uint32_t side, bool forward) const {
    std::uint32_t at = beside(side, forward);
    for (std::size_t crossed = 0; is_cut(at); ++crossed) {
      const auto bank = across(at, corners_[forward ? at : next_[at]], forward);
      if (!bank || crossed == banks_.size()) return std::nullopt;
      at = beside(*bank, forward);
    }
    return corners_[at].length > 0 ? std::optional(at) : std::nullopt;
  }

  /// The other bank of a cut, where it ends (`forward`) or starts at a corner.
  std::optional<std::uint32_t> across(std::uint32_t cut, const BoundaryCorner& corner, bool forward) const {
    const auto by_number = [&](std::uint32_t p, std::uint32_t q) {
      return corners_[p].cut < corners_[q].cut;
    };
    const double near = 1e-9 * corners_[cut].length;
    const auto [begin, end] = std::equal_range(banks_.begin(), banks_.end(), cut, by_number);
    for (auto side = begin; side != end; ++side) {
      const BoundaryCorner& at = corners_[forward ? next_[*side] : *side];
      if (*side != cut && size_of({at.x - corner.x, at.y - corner.y}) <= near) return *side;
    }
    return std::nullopt;
  }

  std::span<const BoundaryCorner> corners_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint32_t> banks_;  ///< sides that are cuts, by the number of the cut
};

}  // namespace

std::vector<double> straight_beyond(std::span<const BoundaryCorner> corners,
                                    std::span<const std::uint32_t> piece_start) {
  const Outline outline(corners, piece_start);
  std::vector<double> shares(4 * corners.size());
  for (std::uint32_t side = 0; side < corners.size(); ++side) {
    for (const bool forward : {false, true}) {
      const auto [straight_on, spanned] = outline.beyond(side, forward);
      double* const at = &shares[4 * side + (forward ? 1 : 0)];
      if (straight_on > 0) at[0] = straight_on / corners[side].length;
      if (spanned > 0) at[2] = spanned / corners[side].length;
    }
  }
  return shares;
}

}  // namespace talus
