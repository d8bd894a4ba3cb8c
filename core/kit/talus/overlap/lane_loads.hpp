#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/friction.hpp>
#include <talus/overlap/lane_cells.hpp>
#include <talus/overlap/lane_group.hpp>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// The distributed law for the pairs of one group, a lane each.
template <class Law, int corners>
class LaneLoads {
 public:
  /// Returns the lanes that it cannot serve.
  LaneBits evaluate(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                    const LaneGroup<corners>& group) {
    // Triangles and quadrilaterals, which most blocks are, need no look at which lane has which side.
    if constexpr (corners == 4) {
      const int sides = group.sides[0], other_sides = group.sides[1];
      if (sides == 4 && other_sides == 4) return evaluate_lanes<4, 4>(law, batch, loads, group);
      if (sides == 3 && other_sides == 3) return evaluate_lanes<3, 3>(law, batch, loads, group);
      if (sides == 3 && other_sides == 4) return evaluate_lanes<3, 4>(law, batch, loads, group);
      if (sides == 4 && other_sides == 3) return evaluate_lanes<4, 3>(law, batch, loads, group);
    }
    return evaluate_lanes<mixed, mixed>(law, batch, loads, group);
  }

 private:
  template <int sides, int other_sides>
  LaneBits evaluate_lanes(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                          const LaneGroup<corners>& g) {
    rows_[0].template lay_out<sides>(g.places[0]);
    rows_[1].template lay_out<other_sides>(g.places[1]);
    piece_[0].template read<sides>(batch.boundaries.corner, rows_[0], g.offset(0));
    piece_[1].template read<other_sides>(batch.boundaries.corner, rows_[1], g.offset(1));
    const LaneParameters interface(law, batch.interfaces, g);

    const Pack share = g.averaged ? 0.5 : 1.0;
    roles_ = g.averaged ? 2 : 1;
    Mask refused = piece_[0].degenerate | piece_[1].degenerate;
    const Pack stiffness = share * interface.normal_stiffness, clear_depth = g.clear_depth;
    const bool damped = simd::any(interface.normal_damping > 0.0);
    cells_[0].template find<sides, other_sides>(piece_[0], piece_[1], stiffness, clear_depth, damped);
    if (g.averaged)
      cells_[1].template find<other_sides, sides>(piece_[1], piece_[0], stiffness, clear_depth, damped);
    for (int role = 0; role < roles_; ++role) {
      refused = refused | cells_[role].deep | !(cells_[role].area > 0.0);
    }
    find_tangent();
    Report report;
    report.pressed = spring_force_;
    report.stored = roles_ == 2 ? cells_[0].stored + cells_[1].stored : cells_[0].stored;
    report.penetration =
        roles_ == 2 ? simd::max(cells_[0].penetration, cells_[1].penetration) : cells_[0].penetration;
    if (damped || Law::frictional) {
      const auto triangle = piece_[0].template largest_triangle<sides>();
      const auto other = piece_[1].template largest_triangle<other_sides>();
      const Sliding sliding(piece_[0], piece_[0].template motion<sides>(triangle), piece_[1],
                            piece_[1].template motion<other_sides>(other));
      Between between = load_normally(g, interface, stiffness, share, sliding, batch, damped, report);
      if constexpr (Law::frictional) friction(g, interface, sliding, batch, between, report);
      piece_[1].template push_at_points<other_sides>(other, between.force, between.moment_x,
                                                     between.moment_y);
      piece_[0].template push_at_points<sides>(triangle, -between.force, -between.moment_x,
                                               -between.moment_y);
    } else {
      press(stiffness);
    }
    const LaneBits unserved = simd::bits(refused) & g.live;
    write<sides, other_sides>(loads, g, report, g.live & ~unserved);
    return unserved;
  }

  /// §3.2.2: n_c is the direction of the resultant, s_c is perpendicular to it. Of the arcs, which share
  /// their ends, one tells the contact length. Where the overlap is no more than rounding, one role may see
  /// all of it and the other next to nothing: then the longer arc tells, or dashpots along it would be those
  /// of a point. An arc that closes on itself has no length.
  void find_tangent() {
    const Packs2 force = roles_ == 2 ? cells_[0].force - cells_[1].force : cells_[0].force;
    const Pack size = spring_force_ = simd::sqrt(simd::dot(force, force));
    const Pack inverse = simd::only_where(size > 0.0, 1.0 / size);  // springs may have no stiffness
    tangent_ = {-force.y * inverse, force.x * inverse};
    contact_length_ = simd::abs(simd::dot(cells_[0].arc, tangent_));
    Pack longest = cells_[0].arc_length;
    if (roles_ == 2) {
      const Pack other = simd::abs(simd::dot(cells_[1].arc, tangent_));
      contact_length_ = simd::select(other > contact_length_ + contact_length_, other, contact_length_);
      longest = simd::max(longest, cells_[1].arc_length);
    }
    contact_length_ = simd::only_where(contact_length_ > 1e-9 * longest, contact_length_);
  }

