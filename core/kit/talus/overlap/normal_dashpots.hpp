#pragma once

#include <talus/overlap/face_contact.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace talus::overlap {

/// A dashpot along the normal of each overlap, never pulling: η per metre such that ηL is the ratio of
/// 2√(α_N L m). Along the normals of its sides instead it would brake a corner that slides. One object serves
/// one thread.
class NormalDashpots {
 public:
  /// L is `cluster_length`, m, of all faces that press together.
  void press(FaceContact& contact, const LoadSink& sink, const BodyPair& pair, double cluster_length,
             double dt, PairReport& report) {
    if (contact.length == 0) return;
    find(contact, pair, cluster_length);
    const Point normal_on_b = contact.normal();
    for (const Dashpot& dashpot : dashpots_) {
      Cell& cell = contact.cells[dashpot.cell];
      const Segment& segment = contact.springs.segments[dashpot.segment];
      const Piece& master = cell.overlap->piece[cell.master];
      const Piece& slave = cell.overlap->piece[1 - cell.master];
      const Point along = contact.normal_of_overlap(cell), at = segment.at[dashpot.end];
      const double force = may_push_[contact.overlap_of(cell)].share() * dashpot.force;
      sink.on_side(slave, segment.side, slave.lever(segment.side, at), force * along);
      sink.inside(master, cell.side, at, -force * along);
      contact.normal_on_b = contact.normal_on_b + on_b(cell, force * along);
      contact.all_on_b.add(at, on_b(cell, force * along));
      report.damping_power += force * dashpot.rate * dt;
      report.damping_force += static_cast<float>(std::abs(force));
      const double pressed = force * std::max(0.0, dot(along, on_slave(cell, normal_on_b)));
      cell.pressed += pressed;
      cell.pressed_on_end += pressed * master.lever(cell.side, at);
    }
    for (Cell& cell : contact.cells) {
      if (cell.interface.normal_damping == 0) continue;
      const Piece& master = cell.overlap->piece[cell.master];
      if (cell.pressed > 0) {
        cell.pressed_at =
            master.point_at(cell.side, std::clamp(cell.pressed_on_end / cell.pressed, 0.0, 1.0));
      }
      cell.pressed = std::max(0.0, cell.pressed);
    }
  }

 private:
  struct Dashpot {
    std::uint32_t cell, segment;
    int end;             ///< of the segment
    double force, rate;  ///< N/m; m/s, at which the bodies close in on each other there
  };
  /// Springs and dashpots of one overlap along its normal, N/m.
  struct MayPush {
    double spring = 0, dashpots = 0;
    double share() const { return spring + dashpots < 0 ? spring / -dashpots : 1; }
  };

  /// None pulls by more than its part of the springs pushes; where others of those push the other way, it is
  /// their sum that may not pull.
  void find(FaceContact& contact, const BodyPair& pair, double cluster_length) {
    dashpots_.clear();
    may_push_.assign(contact.springs.overlaps.size(), {});
    for (std::uint32_t c = 0; c < contact.cells.size(); ++c) {
      Cell& cell = contact.cells[c];
      if (cell.interface.normal_damping == 0) continue;
      const Piece& master = cell.overlap->piece[cell.master];
      const Piece& slave = cell.overlap->piece[1 - cell.master];
      cell.pressed_on_end = cell.pressed * master.lever(cell.side, cell.foot);
      const double share = cell.master == 0 ? pair.master_share() : 1 - pair.master_share();
      const double viscosity =
          share * 2 * cell.interface.normal_damping *
          std::sqrt(cell.interface.normal_stiffness * pair.reduced_mass / cluster_length);
      const Point along = contact.normal_of_overlap(cell);
      MayPush& may_push = may_push_[contact.overlap_of(cell)];
      may_push.spring = length(contact.springs.on_b[contact.overlap_of(cell)]);
      for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s) {
        const Segment& segment = contact.springs.segments[s];
        // A slave side that leans pushes along the normal with a part of its load only.
        const double facing = std::max(0.0, -dot(slave.normal(segment.side), along));
        double rate[2];
        for (int end = 0; end < 2; ++end) {
          const Point at = segment.at[end];
          rate[end] = master.velocity_inside(cell.side, at, along) -
                      dot(along, slave.velocity_at(segment.side, slave.lever(segment.side, at)));
        }
        for (int end = 0; end < 2; ++end) {
          const double viscous = viscosity * facing * segment.length * (2 * rate[end] + rate[1 - end]) / 6;
          const double force = std::max(viscous, -facing * segment.load[end]);
          may_push.dashpots += force;
          dashpots_.push_back({c, s, end, force, rate[end]});
        }
      }
    }
  }

  std::vector<Dashpot> dashpots_;  ///< of the contact at hand
  std::vector<MayPush> may_push_;  ///< [overlap]
};

}  // namespace talus::overlap
