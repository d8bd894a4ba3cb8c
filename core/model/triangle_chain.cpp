#include "model/triangle_chain.hpp"

#include "model/laid_cover.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>

namespace talus {
namespace {

constexpr std::uint32_t none = ChainLink::no_element;

/// Makes strips by walking from triangle to triangle, as long as there is a way. Each starts where the fewest
/// neighbours are left, so that none is left alone, and tries all orders of its first three corners.
class ChainMaker {
 public:
  ChainMaker(const LaidCover& cover, std::span<const std::uint32_t> elements)
      : elements_(elements),
        neighbour_(elements.size(), {none, none, none}),
        free_neighbours_(elements.size(), 0),
        taken_(elements.size(), 0) {
    for (const std::uint32_t element : elements) corners_.push_back(cover.elements[element].patches);
    find_neighbours();
    for (std::uint32_t e = 0; e < elements.size(); ++e) starts_.insert({free_neighbours_[e], e});
  }

  std::vector<ChainLink> make() {
    while (!starts_.empty()) add_longest_from(starts_.begin()->second);
    return std::move(chain_);
  }

 private:
  /// Corners of the first triangle of a strip, in the order of the chain.
  using Order = std::array<std::size_t, 3>;

  void find_neighbours() {
    struct Edge {
      std::uint32_t low, high, element, opposite;
      auto operator<=>(const Edge&) const = default;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * corners_.size());
    for (std::uint32_t e = 0; e < corners_.size(); ++e) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t p = corners_[e][(k + 1) % 3], q = corners_[e][(k + 2) % 3];
        edges.push_back({std::min(p, q), std::max(p, q), e, k});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      const Edge &p = edges[i], &q = edges[i + 1];
      if (p.low != q.low || p.high != q.high) continue;
      neighbour_[p.element][p.opposite] = q.element;
      neighbour_[q.element][q.opposite] = p.element;
      ++free_neighbours_[p.element];
      ++free_neighbours_[q.element];
      ++i;
    }
  }

  /// The triangle beyond the side opposite a patch, unless it is taken.
  std::uint32_t beyond(std::uint32_t element, std::uint32_t opposite, std::uint32_t trial) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners_[element][k] != opposite) continue;
      const std::uint32_t next = neighbour_[element][k];
      return next != none && taken_[next] != all && taken_[next] != trial ? next : none;
    }
    return none;
  }

  std::uint32_t third_corner(std::uint32_t element, std::uint32_t p, std::uint32_t q) const {
    for (const std::uint32_t corner : corners_[element]) {
      if (corner != p && corner != q) return corner;
    }
    return p;
  }

  /// Calls each(patch, element) along a strip from its first triangle on; returns how many triangles it has
  /// less how often it turns. Triangles are taken by `mark`.
  template <class Each>
  int walk(std::uint32_t element, const Order& order, std::uint32_t mark, const Each& each) {
    std::uint32_t a = corners_[element][order[0]], b = corners_[element][order[1]],
                  c = corners_[element][order[2]];
    int worth = 1;
    taken_[element] = mark;
    each(a, none);
    each(b, none);
    each(c, element);
    while (true) {
      std::uint32_t next = beyond(element, a, mark);
      if (next == none) {
        next = beyond(element, b, mark);
        if (next == none) return worth;
        each(a, none);  // of b, c, and a again there is no triangle
        --worth;
        b = a;
        std::swap(b, c);  // now the last two are c and a
      }
      element = next;
      taken_[element] = mark;
      const std::uint32_t d = third_corner(element, b, c);
      each(d, element);
      ++worth;
      a = b;
      b = c;
      c = d;
    }
  }

  void add_longest_from(std::uint32_t element) {
    static constexpr std::array<Order, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}}};
    const Order* best = orders.data();
    int most = 0;
    for (const Order& order : orders) {
      const int worth = walk(element, order, ++trial_, [](std::uint32_t, std::uint32_t) {});
      if (worth > most) most = worth, best = &order;
    }
    walk(element, *best, all, [&](std::uint32_t patch, std::uint32_t of) {
      chain_.push_back({patch, of == none ? none : elements_[of]});
      if (of != none) leave(of);
    });
  }

  void leave(std::uint32_t element) {
    starts_.erase({free_neighbours_[element], element});
    for (const std::uint32_t other : neighbour_[element]) {
      if (other == none) continue;
      if (starts_.erase({free_neighbours_[other], other}) == 0) continue;
      --free_neighbours_[other];
      starts_.insert({free_neighbours_[other], other});
    }
  }

  static constexpr std::uint32_t all = 0xFFFFFFFFu;  ///< the mark of what is in the chain

  std::span<const std::uint32_t> elements_;
  std::vector<std::array<std::uint32_t, 3>> corners_;    ///< [place in elements_], like all below
  std::vector<std::array<std::uint32_t, 3>> neighbour_;  ///< beyond the side opposite each corner
  std::vector<std::uint32_t> free_neighbours_;
  std::vector<std::uint32_t> taken_;                          ///< the last trial that took it, or `all`
  std::set<std::pair<std::uint32_t, std::uint32_t>> starts_;  ///< free neighbours, and place
  std::vector<ChainLink> chain_;
  std::uint32_t trial_ = 0;
};

}  // namespace

std::vector<ChainLink> chain_triangles(const LaidCover& cover, std::span<const std::uint32_t> elements) {
  return ChainMaker(cover, elements).make();
}

}  // namespace talus