  Packs2 normal_of_contact() const { return {tangent_.y, -tangent_.x}; }  ///< on piece 1

  struct Report {
    Pack stored, penetration, slip_loss = 0.0, damping_power = 0.0, damping_force = 0.0;
    Pack elastic = 0.0, spring_energy = 0.0, slip = 0.0;
    Packs2 foot;            ///< m, where it acts
    Pack tangential = 0.0;  ///< N/m along the tangent, on piece 1
    Pack pressed;           ///< N/m, springs and dashpots along the normal: what friction goes by
  };

  /// How piece 1 moves against piece 0: the velocity, m/s, where corner 0 of that is, and how it changes,
  /// 1/s.
  struct Sliding {
    Packs2 origin, velocity, by_x, by_y;

    Sliding(const LanePiece<corners>& piece, const typename LanePiece<corners>::Motion& motion,
            const LanePiece<corners>& other, const typename LanePiece<corners>::Motion& of_other)
        : origin(piece.corner[0].at), by_x(of_other.by_x - motion.by_x), by_y(of_other.by_y - motion.by_y) {
      const Packs2 from = origin - other.corner[0].at;
      velocity = of_other.start - motion.start + (from.x * of_other.by_x + from.y * of_other.by_y);
    }
    Packs2 at(Packs2 point) const {
      const Packs2 from = point - origin;
      return velocity + (from.x * by_x + from.y * by_y);
    }
  };

  /// Forces on piece 1 at points that both pieces have in common: their sum, N/m, and those of either
  /// component times where they act, N.
  struct Between {
    Packs2 force, moment_x, moment_y;
  };

  /// Puts the pressure on both pieces. Returns what dashpots along the normal of the contact do: along the
  /// normals of its sides they would brake a corner that slides.
  Between load_normally(const LaneGroup<corners>& g, const LaneParameters& interface, Pack stiffness,
                        Pack share, const Sliding& sliding, const ContactBatch& batch, bool damped,
                        Report& report) {
    const Packs2 none{0.0, 0.0};
    if (!damped) {
      press(stiffness);
      return {none, none, none};
    }
    slipped_ = Law::frictional ? simd::mask_of(slipped(g, history_of(g, batch))) : simd::nowhere();
    const Packs2 normal = normal_of_contact();
    const Closing closing{
        simd::only_where(contact_length_ > 0.0,
                         share * 2.0 * interface.normal_damping *
                             simd::sqrt(interface.normal_stiffness * g.reduced_mass / contact_length_)),
        sliding.origin,
        -simd::dot(normal, sliding.velocity),
        {-simd::dot(normal, sliding.by_x), -simd::dot(normal, sliding.by_y)}};
    Dashpots dashpots;
    each_cell([&](LaneCell& cell, Packs2 along) {
      dashpots.add(load_cell<true>(cell, along, stiffness, closing));
    });
    // Where slave sides look away from the master their springs push the other way, and what the others'
    // dashpots may take is too much.
    const Mask pulls = spring_force_ + dashpots.force < 0.0;
    if (simd::any(pulls)) dashpots.scale(simd::select(pulls, spring_force_ / -dashpots.force, 1.0));
    report.damping_power = dashpots.power * batch.dt;
    report.damping_force = dashpots.size;
    report.pressed = simd::max(0.0, spring_force_ + dashpots.force);
    return {dashpots.force * normal, normal.x * dashpots.moment, normal.y * dashpots.moment};
  }

  void press(Pack stiffness) {
    each_cell([&](LaneCell& cell, Packs2 along) { load_cell<false>(cell, along, stiffness, {}); });
  }

  /// Calls visit(cell, direction in which it pushes its slave).
  template <class Visit>
  void each_cell(const Visit& visit) {
    const Packs2 normal = normal_of_contact();
    for (LaneCell& cell : cells_[0].cells()) visit(cell, normal);
    if (roles_ == 1) return;
    for (LaneCell& cell : cells_[1].cells()) visit(cell, -normal);
  }

