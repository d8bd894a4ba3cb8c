#pragma once

#include "simulation/simulation.hpp"

#include <array>
#include <vector>

namespace talus {

/// Whether supports or prescribed surfaces move a body as the scene says.
bool is_driven(const Scene& scene, std::size_t body);

/// A body, or a fragment that joints cut out of it.
struct FollowedPiece {
  std::size_t body;
  double width;                ///< m, the smallest across it
  double size;                 ///< m, that, or the size of its elements where it is less
  std::array<bool, 2> counts;  ///< whether motion along x, y does: not where the scene drives the body
};

/// [piece] how far the vertex has come that came farthest, m, in all and of that since the run began, which
/// is when it had settled; and the largest speed of one, m/s.
struct PieceMotions {
  std::vector<double> moved, way, speed;
  std::vector<double> farthest;  ///< [piece] m, the way at any look so far
  double time;                   ///< s
};

enum class Course { rests, goes_on, failed, stopped };  ///< the last failed, too, and has come to rest

/// The pieces of a scene that can fail, followed by all their vertices from one geometry on.
class Pieces {
 public:
  explicit Pieces(const Simulation& settled);

  const std::vector<FollowedPiece>& all() const { return pieces_; }
  /// [vertex] m, to be given to motions() as the places where the run began.
  std::vector<Vec2> places(const Simulation& simulation) const;
  PieceMotions motions(const Simulation& simulation, const std::vector<Vec2>& began) const;

  /// How a piece fares between the middle and the end of a run: failed, where it came far or goes on and has
  /// come far enough to tell; one that slows down goes on, too, until it rests. Whether it goes on its way in
  /// the run tells; what it moved while it settled would hide that. Unless it is the `last` look at it, one
  /// that loses a hundredth of its speed is given more time. One that was farther before goes to and fro.
  Course course(std::size_t piece, const PieceMotions& middle, const PieceMotions& end, bool last) const;

  /// Bodies of which a piece moved so far that it has failed, wherever it stopped.
  std::vector<std::size_t> gone(const PieceMotions& motions) const;

  /// How many times as long a run would have to be to tell of a piece that goes on as if it always
  /// accelerated.
  double times_to_tell(std::size_t piece, const PieceMotions& end) const;

  /// s, after which the widest piece has come far enough to tell, from rest under a pull of this
  /// acceleration, m/s², against mass-proportional damping, 1/s.
  double time_to_tell(double acceleration, double damping) const;

 private:
  /// [vertex] of the parts of all bodies that can fail: its piece and where it was then.
  struct Vertex {
    std::size_t piece;
    Vec2 position;
  };
  std::vector<FollowedPiece> pieces_;
  std::vector<std::size_t> bodies_;
  std::vector<Vertex> vertices_;
};

}  // namespace talus
