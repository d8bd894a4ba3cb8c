#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/carried_history.hpp>
#include <talus/overlap/friction.hpp>
#include <talus/overlap/grouping.hpp>
#include <talus/overlap/lane_contact.hpp>
#include <talus/overlap/normal_loads.hpp>

#include <span>

namespace talus::overlap {

/// Contact by the overlap area (§3): pressure α_N g over the overlap, g the distance to the nearest side of
/// the master. `Law` says how an interface is read (`Law::interface(values)`), whether there is friction
/// (`Law::frictional`) and by which rule (`rule()`); it may have a pressure of its own (`pressure()`), which
/// takes the place of α_N g everywhere and keeps it from the lanes. One object serves one thread.
template <class Law>
class DistributedContact {
 public:
  /// Plain bodies go side by side through the lanes; the others, and what the lanes hand back, one by one. A
  /// plan of the batch, if there is one, is a LanePlan.
  void evaluate(const Law& law, const ContactBatch& batch, const ContactLoads& loads) {
    if constexpr (HasOwnPressure<Law>) {
      evaluate_one_by_one(law, batch, loads);
    } else {
      evaluate_in_lanes(law, batch, loads);
    }
  }

  /// The same one by one, whatever the bodies are.
  void evaluate_one_by_one(const Law& law, const ContactBatch& batch, const ContactLoads& loads) {
    for (std::uint32_t k = 0; k < batch.active_count; ++k)
      evaluate_pair(law, batch, loads, batch.pairs[batch.active[k]], loads.pairs[batch.active[k]]);
  }

 private:
  void evaluate_in_lanes(const Law& law, const ContactBatch& batch, const ContactLoads& loads) {
    const auto one_by_one = [&](std::uint32_t i) {
      evaluate_pair(law, batch, loads, batch.pairs[i], loads.pairs[i]);
    };
    LanePlan* plan = nullptr;
    std::span<const std::uint32_t> loose{batch.active, batch.active_count};
    // Without friction nobody remembers which side faces the other body, so lanes cannot last.
    if constexpr (Law::frictional) plan = static_cast<LanePlan*>(batch.plan);
    if (plan != nullptr) {
      plan->list_loose(batch, loose_);
      loose = loose_;
    }
    quadrilaterals_.clear(batch.active_count);
    octagons_.clear(batch.active_count);
    const bool fit = fits_lanes(law);
    for (const std::uint32_t i : loose) {
      const BodyPair& pair = batch.pairs[i];
      // Of bodies that are not plain this is larger than any number of corners.
      const std::uint32_t last_corner = (pair.plain_corners[0] - 1U) | (pair.plain_corners[1] - 1U);
      if (last_corner >= 8 || pair.contact_count > 1 || !fit) {
        one_by_one(i);
      } else if (last_corner < 4) {
        quadrilaterals_.add(batch, i);
      } else {
        octagons_.add(batch, i);
      }
    }
    quadrilaterals_.evaluate(law, batch, loads, plan, one_by_one);
    octagons_.evaluate(law, batch, loads, plan, one_by_one);
  }

  static bool fits_lanes(const Law& law) {
    if constexpr (Law::frictional) return law.rule() == FrictionRule::return_mapping;
    return true;
  }

  void evaluate_pair(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                     const BodyPair& pair, PairReport& report) {
    const std::uint32_t overlaps = finder_.find(batch, pair);
    const std::uint32_t groups = finder_.group();
    report = {};
    report.contact_count = groups;
    if constexpr (Law::frictional) carried_.carry(finder_, batch, pair, report);
    if (overlaps == 0) return;

    const LoadSink sink{loads.corner};
    sink.clear(batch, pair);
    normal_.start(finder_.overlaps());
    for (std::uint32_t c = 0; c < finder_.clusters(); ++c) {
      normal_.press(law, batch.interfaces, sink, finder_, c, pair, report);
      const std::uint32_t first_group = finder_.first_group(c), end = finder_.first_group(c + 1);
      several_faces_ = end - first_group > 1;
      if (several_faces_) measure_cluster(first_group, end, batch.dt);
      for (std::uint32_t g = first_group; g < end; ++g) {
        take_cells(g);
        evaluate_contact(law, batch, loads, sink, pair, g, report);
      }
    }
    const Balance beside = normal_.finish(sink);
    if (pair.slot_capacity > 0 && loads.reports != nullptr) add_to(loads.reports[pair.slot_start], beside);
  }