  /// How the bodies of a contact, which move by one affine map each, close in on each other along its normal,
  /// and what its dashpots make of that.
  struct Closing {
    Pack viscosity;  ///< N s/m², of one role
    Packs2 origin;   ///< m
    Pack speed;      ///< m/s, there
    Packs2 change;   ///< 1/s, of it
  };
  struct Dashpots {
    Pack power = 0.0, size = 0.0;  ///< W/m; N/m, Σ|F|
    Pack force = 0.0;              ///< N/m, ΣF
    Packs2 moment{0.0, 0.0};       ///< N, Σ F times where it acts

    void add(const Dashpots& other) {
      power = power + other.power;
      size = size + other.size;
      force = force + other.force;
      moment = moment + other.moment;
    }
    void scale(Pack share) {
      power = share * power;
      size = share * size;
      force = share * force;
      moment = share * moment;
    }
  };

  /// Eqs. 28–36: on the slave by the trapezoid rule, on the master through the foot. The dashpot never pulls.
  template <bool damped>
  Dashpots load_cell(LaneCell& cell, Packs2 along, Pack stiffness, const Closing& closing) const {
    LaneCorner* const master = cell.master;
    const Packs2 normal = master->normal();
    master[0].push(cell.on_end - cell.load, normal);
    master[1].push(-cell.on_end, normal);
    // What presses a corner from both its sides adds no friction to it.
    const Pack part = simd::max(0.0, simd::dot(along, normal));
    const Pack spring = part * cell.load, spring_on_end = part * cell.on_end;
    Pack all = spring, on_end = spring_on_end;
    Dashpots dashpots;
    for (const LaneSegment* at = cell.begin; at != cell.end; ++at) {
      LaneCorner* const slave = at->slave;
      const Pack pressed = stiffness * at->length;
      const Pack press0 = pressed * at->start_depth, press1 = pressed * at->end_depth;
      const Pack press_end = press0 * at->start + press1 * at->end, press_start = press0 + press1 - press_end;
      const Packs2 inward{-slave->tangent.y, slave->tangent.x};
      slave[0].push(press_start, inward);
      slave[1].push(press_end, inward);
      if constexpr (!damped) continue;
      const Packs2 span = slave[1].at - slave->at;
      const Pack start = closing.speed + simd::dot(closing.change, slave->at - closing.origin),
                 change = simd::dot(closing.change, span);
      const Pack rate0 = start + at->start * change, rate1 = start + at->end * change;
      // A slave side that leans pushes along the normal with a part of its load only.
      const Pack facing = at->length * simd::max(0.0, simd::dot(inward, along));
      const Pack scale = closing.viscosity * facing * (1.0 / 6.0), most = -stiffness * facing;
      const Pack force0 = simd::max(scale * (rate0 + rate0 + rate1), most * at->start_depth);
      const Pack force1 = simd::max(scale * (rate1 + rate1 + rate0), most * at->end_depth);
      const Pack both = force0 + force1;
      all = all + both;
      on_end = on_end + (force0 * at->start_lever + force1 * at->end_lever);
      dashpots.force = dashpots.force + both;
      dashpots.moment = dashpots.moment + (both * slave->at + (force0 * at->start + force1 * at->end) * span);
      dashpots.power = dashpots.power + (force0 * rate0 + force1 * rate1);
      dashpots.size = dashpots.size + (simd::abs(force0) + simd::abs(force1));
    }
    cell.load = simd::max(0.0, all);
    cell.on_end = simd::clamp(on_end, 0.0, cell.load);
    // As in DistributedContact::place_friction().
    cell.shear = damped ? simd::select(slipped_, cell.load, spring) : spring;
    cell.shear_on_end = damped ? simd::select(slipped_, cell.on_end, spring_on_end) : spring_on_end;
    return dashpots;
  }

