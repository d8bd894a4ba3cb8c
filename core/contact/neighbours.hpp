#pragma once

#include "model/model.hpp"
#include "model/motion.hpp"

#include <talus/contact_model.hpp>

#include <vector>

namespace talus {

/// Two pieces whose boxes come within the skin of each other: a of the body of lower number, or of lower
/// number itself of a body that meets itself.
struct Candidate {
  std::uint32_t piece_a, piece_b;
  bool operator==(const Candidate&) const = default;
};

/// By bodies, then by their pieces.
class CandidateOrder {
 public:
  explicit CandidateOrder(const Model& model)
      : body_(model.piece_body.data()), divided_(model.piece_body.size() != model.bodies.size()) {}

  bool operator()(const Candidate& p, const Candidate& q) const {
    if (divided_ && body_[p.piece_a] == body_[q.piece_a] && body_[p.piece_b] != body_[q.piece_b])
      return p.piece_b < q.piece_b;
    return p.piece_a != q.piece_a ? p.piece_a < q.piece_a : p.piece_b < q.piece_b;
  }

 private:
  const std::uint32_t* body_;  ///< [piece], rising
  bool divided_;               ///< some body has several
};

/// Whether all of `piece` is more than `margin` outside of a side of `other`, which keeps the two apart.
bool outside_of_a_side(const Model& model, const MotionState& motion, std::uint32_t piece,
                       std::uint32_t other, double margin);

/// Finds candidates in O(N): a uniform grid for the common pieces, a list for the few that are much larger.
class NeighbourSearch {
 public:
  explicit NeighbourSearch(const Model& model);

  /// All candidates with boxes grown by `skin`/2 each, in CandidateOrder. Left out is what lies more than
  /// `skin` outside of a side of a large piece, where one of both is fixed: boxes say little of long slopes.
  /// The vector is reused.
  void find(const Model& model, const MotionState& motion, double skin, std::vector<Candidate>& candidates);

 private:
  struct Box {
    double low_x, low_y, high_x, high_y;
  };
  struct Cell {
    std::int32_t x, y;
  };
  /// A cell's tag, then a piece that it holds. Cells may share a tag, which only costs.
  using CellEntry = std::uint64_t;

  void measure_boxes(const Model& model, const MotionState& motion, double skin);
  Cell cell_of(double x, double y) const;
  static std::uint64_t tag_of(const Cell& cell);
  std::uint64_t tag_of_shared_corner(std::uint32_t p, std::uint32_t q) const;
  void fill_grid();
  static bool may_meet_itself(const Model& model, std::uint32_t p, std::uint32_t q);
  bool meet(std::uint32_t p, std::uint32_t q) const;  ///< their boxes
  static bool outside(const Model& model, const MotionState& motion, std::uint32_t large, std::uint32_t p,
                      double skin);
  static void offer(const Model& model, std::uint32_t p, std::uint32_t q, std::vector<Candidate>& candidates);

  double cell_ = 1;  ///< m, edge of a grid cell
  Vec2 origin_;      ///< all centres are taken relative to this, so that far coordinates cost nothing
  std::vector<Box> boxes_;
  std::vector<CellEntry> grid_;
  std::vector<std::uint32_t> large_;
};

}  // namespace talus