  static void add_to(ContactReport& report, const Balance& beside) {
    report.px += beside.force.x;
    report.py += beside.force.y;
    report.moment += beside.moment_about({report.x, report.y});
  }

  /// Of what a cluster presses, that of one group, with its dashpots and friction.
  void evaluate_contact(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                        const LoadSink& sink, const BodyPair& pair, std::uint32_t group, PairReport& report) {
    if (cells_.empty()) {
      write_nothing(loads, pair, group, report);
      return;
    }
    find_tangent(group);
    measure_arcs(group, batch.dt);
    if (!several_faces_) cluster_length_ = contact_length_;
    normal_damping(sink, pair, batch.dt, report);
    share_pressure();
    Point tangential{0, 0};
    double slip = 0;
    if constexpr (Law::frictional) {
      FrictionHistory& history = carried_[group];
      tangential = friction(law, batch, sink, pair, history, report);
      slip = history.slip;
      if (group < pair.slot_capacity)
        write_history(history, loads.history + (pair.slot_start + group) * friction_doubles);
    }
    double penetration = 0;
    for (const Cell& cell : cells_) penetration = std::max(penetration, cell.depth);
    report.penetration = std::max(report.penetration, penetration);
    if (group < pair.slot_capacity && loads.reports != nullptr)
      loads.reports[pair.slot_start + group] = contact_report(tangential, slip, penetration);
  }

  void take_cells(std::uint32_t group) {
    if (!several_faces_) {
      cells_.swap(normal_.cells);
      return;
    }
    cells_.clear();
    for (const Cell& cell : normal_.cells) {
      if (cell.overlap->group == group) cells_.push_back(cell);
    }
  }

  /// The faces of a cluster have dashpots as one contact of all their length has, however often they bend.
  void measure_cluster(std::uint32_t first_group, std::uint32_t end, double dt) {
    cluster_length_ = 0;
    for (std::uint32_t g = first_group; g < end; ++g) {
      take_cells(g);
      if (cells_.empty()) continue;
      find_tangent(g);
      measure_arcs(g, dt);
      cluster_length_ += contact_length_;
    }
  }

  /// An overlap of which rounding leaves no side a cell: nothing presses, and what was stored is lost.
  void write_nothing(const ContactLoads& loads, const BodyPair& pair, std::uint32_t group,
                     PairReport& report) {
    if (group >= pair.slot_capacity) return;
    const std::uint32_t slot = pair.slot_start + group;
    if constexpr (Law::frictional) {
      FrictionHistory none{};
      none.strips = carried_[group].strips;
      none.x = carried_[group].x, none.y = carried_[group].y;
      report.slip_loss += carried_[group].stored;
      write_history(none, loads.history + slot * friction_doubles);
    }
    if (loads.reports == nullptr) return;
    const Point centre = finder_.centre(group);
    loads.reports[slot] = {centre.x, centre.y, 0, 0, 0, 0, 0, 0, 0};
  }

  /// §3.2.2: n_c is the direction of the resultant, s_c is perpendicular to it. A cell presses along n_c with
  /// a part of its load only: what presses a corner from both its sides adds no friction to it.
  void find_tangent(std::uint32_t group) {
    normal_on_b_ = {0, 0};
    for (const std::uint32_t member : finder_.members(group))
      normal_on_b_ = normal_on_b_ + normal_.on_b[member];
    const double size = length(normal_on_b_);
    const Point normal = size > 0 ? (1 / size) * normal_on_b_ : cells_[0].normal;
    tangent_ = {-normal.y, normal.x};
    on_b_ = {};
    for (Cell& cell : cells_) {
      on_b_.add(cell.foot, on_b(cell, cell.load * cell.normal));
      cell.pressed = std::max(0.0, dot(on_slave(cell, normal), cell.normal)) * cell.load;
      cell.pressed_at = cell.foot;
      cell.shear = cell.interface.friction * cell.pressed;
      cell.shear_at = cell.foot;
    }
  }

  Point normal_of_contact() const { return {tangent_.y, -tangent_.x}; }  ///< on body b

