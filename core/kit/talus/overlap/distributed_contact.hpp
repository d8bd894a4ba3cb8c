#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/carried_history.hpp>
#include <talus/overlap/cell_loads.hpp>
#include <talus/overlap/cells.hpp>
#include <talus/overlap/friction.hpp>
#include <talus/overlap/grouping.hpp>
#include <talus/overlap/lane_contact.hpp>
#include <talus/overlap/pressure.hpp>

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
    pressing_.assign(overlaps, {0, 0});
    const std::uint32_t groups = finder_.group();
    report = {};
    report.contact_count = groups;
    if constexpr (Law::frictional) carried_.carry(finder_, batch, pair, report);
    if (overlaps == 0) return;

    const LoadSink sink{loads.corner};
    sink.clear(batch, pair);
    const Overlap& first = finder_.overlaps()[0];
    among_strips_ = first.piece[0].is_strip() || first.piece[1].is_strip();
    balance_ = {};
    last_resort_ = {};
    for (std::uint32_t g = 0; g < groups; ++g) {
      cells_.clear();
      segments_.clear();
      normal_on_b_ = {0, 0};
      penetration_ = 0;
      for (std::uint32_t master = 0; master < 2; ++master) {
        const double share = master == 0 ? pair.master_share() : 1 - pair.master_share();
        if (share > 0) normal_loads(law, batch.interfaces, sink, g, master, share, report);
      }
      report.penetration = std::max(report.penetration, penetration_);
      if (cells_.empty()) {
        write_nothing(loads, pair, g, report);
        continue;
      }
      find_tangent();
      measure_arcs(g, batch.dt);
      normal_damping(sink, pair, batch.dt, report);
      share_pressure();
      Point tangential{0, 0};
      double slip = 0;
      if constexpr (Law::frictional) {
        FrictionHistory& history = carried_[g];
        tangential = friction(law, batch, sink, pair, history, report);
        slip = history.slip;
        if (g < pair.slot_capacity)
          write_history(history, loads.history + (pair.slot_start + g) * friction_doubles);
      }
      if (g < pair.slot_capacity && loads.reports != nullptr)
        loads.reports[pair.slot_start + g] = contact_report(tangential, slip);
    }
    if (among_strips_ && last_resort_.load > 0) close_balance(sink, last_resort_);
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
    loads.reports[slot] = {centre.x, centre.y, 0, 0, 0, 0, 0, 0};
  }

  /// Eqs. 28–36: the load on a master side is α_N times the area of its cell, through the centroid; on the
  /// slave the trapezoid rule on the sub-segments. Energy is Π = ∫ α_N g dA.
  void normal_loads(const Law& law, const Interfaces& interfaces, const LoadSink& sink, std::uint32_t group,
                    std::uint32_t master_body, double share, PairReport& report) {
    const std::size_t first_cell = cells_.size();
    if (!among_strips_) balance_ = {};
    bool uniform = !HasOwnPressure<Law>;
    std::uint32_t members = 0;
    for (const std::uint32_t member : finder_.members(group)) {
      const Overlap& overlap = finder_.overlaps()[member];
      ++members;
      const Piece& master = overlap.piece[master_body];
      const Piece& slave = overlap.piece[1 - master_body];
      divider_.divide(master, overlap.polygon, [&](std::uint32_t side, const Polygon& cell) {
        const AreaCentroid region = &cell == &overlap.polygon ? overlap.region : area_centroid(cell);
        if (!(region.area > 0)) return;
        const auto first_segment = static_cast<std::uint32_t>(segments_.size());
        find_segments(master, slave, side, 1 - master_body, cell);
        InterfaceParameters parameters = interface_of(law, interfaces, overlap, master, slave, side,
                                                      std::span(segments_).subspan(first_segment));
        const Point normal = master.normal(side);
        double load = 0;
        Point foot{0, 0};
        if constexpr (HasOwnPressure<Law>) {
          const CellPressure in_cell = integrate(law, parameters, master, side, cell);
          load = share * in_cell.load;
          report.stored += share * in_cell.energy;
          foot = in_cell.centre + master.depth(side, in_cell.centre) * normal;
        } else {
          load = share * parameters.normal_stiffness * region.area;
          const double depth = master.depth(side, region.centroid);
          report.stored += load * depth;
          foot = region.centroid + depth * normal;
        }
        const Point on_b = (master_body == 0 ? load : -load) * normal;
        normal_on_b_ = normal_on_b_ + on_b;
        pressing_[member] = pressing_[member] + on_b;
        sink.on_side(master, side, master.lever(side, foot), -load * normal);
        balance_.add(foot, -load * normal);
        for (std::size_t s = first_segment; s < segments_.size(); ++s) {
          find_slave_loads(law, parameters, share, segments_[s]);
          load_slave(sink, slave, segments_[s]);
        }
        // What a dashpot is measured by: the mean slope of the pressure.
        if constexpr (HasOwnPressure<Law>) parameters.normal_stiffness = load / (share * region.area);
        if (cells_.size() > first_cell) {
          uniform = uniform && cells_[first_cell].interface.normal_stiffness == parameters.normal_stiffness;
        }
        cells_.push_back({&overlap, master_body, side, normal, foot, load, parameters, first_segment,
                          static_cast<std::uint32_t>(segments_.size())});
      });
    }
    if (among_strips_) {
      // A strip ends at division lines of its own, where its neighbour takes over: only all strips together
      // are in balance.
      for (std::size_t c = first_cell; c < cells_.size(); ++c) {
        const Cell& cell = cells_[c];
        if (!(cell.load > last_resort_.load)) continue;
        last_resort_ = {cell.overlap->piece[cell.master], cell.side, cell.foot, cell.load};
      }
    } else if ((members > 1 || !uniform) && cells_.size() > first_cell) {
      close_balance(sink, largest_cell(first_cell));
    }
  }

  void find_segments(const Piece& master, const Piece& slave, std::uint32_t side, std::uint32_t slave_body,
                     const Polygon& cell) {
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Point end = cell[i + 1 == cell.size() ? 0 : i + 1].at;
      penetration_ = std::max(penetration_, master.depth(side, cell[i].at));
      if (cell[i].side.body != slave_body || !slave.real(cell[i].side.index)) continue;
      Segment segment{};
      segment.side = cell[i].side.index;
      segment.at[0] = cell[i].at;
      segment.at[1] = end;
      segment.depth[0] = std::max(0.0, master.depth(side, cell[i].at));
      segment.depth[1] = std::max(0.0, master.depth(side, end));
      segment.length = length(end - cell[i].at);
      segment.facing = std::max(0.0, -dot(slave.normal(segment.side), master.normal(side)));
      segments_.push_back(segment);
    }
  }

  void load_slave(const LoadSink& sink, const Piece& slave, const Segment& segment) {
    const Point inward = -1.0 * slave.normal(segment.side);
    for (int end = 0; end < 2; ++end) {
      const Point force = segment.load[end] * inward;
      sink.on_side(slave, segment.side, slave.lever(segment.side, segment.at[end]), force);
      balance_.add(segment.at[end], force);
    }
  }

  /// A master side and the foot of its load.
  struct LoadedSide {
    Piece master;
    std::uint32_t side = 0;
    Point foot{0, 0};
    double load = 0;
  };

  LoadedSide largest_cell(std::size_t first_cell) const {
    const Cell* largest = &cells_[first_cell];
    for (std::size_t c = first_cell; c < cells_.size(); ++c) {
      if (cells_[c].load > largest->load) largest = &cells_[c];
    }
    return {largest->overlap->piece[largest->master], largest->side, largest->foot, largest->load};
  }

  /// Where the stiffness changes within one overlap, or a deep overlap reaches past the cut of a concave
  /// master, the pressure jumps along a division line and Eqs. 33–34 leave a remainder; the master takes it.
  void close_balance(const LoadSink& sink, const LoadedSide& at) const {
    sink.on_side(at.master, at.side, at.master.lever(at.side, at.foot), -1.0 * balance_.force);
    sink.couple(at.master, at.side, -balance_.moment_about(at.foot));
  }

  /// §3.2.2: n_c is the direction of the resultant, s_c is perpendicular to it. A cell presses along n_c with
  /// a part of its load only: what presses a corner from both its sides adds no friction to it.
  void find_tangent() {
    const double size = length(normal_on_b_);
    const Point normal = size > 0 ? (1 / size) * normal_on_b_ : cells_[0].normal;
    tangent_ = {-normal.y, normal.x};
    for (Cell& cell : cells_) {
      cell.pressed = std::max(0.0, dot(on_slave(cell, normal), cell.normal)) * cell.load;
      cell.pressed_at = cell.foot;
      cell.shear = cell.interface.friction * cell.pressed;
      cell.shear_at = cell.foot;
    }
  }

  Point normal_of_contact() const { return {tangent_.y, -tangent_.x}; }  ///< on body b

  /// What acts on body b as it acts on the slave of a cell.
  static Point on_slave(const Cell& cell, Point on_b) { return cell.master == 0 ? on_b : -1.0 * on_b; }

  /// Eq. 38 with dl projected on s_c, so that both arcs, which share their ends, have one length and a pair
  /// carried along together does not slip. Where strips end within an overlap the arcs do not share their
  /// ends; the mean is the same whichever body comes first, and adds up to the whole along a boundary.
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
    contact_length_ = among_strips_ ? mean : std::abs(projected[1]);
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
    const Point normal_on_b = normal_of_contact();
    for (Cell& cell : cells_) {
      if (cell.interface.normal_damping == 0) continue;
      const double share = cell.master == 0 ? pair.master_share() : 1 - pair.master_share();
      const double viscosity =
          share * 2 * cell.interface.normal_damping *
          std::sqrt(cell.interface.normal_stiffness * pair.reduced_mass / contact_length_);
      const Piece& master = cell.overlap->piece[cell.master];
      const Piece& slave = cell.overlap->piece[1 - cell.master];
      const Point along = normal_of_overlap(cell);
      const double along_contact = std::max(0.0, dot(along, on_slave(cell, normal_on_b)));
      double pressed = cell.pressed, on_end = pressed * master.lever(cell.side, cell.foot);
      for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s) {
        const Segment& segment = segments_[s];
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
          const Point at = segment.at[end];
          sink.on_side(slave, segment.side, slave.lever(segment.side, at), force * along);
          sink.inside(master, cell.side, at, -force * along);
          normal_on_b_ = normal_on_b_ + on_slave(cell, force * along);
          report.damping_power += force * rate[end] * dt;
          report.damping_force += static_cast<float>(std::abs(force));
          pressed += force * along_contact;
          on_end += force * along_contact * master.lever(cell.side, at);
        }
      }
      cell.pressed = std::max(0.0, pressed);
      if (pressed > 0) cell.pressed_at = master.point_at(cell.side, std::clamp(on_end / pressed, 0.0, 1.0));
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

  /// The direction in which the springs of an overlap push the slave.
  Point normal_of_overlap(const Cell& cell) const {
    const Point on_b = pressing_[static_cast<std::size_t>(cell.overlap - finder_.overlaps().data())];
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
    const double old_stored = history.stored, old_applied = history.applied;
    place_friction(history.slip != 0, limit);
    if (!(limit > 0) || contact_length_ == 0) {
      report.slip_loss += old_stored - old_applied * slip_increment_ / 2;
      history = {0, 0, 0, contact_length_, history.x, history.y, 0, history.strips};
      return {0, 0};
    }
    if (law.rule() == FrictionRule::return_mapping) measure_slip_of_loads(batch.dt);
    const FrictionInput input{stiffness / load * contact_length_,
                              batch.hold_stick ? std::numeric_limits<double>::infinity() : limit,
                              contact_length_, slip_increment_};
    history = advance(law.rule(), history, input);
    report.stored += history.stored;
    report.slip_loss +=
        -(old_applied + history.applied) * slip_increment_ / 2 - (history.stored - old_stored);

    double force = history.applied;
    // Table 1 of the paper knows no dashpot, and with one its creep after a stop is another.
    if (damping > 0 && history.slip == 0 && law.rule() == FrictionRule::return_mapping) {
      const double viscosity = 2 * damping / load * std::sqrt(input.stiffness * pair.reduced_mass);
      force = std::clamp(force - viscosity * slip_velocity_, -input.limit, input.limit);
      const double dashpot = force - history.applied;
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
      for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s) total += segments_[s].share();
      for (std::uint32_t s = cell.segment_start; total > 0 && s < cell.segment_end; ++s) {
        on_slave +=
            segments_[s].share() / total * slave.velocity_inside(segments_[s].side, cell.shear_at, tangent_);
      }
      if (!(total > 0))
        on_slave = slave.velocity_inside(any_real_side(*cell.overlap, slave), cell.shear_at, tangent_);
      const double on_master =
          dot(tangent_, master.velocity_at(cell.side, master.lever(cell.side, cell.shear_at)));
      velocity += (cell.master == 0 ? cell.shear : -cell.shear) * (on_slave - on_master);
    }
    slip_velocity_ = velocity;
    slip_increment_ = velocity * dt;
  }

  void tangential_loads(const LoadSink& sink, const Cell& cell, double force_on_b) const {
    const Piece& master = cell.overlap->piece[cell.master];
    const Piece& slave = cell.overlap->piece[1 - cell.master];
    const Point on_slave = (cell.master == 0 ? force_on_b : -force_on_b) * tangent_;
    sink.on_side(master, cell.side, master.lever(cell.side, cell.shear_at), -1.0 * on_slave);
    double total = 0;
    for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s) total += segments_[s].share();
    if (!(total > 0)) {
      sink.inside(slave, any_real_side(*cell.overlap, slave), cell.shear_at, on_slave);
      return;
    }
    for (std::uint32_t s = cell.segment_start; s < cell.segment_end; ++s) {
      sink.inside(slave, segments_[s].side, cell.shear_at, (segments_[s].share() / total) * on_slave);
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

  ContactReport contact_report(Point tangential, double slip) const {
    // Where dashpots take all of the pressure away rounding must not make it pull.
    const Point at = foot_of_all(),
                normal = dot(normal_on_b_, normal_of_contact()) > 0 ? normal_on_b_ : Point{0, 0};
    return {at.x, at.y, normal.x, normal.y, tangential.x, tangential.y, penetration_, slip != 0 ? 1.0 : 0.0};
  }

  std::vector<std::uint32_t> loose_;  ///< pairs that have no lane in a plan
  LaneContact<Law, 4> quadrilaterals_;
  LaneContact<Law, 8> octagons_;
  OverlapGroups finder_;
  CellDivider divider_;
  std::vector<Cell> cells_;
  std::vector<Segment> segments_;
  CarriedHistory carried_;
  Balance balance_;
  bool among_strips_ = false;    ///< whether a body of the pair has many elements
  LoadedSide last_resort_;       ///< among strips: where what is left over goes
  std::vector<Point> pressing_;  ///< [overlap] N/m on body b, what its springs push with
  Point normal_on_b_{0, 0};      ///< N/m, the same of all overlaps, and then with what dashpots push
  Point tangent_{0, 0};
  double contact_length_ = 0, slip_velocity_ = 0, slip_increment_ = 0, penetration_ = 0;
};

}  // namespace talus::overlap