  /// Where loads of all cells act together, of which on_end is what the ends of the sides carry; without
  /// load, the mean over their areas.
  Packs2 foot_of_all(Pack LaneCell::*load_of, Pack LaneCell::*on_end_of) const {
    Pack load = 0.0;
    for (int role = 0; role < roles_; ++role) {
      for (const LaneCell& cell : cells_[role].cells()) load = load + cell.*load_of;
    }
    const auto mean = [&](Pack total, const auto& weight, const auto& on_end) {
      Packs2 moment{0.0, 0.0};
      for (int role = 0; role < roles_; ++role) {
        for (const LaneCell& cell : cells_[role].cells())
          moment = moment + (weight(cell) * cell.master->at + on_end(cell) * cell.side());
      }
      return 1.0 / total * moment;
    };
    const Packs2 foot = mean(
        load, [&](const LaneCell& cell) { return cell.*load_of; },
        [&](const LaneCell& cell) { return cell.*on_end_of; });
    const Mask loaded = load > 0.0;
    if (simd::bits(loaded) == all_lanes) return foot;
    const Pack area = roles_ == 2 ? cells_[0].area + cells_[1].area : cells_[0].area;
    const Packs2 middle = mean(
        area, [](const LaneCell& cell) { return cell.area; },
        [](const LaneCell& cell) { return cell.area * cell.lever; });
    return simd::select(loaded, foot, middle);
  }

  struct Histories {
    const double* row[lanes];
  };
  static Histories history_of(const LaneGroup<corners>& g, const ContactBatch& batch) {
    Histories all;
    for (int lane = 0; lane < lanes; ++lane)
      all.row[lane] = batch.history + std::size_t{g.slot[lane]} * friction_doubles;
    return all;
  }

  /// Lanes that slipped a step ago.
  static LaneBits slipped(const LaneGroup<corners>& g, const Histories& history) {
    LaneBits slipped = 0;
    for (int lane = 0; lane < lanes; ++lane)
      slipped |= (history.row[lane][slip_in_history] != 0 ? 1u : 0u) << lane;
    return slipped & g.remembered;
  }

  /// Eqs. 37–44: the slip is that through which the tangential load works. Cells take it by their loads, on
  /// both bodies at one common point each; of bodies that move by one affine map this is the same as all of
  /// it at the foot of all.
  void friction(const LaneGroup<corners>& g, const LaneParameters& interface, const Sliding& sliding,
                const ContactBatch& batch, Between& between, Report& report) {
    const Packs2 foot = foot_of_all(&LaneCell::shear, &LaneCell::shear_on_end);
    const Pack load = report.pressed;
    const Pack slip = simd::dot(tangent_, sliding.at(foot));
    const Pack increment = slip * batch.dt;

    Pack old[4];
    simd::gather_rows(history_of(g, batch).row, old);
    const Mask remembered = simd::mask_of(g.remembered);
    for (Pack& value : old) value = simd::only_where(remembered, value);
    const Pack old_elastic = old[0], old_applied = old[1], old_stored = old[2], old_length = old[3];
    const Pack limit = interface.friction * load;
    const Mask holds = (limit > 0.0) & (contact_length_ > 0.0);
    const Pack bound = batch.hold_stick ? Pack(1e300) : limit;
    const Pack stiffness = interface.tangential_stiffness * contact_length_;
    const Pack carried =
        simd::select(contact_length_ < old_length, old_elastic * (contact_length_ / old_length), old_elastic);
    const Pack trial = carried - stiffness * increment;
    const Pack elastic = simd::only_where(holds, simd::clamp(trial, -bound, bound));
    const Mask slips = holds & (simd::abs(trial) > bound);
    report.elastic = elastic;
    report.spring_energy =
        simd::only_where(holds & (stiffness > 0.0), elastic * elastic / (stiffness + stiffness));
    report.slip = simd::only_where(slips, simd::select(trial < 0.0, -1.0, 1.0));
    report.stored = report.stored + report.spring_energy;
    // What a dashpot pushed with until it slips is lost in friction; while it sticks the host books that.
    const Pack before = simd::select(holds & !slips, old_elastic, old_applied);
    report.slip_loss = -(before + elastic) * increment * 0.5 - (report.spring_energy - old_stored);

    report.tangential = elastic;
    if (simd::any(interface.tangential_damping > 0.0)) {
      const Pack viscosity = 2.0 * interface.tangential_damping * simd::sqrt(stiffness * g.reduced_mass);
      const Pack damped = simd::clamp(elastic - viscosity * slip, -bound, bound);
      report.tangential =
          simd::select(holds & !slips & (interface.tangential_damping > 0.0), damped, elastic);
      const Pack dashpot = report.tangential - elastic;
      report.damping_power = report.damping_power + simd::max(0.0, -dashpot * increment);
      report.damping_force = report.damping_force + simd::abs(dashpot);
    }
    const Packs2 force = report.tangential * tangent_;
    between.force = between.force + force;
    between.moment_x = between.moment_x + force.x * foot;
    between.moment_y = between.moment_y + force.y * foot;
    report.foot = foot;
  }