  /// What acts on body b as it acts on the slave of a cell, and the other way round.
  static Point on_slave(const Cell& cell, Point on_b) { return cell.master == 0 ? on_b : -1.0 * on_b; }
  static Point on_b(const Cell& cell, Point on_slave) {
    return cell.master == 0 ? on_slave : -1.0 * on_slave;
  }

  /// Eq. 38 with dl projected on s_c, so that both arcs, which share their ends, have one length and a pair
  /// carried along together does not slip. Where strips end within an overlap, or a face in a reflex corner,
  /// the arcs do not share their ends; the mean is the same whichever body comes first, and adds up to the
  /// whole along a boundary.
  void measure_arcs(std::uint32_t group, double dt) {
    double projected[2] = {0, 0}, moved[2] = {0, 0}, arc = 0;
    for (const std::uint32_t member : finder_.members(group)) {
      const Overlap& overlap = finder_.overlaps()[member];
      const Polygon& polygon = overlap.polygon;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const SideLabel label = polygon[i].side;
        const Piece& piece = overlap.piece[label.body];
        if (!piece.real(label.index)) continue;
        const Point start = polygon[i].at, end = polygon[i + 1 == polygon.size() ? 0 : i + 1].at;
        const double along = dot(end - start, tangent_);
        const Point velocity_sum = piece.velocity_at(label.index, piece.lever(label.index, start)) +
                                   piece.velocity_at(label.index, piece.lever(label.index, end));
        projected[label.body] += along;
        moved[label.body] += along * dot(velocity_sum, tangent_) / 2;
        arc += length(end - start);
      }
    }
    const double mean = std::abs(projected[0] / 2 - projected[1] / 2);
    contact_length_ = normal_.among_strips() || several_faces_ ? mean : std::abs(projected[1]);
    const bool measurable =
        std::min({std::abs(projected[0]), std::abs(projected[1]), contact_length_}) > 1e-9 * arc;
    slip_velocity_ = measurable ? moved[1] / projected[1] - moved[0] / projected[0] : 0;
    slip_increment_ = slip_velocity_ * dt;
    if (!measurable) contact_length_ = 0;
  }

  /// A dashpot along the normal of each overlap, never pulling: η per metre such that ηL is the ratio of
  /// 2√(α_N L m). Along the normals of its sides instead it would brake a corner that slides.
  void normal_damping(const LoadSink& sink, const BodyPair& pair, double dt, PairReport& report) {
    if (contact_length_ == 0) return;
    find_dashpots(pair);
    const Point normal_on_b = normal_of_contact();
    for (const Dashpot& dashpot : dashpots_) {
      Cell& cell = cells_[dashpot.cell];
      const Segment& segment = normal_.segments[dashpot.segment];
      const Piece& master = cell.overlap->piece[cell.master];
      const Piece& slave = cell.overlap->piece[1 - cell.master];
      const Point along = normal_of_overlap(cell), at = segment.at[dashpot.end];
      const double force = may_push_[index_of(cell)].share() * dashpot.force;
      sink.on_side(slave, segment.side, slave.lever(segment.side, at), force * along);
      sink.inside(master, cell.side, at, -force * along);
      normal_on_b_ = normal_on_b_ + on_b(cell, force * along);
      on_b_.add(at, on_b(cell, force * along));
      report.damping_power += force * dashpot.rate * dt;
      report.damping_force += static_cast<float>(std::abs(force));
      const double pressed = force * std::max(0.0, dot(along, on_slave(cell, normal_on_b)));
      cell.pressed += pressed;
      cell.pressed_on_end += pressed * master.lever(cell.side, at);
    }
    for (Cell& cell : cells_) {
      if (cell.interface.normal_damping == 0) continue;
      const Piece& master = cell.overlap->piece[cell.master];
      if (cell.pressed > 0) {
        cell.pressed_at =
            master.point_at(cell.side, std::clamp(cell.pressed_on_end / cell.pressed, 0.0, 1.0));
      }
      cell.pressed = std::max(0.0, cell.pressed);
    }
  }

