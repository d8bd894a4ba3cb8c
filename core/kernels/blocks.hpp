#pragma once

#include "model/motion.hpp"

namespace talus::kernels {

// Loops over bodies that move as a whole, compiled for several instruction sets (see CMakeLists.txt beside).
// Each is that of IEEE 754 in a fixed order, so all give the same bits.

/// What a step reads of a body.
struct Block {
  double mass = 0;                                     ///< kg per metre; 0: not a body that moves as a whole
  double moment_xx = 0, moment_xy = 0, moment_yy = 0;  ///< ρJ, kg m; of a rigid body see inertia()
  double inverse_xx = 0, inverse_xy = 0, inverse_yy = 0;  ///< (ρJ)⁻¹
  std::uint32_t corner_begin = 0;
  std::uint32_t corner_count = 0;  ///< of a body that is one convex piece; else 0
  bool rigid = false;
  bool free = false;  ///< nothing of its motion is prescribed, and its strain is as heavy as it is

  /// kg m, of a rigid body, which has no other moment.
  double& inertia() { return moment_xx; }
  double inertia() const { return moment_xx; }
};

/// m/s, the velocity with which a corner is taken to go on. Any does, so half the digits do.
struct CornerDrift {
  float x, y;
};

struct SpeedExtremes {
  double squared = 0;                                   ///< m²/s², the largest
  double sum = 0;                                       ///< m²/s², no number if any is none
  double low_x = 0, high_x = 0, low_y = 0, high_y = 0;  ///< m/s
  double stray_squared = 0;                             ///< m²/s², the largest, off the drift of the corner
  bool any = false;

  void add(const SpeedExtremes& other);
};

/// The loads on one body; where they are not all there are, their sums go on from one time to the next.
struct BodyLoads {
  std::uint32_t body;
  std::uint32_t begin;  ///< in GatheredLoads::first, up to where the next body begins
  std::uint32_t sum;    ///< where its sums stand meanwhile, four of them at least
  std::uint32_t corner_begin;
  std::uint16_t corner_count;  ///< of a body that is one convex piece of not too many; else 0
  bool begun;                  ///< there were some before
  bool goes_on;                ///< there will be more
};

/// Loads of contacts, to be gathered by bodies.
struct GatheredLoads {
  const BodyLoads* bodies;     ///< and one behind them
  const std::uint32_t* first;  ///< body after body, of each pair the first load on a piece of the body; of
                               ///< zeros where the pair does not touch
  const CornerLoad* corner;    ///< one more may be read than there are
  CornerLoad* sum;             ///< see BodyLoads::sum
  const char* still;           ///< [body] whether to leave it as it is; null: none
};

/// How velocities are updated: v₊ = keep v₋ + gain (f/m + g); see StepConditions.
struct BlockUpdate {
  double keep, gain;
  double gravity_x, gravity_y;
  double share_of_after;  ///< in the velocity at t_n
  bool even_steps;        ///< the step behind is as long as the one ahead
  bool from_behind;       ///< of uneven ones: the kinetic energy is that of the step behind
  bool damped;
};

/// Σ p·M q over bodies, J/m, apart for translation x, y, rates xx, xy, yx, yy and spins.
struct VelocityProducts {
  double translation[2] = {0, 0}, strain[4] = {0, 0, 0, 0}, rotation = 0;

  double all() const {
    return (translation[0] + translation[1]) +
           (rotation + ((strain[0] + strain[1]) + (strain[2] + strain[3])));
  }
};

/// Sums over bodies, one after the other: however a chunk of them is divided into calls, and whether
/// velocities at t_n are kept, the bits are the same.
struct BlockSums {
  double kinetic = 0;              ///< J/m, of uneven steps
  double momentum[2] = {0, 0};     ///< kg/s, m v₋
  VelocityProducts across;         ///< v₋·M v₊ of even steps, twice the kinetic energy
  VelocityProducts behind, ahead;  ///< v·M v₋ and v·M v₊ with v = (v₋ + v₊)/2, where damped

  double all_kinetic() const { return kinetic + across.all() / 2; }
};

struct BlockKernels {
  /// Corners and sides of bodies [begin, end) that are one convex piece follow their motion (Eq. 11).
  /// `drift`: m/s, see ContactStage::drift().
  void (*follow)(const Block* blocks, const BodyMotion* motion, const CornerDrift* drift,
                 const double* reference_x, const double* reference_y, BoundaryCorner* corners,
                 std::size_t begin, std::size_t end, SpeedExtremes& speeds);
  /// d_{n+1} = d_n + Δt v₊ (Eq. 22).
  void (*move)(const Block* blocks, double dt, BodyMotion* motion, std::size_t begin, std::size_t end);
  /// Adds up the loads on those of [begin, end) that are one convex piece, contact after contact
  /// (Eqs. 46–48). Returns what adding all loads gives: no finite number if one of them is none.
  double (*add_loads)(const GatheredLoads& loads, const double* reference_x, const double* reference_y,
                      BodyForce* forces, std::size_t begin, std::size_t end);
  /// Eqs. 23–24 for the free bodies of [begin, end). `middle` gets the velocities at t_n, unless null.
  void (*accelerate)(const Block* blocks, const BodyForce* forces, const BlockUpdate& update,
                     BodyMotion* motion, BodyMotion* middle, std::size_t begin, std::size_t end,
                     BlockSums& sums);
};

}  // namespace talus::kernels