  template <int sides, int other_sides>
  void write(const ContactLoads& loads, const LaneGroup<corners>& g, const Report& report, LaneBits wanted) {
    const auto close = [](LanePiece<corners>& piece, int after_last) {
      piece.corner[0].load = piece.corner[0].load + piece.corner[after_last].load;
    };
    close(piece_[0], corners_of(sides, corners));
    close(piece_[1], corners_of(other_sides, corners));
    if constexpr (sides == mixed) {
      for (int p = 0; p < 2; ++p) piece_[p].fold_repeated(g.places[p].count);
    }
    g.template write_loads<sides, other_sides>(loads, wanted, rows_, piece_);
    double *report_row[lanes], *row[lanes], *second_row[lanes];
    PairReport spare;
    double spare_history[friction_doubles];
    const auto write_to = [&](int lane, PairReport& to, [[maybe_unused]] double* history,
                              [[maybe_unused]] std::uint32_t slot) {
      to.contact_count = 1;
      to.gap = 0;
      to.damping_force = 0;
      report_row[lane] = &to.penetration;
      if constexpr (Law::frictional) {
        row[lane] = history + std::size_t{slot} * friction_doubles;
        second_row[lane] = row[lane] + 4;
      }
    };
    const auto write_to_pair = [&](int lane) {
      write_to(lane, loads.pairs[g.pair[lane]], loads.history, g.slot[lane]);
    };
    if (wanted == all_lanes) {
      for (int lane = 0; lane < lanes; ++lane) write_to_pair(lane);
    } else {
      for (int lane = 0; lane < lanes; ++lane) {
        if ((wanted >> lane & 1) != 0)
          write_to_pair(lane);
        else
          write_to(lane, spare, spare_history, 0);
      }
    }
    const Pack energies[4] = {report.penetration, report.stored, report.slip_loss, report.damping_power};
    simd::scatter_rows(energies, report_row);
    if (simd::any(report.damping_force > 0.0)) write_dashpots(loads, g, report, wanted);
    if constexpr (Law::frictional) {
      const Pack first[4] = {report.elastic, report.tangential, report.spring_energy, contact_length_};
      simd::scatter_rows(first, row);
      const Pack second[4] = {report.foot.x, report.foot.y, report.slip,
                              TouchingPair::pattern_unit * cells_[0].pattern + g.starts};
      simd::scatter_rows(second, second_row);
    }
    if (loads.reports != nullptr) write_contacts<other_sides>(loads, g, report, wanted);
  }

  static void write_dashpots(const ContactLoads& loads, const LaneGroup<corners>& g, const Report& report,
                             LaneBits wanted) {
    alignas(64) double force[lanes];
    simd::store(report.damping_force, force);
    each_lane(wanted,
              [&](int lane) { loads.pairs[g.pair[lane]].damping_force = static_cast<float>(force[lane]); });
  }

  template <int other_sides>
  void write_contacts(const ContactLoads& loads, const LaneGroup<corners>& g, const Report& report,
                      LaneBits wanted) const {
    const Packs2 normal = report.pressed * normal_of_contact(),
                 foot = foot_of_all(&LaneCell::load, &LaneCell::on_end);
    const Pack side = simd::select(simd::mask_of(g.swapped), -1.0, 1.0);
    Pack moment = 0.0;
    for (int i = 0; i < corners_of(other_sides, corners); ++i)
      moment = moment + simd::cross(piece_[1].corner[i].at - foot, piece_[1].corner[i].load);
    alignas(64) double value[9][lanes];
    simd::store(foot.x, value[0]);
    simd::store(foot.y, value[1]);
    simd::store(side * normal.x, value[2]);
    simd::store(side * normal.y, value[3]);
    simd::store(side * report.tangential * tangent_.x, value[4]);
    simd::store(side * report.tangential * tangent_.y, value[5]);
    simd::store(report.penetration, value[6]);
    simd::store(simd::abs(report.slip), value[7]);
    simd::store(side * moment, value[8]);
    each_lane(wanted, [&](int lane) {
      loads.reports[g.slot[lane]] = {value[0][lane], value[1][lane], value[2][lane],
                                     value[3][lane], value[4][lane], value[5][lane],
                                     value[6][lane], value[7][lane], value[8][lane]};
    });
  }

  LaneRows<corners> rows_[2];
  LanePiece<corners> piece_[2];
  LaneCells<corners> cells_[2];
  int roles_ = 1;
  Mask slipped_;
  Packs2 tangent_;
  Pack contact_length_, spring_force_;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