  /// None pulls by more than its part of the springs pushes; where others of those push the other way, it is
  /// their sum that may not pull.
  void find_dashpots(const BodyPair& pair) {
    dashpots_.clear();
    may_push_.assign(finder_.overlaps().size(), {});
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
      Cell& cell = cells_[c];
      if (cell.interface.normal_damping == 0) continue;
      const Piece& master = cell.overlap->piece[cell.master];
      const Piece& slave = cell.overlap->piece[1 - cell.master];
      cell.pressed_on_end = cell.pressed * master.lever(cell.side, cell.foot);
      const double share = cell.master == 0 ? pair.master_share() : 1 - pair.master_share();
      const double viscosity =
          share * 2 * cell.interface.normal_damping *
          std::sqrt(cell.interface.normal_stiffness * pair.reduced_mass / cluster_length_);
      const Point along = normal_of_overlap(cell);
      MayPush& may_push = may_push_[index_of(cell)];
      may_push.spring = length(normal_.on_b[index_of(cell)]);
      for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s) {
        const Segment& segment = normal_.segments[s];
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

  /// By their sum the cells press no more than springs and dashpots do together: single ones that come out
  /// negative count nothing.
  void share_pressure() {
    double sum = 0;
    for (const Cell& cell : cells_) sum += cell.pressed;
    const double pressed = std::max(0.0, dot(normal_on_b_, normal_of_contact()));
    for (Cell& cell : cells_) cell.pressed *= sum > 0 ? pressed / sum : 0;
  }

  std::size_t index_of(const Cell& cell) const {
    return static_cast<std::size_t>(cell.overlap - finder_.overlaps().data());
  }

  /// The direction in which the springs of an overlap push the slave.
  Point normal_of_overlap(const Cell& cell) const {
    const Point on_b = normal_.on_b[index_of(cell)];
    const double size = length(on_b);
    return size > 0 ? on_slave(cell, (1 / size) * on_b) : cell.normal;
  }

  /// Eqs. 37–44. Tangential loads act on both bodies at one common point of each cell, shared by μ_k N_k.
  Point friction(const Law& law, const ContactBatch& batch, const LoadSink& sink, const BodyPair& pair,
                 FrictionHistory& history, PairReport& report) {
    double load = 0, limit = 0, stiffness = 0, damping = 0;
    for (const Cell& cell : cells_) {
      load += cell.pressed;
      limit += cell.interface.friction * cell.pressed;
      stiffness += cell.interface.tangential_stiffness * cell.pressed;
      damping += cell.interface.tangential_damping * cell.pressed;
    }
    const FrictionHistory old = history;
    place_friction(history.slip != 0, limit);
    if (!(limit > 0) || contact_length_ == 0) {
      report.slip_loss += old.stored - old.applied * slip_increment_ / 2;
      history = {0, 0, 0, contact_length_, history.x, history.y, 0, history.strips};
      return {0, 0};
    }
    if (law.rule() == FrictionRule::return_mapping) measure_slip_of_loads(batch.dt);
    const FrictionInput input{stiffness / load * contact_length_,
                              batch.hold_stick ? std::numeric_limits<double>::infinity() : limit,
                              contact_length_, slip_increment_};
    const bool mapped = law.rule() == FrictionRule::return_mapping;
    history = advance(law.rule(), old, input);
    report.stored += history.stored;
    // What a dashpot pushed with until it slips is lost in friction; while it sticks the host books that.
    const double before = mapped && history.slip == 0 ? old.elastic : old.applied;
    report.slip_loss += -(before + history.applied) * slip_increment_ / 2 - (history.stored - old.stored);

    double& force = history.applied;
    // Table 1 of the paper knows no dashpot, and with one its creep after a stop is another.
    if (damping > 0 && history.slip == 0 && mapped) {
      const double viscosity =
          2 * damping / load *
          std::sqrt(input.stiffness * pair.reduced_mass * contact_length_ / cluster_length_);
      force = std::clamp(force - viscosity * slip_velocity_, -input.limit, input.limit);
      const double dashpot = force - history.elastic;
      report.damping_power += std::max(0.0, -dashpot * slip_increment_);
      report.damping_force += static_cast<float>(std::abs(dashpot));
    }
    for (const Cell& cell : cells_) {
      if (cell.shear != 0) tangential_loads(sink, cell, force * cell.shear);
    }
    return force * tangent_;
  }

  /// While a contact slips, friction acts where spring and dashpot press together: at the foot of the spring
  /// alone it would feed the strain of a sliding block. While it sticks it owes nothing to the dashpot, and
  /// acts where the spring presses: at a foot that follows the rate of closing it would feed the strain of a
  /// block at rest.
  void place_friction(bool slipped, double limit) {
    double sum = 0;
    for (const Cell& cell : cells_) sum += cell.shear;
    const bool all = slipped || !(sum > 0);
    for (Cell& cell : cells_) {
      cell.shear = all ? (limit > 0 ? cell.interface.friction * cell.pressed / limit : 0) : cell.shear / sum;
      if (all) cell.shear_at = cell.pressed_at;
    }
  }

  /// The slip that the tangential loads work through: of the bodies at the points where they act, by their
  /// shares. With the mean over the arcs (Eq. 38) a body that strains would gain or lose energy in friction.
  void measure_slip_of_loads(double dt) {
    double velocity = 0;
    for (const Cell& cell : cells_) {
      const Piece& master = cell.overlap->piece[cell.master];
      const Piece& slave = cell.overlap->piece[1 - cell.master];
      double total = 0, on_slave = 0;
      for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s)
        total += normal_.segments[s].share();
      for (std::uint32_t s = cell.segment_start; total > 0 && s < cell.segment_end; ++s) {
        on_slave += normal_.segments[s].share() / total *
                    slave.velocity_inside(normal_.segments[s].side, cell.shear_at, tangent_);
      }
      if (!(total > 0))
        on_slave = slave.velocity_inside(bounding_side(*cell.overlap, slave), cell.shear_at, tangent_);
      const double on_master =
          dot(tangent_, master.velocity_at(cell.side, master.lever(cell.side, cell.shear_at)));
      velocity += (cell.master == 0 ? cell.shear : -cell.shear) * (on_slave - on_master);
    }
    slip_velocity_ = velocity;
    slip_increment_ = velocity * dt;
  }

