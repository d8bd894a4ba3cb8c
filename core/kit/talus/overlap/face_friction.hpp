#pragma once

#include <talus/overlap/face_contact.hpp>
#include <talus/overlap/friction.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::overlap {

/// Friction of one contact (Eqs. 37–44), once springs and dashpots press. Tangential loads act on both bodies
/// at one common point of each cell, shared by μ_k N_k.
class FaceFriction {
 public:
  FaceFriction(FaceContact& contact, FrictionRule rule, const ContactBatch& batch, const BodyPair& pair)
      : contact_(contact), mapped_(rule == FrictionRule::return_mapping), batch_(batch), pair_(pair) {}

  /// Loads both bodies and books it. `history` becomes that of t_n. Returns the force on body b, N/m.
  Point act(const LoadSink& sink, double cluster_length, FrictionHistory& history, PairReport& report) {
    double load = 0, limit = 0, stiffness = 0, damping = 0;
    for (const Cell& cell : contact_.cells) {
      load += cell.pressed;
      limit += cell.interface.friction * cell.pressed;
      stiffness += cell.interface.tangential_stiffness * cell.pressed;
      damping += cell.interface.tangential_damping * cell.pressed;
    }
    const FrictionHistory old = history;
    place(history.slip != 0, limit);
    if (!(limit > 0) || contact_.length == 0) {
      report.slip_loss += old.stored - old.applied * contact_.slip_increment / 2;
      history = {0, 0, 0, contact_.length, history.x, history.y, 0, history.strips};
      return {0, 0};
    }
    if (mapped_) measure_slip_of_loads();
    const double slip_increment = contact_.slip_increment;
    const FrictionInput input{stiffness / load * contact_.length,
                              batch_.hold_stick ? std::numeric_limits<double>::infinity() : limit,
                              contact_.length, slip_increment};
    history = advance(mapped_ ? FrictionRule::return_mapping : FrictionRule::paper, old, input);
    report.stored += history.stored;
    // What a dashpot pushed with until it slips is lost in friction; while it sticks the host books that.
    const double before = mapped_ && history.slip == 0 ? old.elastic : old.applied;
    report.slip_loss += -(before + history.applied) * slip_increment / 2 - (history.stored - old.stored);

    double& force = history.applied;
    // Table 1 of the paper knows no dashpot, and with one its creep after a stop is another.
    if (damping > 0 && history.slip == 0 && mapped_) {
      const double viscosity =
          2 * damping / load *
          std::sqrt(input.stiffness * pair_.reduced_mass * contact_.length / cluster_length);
      force = std::clamp(force - viscosity * contact_.slip_velocity, -input.limit, input.limit);
      const double dashpot = force - history.elastic;
      report.damping_power += std::max(0.0, -dashpot * slip_increment);
      report.damping_force += static_cast<float>(std::abs(dashpot));
    }
    for (const Cell& cell : contact_.cells) {
      if (cell.shear != 0) load_cell(sink, cell, force * cell.shear);
    }
    return force * contact_.tangent;
  }

 private:
  /// While a contact slips, friction acts where spring and dashpot press together: at the foot of the spring
  /// alone it would feed the strain of a sliding block. While it sticks it owes nothing to the dashpot, and
  /// acts where the spring presses: at a foot that follows the rate of closing it would feed the strain of a
  /// block at rest.
  void place(bool slipped, double limit) {
    double sum = 0;
    for (const Cell& cell : contact_.cells) sum += cell.shear;
    const bool all = slipped || !(sum > 0);
    for (Cell& cell : contact_.cells) {
      cell.shear = all ? (limit > 0 ? cell.interface.friction * cell.pressed / limit : 0) : cell.shear / sum;
      if (all) cell.shear_at = cell.pressed_at;
    }
  }

  /// The slip that the tangential loads work through: of the bodies at the points where they act, by their
  /// shares. With the mean over the arcs (Eq. 38) a body that strains would gain or lose energy in friction.
  void measure_slip_of_loads() {
    double velocity = 0;
    for (const Cell& cell : contact_.cells) {
      const Piece& master = cell.overlap->piece[cell.master];
      const Piece& slave = cell.overlap->piece[1 - cell.master];
      double of_slave = 0;
      each_share(cell, [&](std::uint32_t side, double share) {
        of_slave += share * slave.velocity_inside(side, cell.shear_at, contact_.tangent);
      });
      const double of_master =
          dot(contact_.tangent, master.velocity_at(cell.side, master.lever(cell.side, cell.shear_at)));
      velocity += (cell.master == 0 ? cell.shear : -cell.shear) * (of_slave - of_master);
    }
    contact_.slip_velocity = velocity;
    contact_.slip_increment = velocity * batch_.dt;
  }

  void load_cell(const LoadSink& sink, const Cell& cell, double force_on_b) {
    contact_.all_on_b.add(cell.shear_at, force_on_b * contact_.tangent);
    const Piece& master = cell.overlap->piece[cell.master];
    const Piece& slave = cell.overlap->piece[1 - cell.master];
    const Point force = (cell.master == 0 ? force_on_b : -force_on_b) * contact_.tangent;
    sink.on_side(master, cell.side, master.lever(cell.side, cell.shear_at), -1.0 * force);
    each_share(cell, [&](std::uint32_t side, double share) {
      sink.inside(slave, side, cell.shear_at, share * force);
    });
  }

  /// Calls visit(side, share) for the sides of the slave that bear what acts in a cell, by the overlap below
  /// each.
  template <class Visit>
  void each_share(const Cell& cell, const Visit& visit) const {
    double total = 0;
    for (const Segment& segment : contact_.segments_of(cell)) total += segment.share();
    if (!(total > 0)) {
      visit(bounding_side(*cell.overlap, cell.overlap->piece[1 - cell.master]), 1.0);
      return;
    }
    for (const Segment& segment : contact_.segments_of(cell)) visit(segment.side, segment.share() / total);
  }

  FaceContact& contact_;
  bool mapped_;  ///< by the return mapping
  const ContactBatch& batch_;
  const BodyPair& pair_;
};

}  // namespace talus::overlap
