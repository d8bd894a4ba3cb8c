#pragma once

#include "corner_contact.hpp"
#include "springs.hpp"

#include <talus/contact_model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::vertex_edge {

/// A vertex on a side in one step: how it moves there, what its springs and dashpots push with, and where
/// their work goes.
class ActingCorner {
 public:
  /// `spring`: the whole of it, of which the contact has its share.
  ActingCorner(const ContactBatch& batch, const BodyPair& pair, const PiecePairGeometry& geometry,
               const CornerContact& contact, const Interface& interface, const SpringParameters& spring)
      : contact_(contact),
        own_(geometry.piece[contact.vertex_body]),
        other_(geometry.piece[1 - contact.vertex_body]),
        interface_(interface),
        spring_(spring),
        held_(batch.hold_stick),
        dt_(batch.dt),
        carried_mass_(pair.reduced_mass / 2),
        normal_(other_.normal(contact.side)),
        along_(other_.tangent(contact.side)) {
    const Point relative = own_.velocity(contact.vertex) - other_.velocity_at(contact.side, contact.lever);
    closing_ = -dot(relative, normal_);
    // Friction acts at the vertex, as deep behind the side as it is, and slips as the side moves there.
    sliding_ = dot(own_.velocity(contact.vertex), along_) -
               other_.working_velocity(contact.side, own_.at(contact.vertex), along_);
    slip_ = sliding_ * dt_;
  }

  /// Finds the forces, takes its history to this step and books the work. False when its bond breaks in
  /// tension and nothing is left. `filled`: CornerContact::filled where that counts, else 1.
  bool act(SpringHistory& history, double filled, PairReport& report) {
    const SpringHistory old = history;
    history.viscous = 0;
    viscous_ = normal_dashpot();
    force_ = spring_force(spring_, contact_.depth, viscous_, old.carried(spring_.stretch), slip_, held_);
    if (force_.breaks) history.intact = 0;
    if (force_.normal <= 0 && history.intact == 0) {
      book_end(old, report);
      return false;
    }
    keep_springs(old, filled, history, report);
    report.damping_power += contact_.share * viscous_ * closing_ * dt_;
    report.damping_force += static_cast<float>(contact_.share * std::abs(viscous_));
    tangential_ = force_.tangential;
    if (!force_.slips && spring_.tangential > 0 && spring_.friction + spring_.cohesion > 0)
      damp_shear(history, report);
    return true;
  }

  /// Puts its forces on both bodies; returns what is seen of them.
  ContactReport push(const overlap::LoadSink& sink) const {
    const Point across = contact_.share * (force_.normal + viscous_) * normal_;
    const Point shear = contact_.share * tangential_ * along_;
    const Point at = own_.at(contact_.vertex);
    sink.at_corner(own_, contact_.vertex, across + shear);
    sink.at_point(other_, contact_.side, at, -1.0 * (across + shear));
    const double to_b = contact_.vertex_body == 1 ? 1 : -1;
    return {at.x,
            at.y,
            to_b * across.x,
            to_b * across.y,
            to_b * shear.x,
            to_b * shear.y,
            contact_.depth,
            force_.slips ? 1.0 : 0.0,
            0};
  }

 private:
  /// N/m. No dashpot pulls, but what a bond would bear as well. A flat contact stands on two such springs,
  /// and its ratio is meant of the two together.
  double normal_dashpot() const {
    const double push = 2 * interface_.normal_damping * std::sqrt(spring_.normal * carried_mass_) * closing_;
    if (held_ && spring_.tensile > 0) return push;
    return std::max(push, -std::max(0.0, spring_.normal * contact_.depth + spring_.tensile));
  }

  /// The force of the step before has worked through half of this one.
  void book_end(const SpringHistory& old, PairReport& report) const {
    const double pull =
        old.pulled > 0 ? contact_.share * spring_.normal * (contact_.depth - closing_ * dt_) : 0;
    report.slip_loss += (pull * closing_ * dt_ - (old.applied + old.viscous) * slip_) / 2;
  }

  void keep_springs(const SpringHistory& old, double filled, SpringHistory& history,
                    PairReport& report) const {
    const double normal = contact_.share * filled * force_.normal * contact_.depth / 2;
    history.elastic = force_.tangential;
    history.stretch = spring_.stretch;
    history.applied = contact_.share * force_.tangential;
    history.stored =
        spring_.tangential > 0 ? history.applied * force_.tangential / (2 * spring_.tangential) : 0;
    history.pulled = contact_.depth < 0 ? normal : 0;
    report.stored += normal + history.stored;
    report.slip_loss -= history.stored + old.pulled + (old.applied + history.applied) * slip_ / 2;
    // What a dashpot pushed with until it slips is lost in friction; while it sticks the host books that.
    if (force_.slips) report.slip_loss -= old.viscous * slip_ / 2;
    report.penetration = std::max(report.penetration, contact_.depth);
  }

  void damp_shear(SpringHistory& history, PairReport& report) {
    const double dashpot = 2 * interface_.tangential_damping * std::sqrt(spring_.tangential * carried_mass_);
    const double limit = held_ ? std::numeric_limits<double>::infinity()
                               : shear_strength(spring_, force_.normal + viscous_),
                 most = std::max(limit, std::abs(force_.tangential));
    tangential_ = std::clamp(force_.tangential - dashpot * sliding_, -most, most);
    const double added = tangential_ - force_.tangential;
    history.viscous = contact_.share * added;
    report.damping_power += contact_.share * std::max(0.0, -added * slip_);
    report.damping_force += static_cast<float>(contact_.share * std::abs(added));
  }

  const CornerContact& contact_;
  const Piece &own_, &other_;
  Interface interface_;
  SpringParameters spring_;
  bool held_;  ///< friction and bonds, without limit
  double dt_, carried_mass_;
  Point normal_, along_;                 ///< of the side
  double closing_, sliding_, slip_;      ///< m/s, m/s, m
  double viscous_ = 0, tangential_ = 0;  ///< N/m, of the whole spring: of the normal dashpot; along the side
  SpringForce force_{};
};

}  // namespace talus::vertex_edge