  void tangential_loads(const LoadSink& sink, const Cell& cell, double force_on_b) {
    on_b_.add(cell.shear_at, force_on_b * tangent_);
    const Piece& master = cell.overlap->piece[cell.master];
    const Piece& slave = cell.overlap->piece[1 - cell.master];
    const Point on_slave = (cell.master == 0 ? force_on_b : -force_on_b) * tangent_;
    sink.on_side(master, cell.side, master.lever(cell.side, cell.shear_at), -1.0 * on_slave);
    double total = 0;
    for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s)
      total += normal_.segments[s].share();
    if (!(total > 0)) {
      sink.inside(slave, bounding_side(*cell.overlap, slave), cell.shear_at, on_slave);
      return;
    }
    for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s) {
      sink.inside(slave, normal_.segments[s].side, cell.shear_at,
                  (normal_.segments[s].share() / total) * on_slave);
    }
  }

  /// The feet of all cells by their loads.
  Point foot_of_all() const {
    double load = 0;
    Point moment{0, 0};
    for (const Cell& cell : cells_) {
      load += cell.pressed;
      moment = moment + cell.pressed * cell.pressed_at;
    }
    return load > 0 ? (1 / load) * moment : cells_[0].foot;
  }

  ContactReport contact_report(Point tangential, double slip, double penetration) const {
    // Where dashpots take all of the pressure away rounding must not make it pull.
    const Point at = foot_of_all(),
                normal = dot(normal_on_b_, normal_of_contact()) > 0 ? normal_on_b_ : Point{0, 0};
    return {at.x,
            at.y,
            normal.x,
            normal.y,
            tangential.x,
            tangential.y,
            penetration,
            slip != 0 ? 1.0 : 0.0,
            on_b_.moment_about(at)};
  }

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

  std::vector<std::uint32_t> loose_;  ///< pairs that have no lane in a plan
  LaneContact<Law, 4> quadrilaterals_;
  LaneContact<Law, 8> octagons_;
  OverlapGroups finder_;
  NormalLoads<Law> normal_;
  std::vector<Cell> cells_;        ///< of the contact at hand
  std::vector<Dashpot> dashpots_;  ///< of the contact at hand
  std::vector<MayPush> may_push_;  ///< [overlap]
  CarriedHistory carried_;
  bool several_faces_ = false;  ///< whether the cluster at hand has more groups than one
  Point normal_on_b_{0, 0};     ///< N/m, the same of a contact, and then with what dashpots push
  Balance on_b_;                ///< all that acts on body b in the contact
  Point tangent_{0, 0};
  double contact_length_ = 0, cluster_length_ = 0, slip_velocity_ = 0, slip_increment_ = 0;
};

}  // namespace talus::overlap
