#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/lane_cells.hpp>
#include <talus/overlap/lane_group.hpp>
#include <talus/overlap/lane_sieve.hpp>

#include <algorithm>
#include <type_traits>
#include <vector>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// The distributed law for many pairs of plain bodies at once, one pair in each lane: the same forces as
/// DistributedContact, without clipping polygons. A lane that it cannot serve it hands back.
template <class Law, int corners>
class LaneContact {
 public:
  /// Starts a batch of `most` pairs at most.
  void clear(std::size_t most) {
    pairs_.clear();
    if (touching_[0].size() >= most + lanes) return;  // room to fill the last group
    for (auto* touching : {&touching_[0], &touching_[1], &sorted_}) touching->resize(most + lanes);
  }

  /// Where friction is remembered, so is the side that faces the other body; pairs that overlapped a step ago
  /// mostly still do.
  void add(const ContactBatch& batch, std::uint32_t pair) {
    if constexpr (Law::frictional) {
      const BodyPair& at = batch.pairs[pair];
      if (at.contact_count == 1) {
        const double* old = batch.history + std::size_t{at.slot_start} * friction_doubles;
        if (old[7] > 0) {
          fetch_ahead(batch.boundaries.corner + at.corner_start[1]);
          add_touching(at, TouchingPair::remembered(pair, old[7]));
          return;
        }
      }
    }
    pairs_.push_back(pair);
  }

  /// Calls general(pair) for the pairs that need the general path. Pairs are independent of each other, so
  /// which of them share a group cannot be seen in the result.
  template <class General>
  void evaluate(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                const General& general) {
    sieve_all(batch, loads);
    evaluate_touching(law, batch, loads, general);
    if (pairs_.empty()) return;
    // Those of last step that may have parted.
    sieve_all(batch, loads);
    evaluate_touching(law, batch, loads, general);
  }

 private:
  void sieve_all(const ContactBatch& batch, const ContactLoads& loads) {
    for (std::size_t i = 0; i < pairs_.size(); i += lanes) sieve(batch, loads, i);
    pairs_.clear();
  }

  template <class General>
  void evaluate_touching(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                         const General& general) {
    for (const bool averaged : {false, true}) {
      std::vector<TouchingPair>& touching = touching_[averaged];
      const std::size_t count = touching_count_[averaged];
      touching_count_[averaged] = 0;
      sort_by_pattern(touching, count);
      for (std::size_t i = count; i % lanes != 0; ++i) touching[i] = touching[count / lanes * lanes];
      for (std::size_t i = 0; i < count; i += lanes)
        evaluate_group(law, batch, loads, &touching[i],
                       static_cast<int>(std::min<std::size_t>(lanes, count - i)), averaged, general);
    }
  }

  /// Corners lie far from those of the pair before, in scenes that no cache holds. Those of body a mostly
  /// came with an earlier pair, for pairs are sorted by it.
  static void fetch_ahead(const BoundaryCorner* corner) {
    for (int i = 0; i < 4; ++i) __builtin_prefetch(corner + i);
  }

  void add_touching(const BodyPair& pair, TouchingPair touching) {
    const bool averaged = pair.master_share == 0.5;
    const int master = pair.master_share == 0 ? 1 : 0;
    const std::uint32_t shape =
        (pair.plain_corners[master] == 3 ? 1 : 0) + (pair.plain_corners[1 - master] == 3 ? 2 : 0);
    touching.code += shape * TouchingPair::shape_unit;
    touching_[averaged][touching_count_[averaged]++] = touching;
  }

  /// Lanes that meet at the same sides waste the least. Those meet at the same sides next time, mostly.
  void sort_by_pattern(std::vector<TouchingPair>& touching, std::size_t count) {
    if (lanes == 1 || count <= lanes) return;
    constexpr std::size_t bins = 128;
    const auto bin = [](const TouchingPair& pair) {
      return pair.shape() * (bins / 4) + (pair.pattern() * 40503u >> 10) % (bins / 4);
    };
    std::uint32_t start[bins + 1] = {};
    for (std::size_t i = 0; i < count; ++i) ++start[bin(touching[i]) + 1];
    for (std::size_t i = 0; i < bins; ++i) start[i + 1] += start[i];
    for (std::size_t i = 0; i < count; ++i) sorted_[start[bin(touching[i])]++] = touching[i];
    touching.swap(sorted_);
  }

  /// Leaves the pairs that overlap: those no side of which has the other piece outside.
  void sieve(const ContactBatch& batch, const ContactLoads& loads, std::size_t begin) {
    const int count = static_cast<int>(std::min<std::size_t>(lanes, pairs_.size() - begin));
    sieve_.look(batch, &pairs_[begin], count);
    for (int lane = 0; lane < count; ++lane) {
      const std::uint32_t number = pairs_[begin + lane];
      const BodyPair& pair = batch.pairs[number];
      if (sieve_.gap[lane] >= 0) {
        PairReport& report = loads.pairs[number];
        report = {};
        report.gap = sieve_.gap[lane];
        if constexpr (Law::frictional) report.slip_loss = stored_before(batch, pair);
        continue;
      }
      add_touching(pair,
                   TouchingPair::seen(number, sieve_.start(pair, 0, lane), sieve_.start(pair, 1, lane)));
    }
  }

  static double stored_before(const ContactBatch& batch, const BodyPair& pair) {
    double sum = 0;
    for (std::uint32_t i = 0; i < pair.contact_count; ++i)
      sum += batch.history[(pair.slot_start + i) * friction_doubles + 2];
    return sum;
  }

  template <class General>
  void evaluate_group(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                      const TouchingPair* touching, int count, bool averaged, const General& general) {
    LaneGroup& g = group_;
    g.collect(law, batch, touching, count);
    // Triangles and quadrilaterals, which most blocks are, need no look at which lane has which side.
    const auto evaluate_of = [&](auto sides, auto other_sides) {
      evaluate_group_of<sides, other_sides>(batch, loads, averaged, general);
    };
    if constexpr (corners == 4) {
      using std::integral_constant;
      constexpr integral_constant<int, 3> three;
      constexpr integral_constant<int, 4> four;
      const int sides = g.pieces[0].sides(), other_sides = g.pieces[1].sides();
      if (sides == 4 && other_sides == 4) return evaluate_of(four, four);
      if (sides == 3 && other_sides == 3) return evaluate_of(three, three);
      if (sides == 3 && other_sides == 4) return evaluate_of(three, four);
      if (sides == 4 && other_sides == 3) return evaluate_of(four, three);
    }
    evaluate_of(std::integral_constant<int, mixed>(), std::integral_constant<int, mixed>());
  }

  template <int sides, int other_sides, class General>
  void evaluate_group_of(const ContactBatch& batch, const ContactLoads& loads, bool averaged,
                         const General& general) {
    LaneGroup& g = group_;
    piece_[0].template read<sides>(g.pieces[0]);
    piece_[1].template read<other_sides>(g.pieces[1]);

    const Pack share = averaged ? 0.5 : 1.0;
    roles_ = averaged ? 2 : 1;
    Mask refused = piece_[0].degenerate | piece_[1].degenerate;
    Pack area = 0.0;
    const Pack stiffness = share * g.normal_stiffness;
    cells_[0].template find<sides, other_sides>(piece_[0], piece_[1], stiffness, g.clear_depth);
    if (averaged) cells_[1].template find<other_sides, sides>(piece_[1], piece_[0], stiffness, g.clear_depth);
    for (int role = 0; role < roles_; ++role) {
      refused = refused | cells_[role].deep | !(cells_[role].area > 0.0);
      area = area + cells_[role].area;
    }
    find_tangent();
    Report report;
    report.stored = roles_ == 2 ? cells_[0].stored + cells_[1].stored : cells_[0].stored;
    report.penetration =
        roles_ == 2 ? simd::max(cells_[0].penetration, cells_[1].penetration) : cells_[0].penetration;
    normal_damping(g, share, batch.dt, report);
    if constexpr (Law::frictional) friction(g, batch, area, report);
    const unsigned refused_bits = simd::bits(refused) & ((1u << g.count) - 1);
    write<sides, other_sides>(loads, g, report, refused_bits);
    for (int lane = 0; refused_bits >> lane != 0; ++lane) {
      if ((refused_bits >> lane & 1) == 0) continue;
      if (g.touching[lane].unseen()) {
        pairs_.push_back(g.pair(lane));
      } else {
        general(g.pair(lane));
      }
    }
  }

  /// §3.2.2: n_c is the direction of the resultant, s_c is perpendicular to it. Of the arcs, which share
  /// their ends, one tells the contact length. Where the overlap is no more than rounding, one role may see
  /// all of it and the other next to nothing: then the longer arc tells, or dashpots along it would be those
  /// of a point. An arc that closes on itself has no length.
  void find_tangent() {
    const Packs2 force = roles_ == 2 ? cells_[0].force - cells_[1].force : cells_[0].force;
    const Pack size = simd::sqrt(simd::dot(force, force));
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

  struct Report {
    Pack stored, penetration, slip_loss = 0.0, damping_power = 0.0;
    Pack elastic = 0.0, applied = 0.0, spring_energy = 0.0, centre_x = 0.0, centre_y = 0.0, slip = 0.0;
    Pack tangential = 0.0;  ///< N/m along the tangent, on piece 1
  };

  /// A dashpot along the normal of each cell, never pulling.
  void normal_damping(const LaneGroup& g, Pack share, double dt, Report& report) {
    if (!simd::any(g.normal_damping > 0.0)) return;
    const Pack viscosity = simd::only_where(
        contact_length_ > 0.0,
        share * 2.0 * g.normal_damping * simd::sqrt(g.normal_stiffness * g.reduced_mass / contact_length_));
    Pack power = 0.0;
    for (int role = 0; role < roles_; ++role) {
      for (LaneCell& cell : cells_[role].cells()) power = power + damp_cell(cell, viscosity);
    }
    report.damping_power = power * dt;
  }

  /// Returns its power.
  static Pack damp_cell(LaneCell& cell, Pack viscosity) {
    LaneCorner* const master = cell.master;
    const Packs2 normal = master->normal();
    const Pack master_start = simd::dot(normal, master->velocity),
               master_change = simd::dot(normal, master[1].velocity) - master_start;
    Pack on_start = 0.0, on_end = 0.0, power = 0.0;
    for (const LaneSegment* at = cell.begin; at != cell.end; ++at) {
      LaneCorner* const slave = at->slave;
      const Pack facing = simd::max(0.0, -simd::dot(slave->tangent, master->tangent));
      const Pack slave_start = simd::dot(normal, slave->velocity),
                 slave_change = simd::dot(normal, slave[1].velocity) - slave_start;
      const Pack start = master_start - slave_start;
      const Pack rate0 = start + at->start_lever * master_change - at->start * slave_change;
      const Pack rate1 = start + at->end_lever * master_change - at->end * slave_change;
      const Pack scale = viscosity * facing * at->length * (1.0 / 6.0);
      const Pack force0 =
          simd::only_where(at->valid, simd::max(scale * (rate0 + rate0 + rate1), -facing * at->start_load));
      const Pack force1 =
          simd::only_where(at->valid, simd::max(scale * (rate1 + rate1 + rate0), -facing * at->end_load));
      const Pack both = force0 + force1, slave_end = force0 * at->start + force1 * at->end,
                 master_end = force0 * at->start_lever + force1 * at->end_lever;
      slave[0].push(both - slave_end, normal);
      slave[1].push(slave_end, normal);
      on_start = on_start + (both - master_end);
      on_end = on_end + master_end;
      power = power + simd::only_where(at->valid, force0 * rate0 + force1 * rate1);
    }
    master[0].push(-on_start, normal);
    master[1].push(-on_end, normal);
    cell.load = simd::max(0.0, cell.load + on_start + on_end);
    return power;
  }

  /// Shares a unit tangential force on piece 1 among the cells, which take it on both pieces at one common
  /// point each. Returns the velocity of the slip through which it works.
  Pack share_tangential_force(Pack load) {
    const Pack inverse_load = simd::only_where(load > 0.0, 1.0 / load);
    Pack slip = 0.0;
    for (int role = 0; role < roles_; ++role) {
      for (LaneCell& cell : cells_[role].cells()) {
        const LaneCorner* const master = cell.master;
        cell.shear = cell.load * inverse_load * (role == 0 ? 1.0 : -1.0);
        const Pack start = simd::dot(tangent_, master[0].velocity),
                   end = simd::dot(tangent_, master[1].velocity);
        slip = slip - cell.shear * (start + cell.lever * (end - start));
        const Packs2 foot = master->at + cell.lever * master->length * master->tangent;
        const Pack scale = simd::only_where(cell.share > 0.0, cell.shear / cell.share);
        for (LaneSegment* at = cell.begin; at != cell.end; ++at)
          slip = slip + shear_at(foot, scale * at->share, *at);
      }
    }
    return slip;
  }

  /// `size` along the tangent at `foot`, off the slave side. Returns the velocity it works through, times
  /// size.
  Pack shear_at(Packs2 foot, Pack size, LaneSegment& at) const {
    const LaneCorner* const slave = at.slave;
    const Packs2 from = foot - slave->at, change = slave[0].velocity - slave[1].velocity;
    const Pack part = size / slave->length;
    at.shear_end = part * simd::dot(slave->tangent, from);
    at.shear_start = size - at.shear_end;
    at.couple = -part * simd::cross(slave->tangent, from) * simd::dot(slave->tangent, tangent_);
    return size * simd::dot(tangent_, slave->velocity) - at.shear_end * simd::dot(tangent_, change) +
           at.couple * simd::dot(slave->normal(), change);
  }

  void apply_tangential_force(Pack size) {
    const Packs2 force = size * tangent_;
    for (int role = 0; role < roles_; ++role) {
      for (LaneCell& cell : cells_[role].cells()) {
        const Pack end = cell.shear * cell.lever;
        cell.master[0].push(end - cell.shear, force);
        cell.master[1].push(-end, force);
        for (const LaneSegment* at = cell.begin; at != cell.end; ++at) {
          const Packs2 couple = size * at->couple * at->slave->normal();
          at->slave[0].load = at->slave[0].load + (at->shear_start * force + couple);
          at->slave[1].load = at->slave[1].load + (at->shear_end * force - couple);
        }
      }
    }
  }

  /// Eqs. 37–44: the slip is that through which the tangential loads work.
  void friction(const LaneGroup& g, const ContactBatch& batch, Pack area, Report& report) {
    Pack load = 0.0;
    for (int role = 0; role < roles_; ++role) {
      for (const LaneCell& cell : cells_[role].cells()) load = load + cell.load;
    }
    const Pack slip = share_tangential_force(load);
    const Pack increment = slip * batch.dt;

    Pack old[4];
    const double* history[lanes];
    for (int lane = 0; lane < lanes; ++lane) history[lane] = batch.history + g.kept(lane);
    simd::gather_rows(history, old);
    for (Pack& value : old) value = simd::only_where(g.remembered, value);
    const Pack old_elastic = old[0], old_applied = old[1], old_stored = old[2], old_length = old[3];
    const Pack limit = g.friction * load;
    const Mask holds = (limit > 0.0) & (contact_length_ > 0.0);
    const Pack bound = batch.hold_stick ? Pack(1e300) : limit;
    const Pack stiffness = g.tangential_stiffness * contact_length_;
    const Pack carried =
        simd::select(contact_length_ < old_length, old_elastic * (contact_length_ / old_length), old_elastic);
    const Pack trial = carried - stiffness * increment;
    const Pack elastic = simd::only_where(holds, simd::clamp(trial, -bound, bound));
    const Mask slips = holds & (simd::abs(trial) > bound);
    report.elastic = report.applied = elastic;
    report.spring_energy =
        simd::only_where(holds & (stiffness > 0.0), elastic * elastic / (stiffness + stiffness));
    report.slip = simd::only_where(slips, simd::select(trial < 0.0, -1.0, 1.0));
    report.stored = report.stored + report.spring_energy;
    report.slip_loss = -(old_applied + elastic) * increment * 0.5 - (report.spring_energy - old_stored);

    report.tangential = elastic;
    if (simd::any(g.tangential_damping > 0.0)) {
      const Pack viscosity = 2.0 * g.tangential_damping * simd::sqrt(stiffness * g.reduced_mass);
      const Pack damped = simd::clamp(elastic - viscosity * slip, -bound, bound);
      report.tangential = simd::select(holds & !slips & (g.tangential_damping > 0.0), damped, elastic);
      report.damping_power =
          report.damping_power + simd::max(0.0, -(report.tangential - elastic) * increment);
    }
    apply_tangential_force(report.tangential);
    const Pack x = roles_ == 2 ? cells_[0].moment_x + cells_[1].moment_x : cells_[0].moment_x;
    const Pack y = roles_ == 2 ? cells_[0].moment_y + cells_[1].moment_y : cells_[0].moment_y;
    const Pack inverse = 1.0 / area;
    report.centre_x = x * inverse;
    report.centre_y = y * inverse;
  }

  /// What TouchingPair::remembered() reads.
  Pack remembered(const LaneGroup& g) const {
    return TouchingPair::pattern_unit * cells_[0].pattern + g.starts;
  }

  template <int sides, int other_sides>
  void write(const ContactLoads& loads, const LaneGroup& g, const Report& report, unsigned refused) {
    const auto close = [](LanePiece<corners>& piece, int after_last) {
      piece.corner[0].load = piece.corner[0].load + piece.corner[after_last].load;
    };
    close(piece_[0], corners_of(sides, corners));
    close(piece_[1], corners_of(other_sides, corners));
    g.write_loads<corners, sides, other_sides>(loads, refused, piece_);
    PairReport spare;
    double spare_history[friction_doubles];
    double *report_row[lanes], *row[lanes], *second_row[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const bool wanted = lane < g.count && (refused >> lane & 1) == 0;
      PairReport& to = wanted ? loads.pairs[g.pair(lane)] : spare;
      to.contact_count = 1;
      to.gap = 0;
      report_row[lane] = &to.penetration;
      if constexpr (Law::frictional) {
        row[lane] = wanted ? loads.history + g.kept(lane) : spare_history;
        row[lane][8] = 0;
        second_row[lane] = row[lane] + 4;
      }
    }
    const Pack energies[4] = {report.penetration, report.stored, report.slip_loss, report.damping_power};
    simd::scatter_rows(energies, report_row);
    if constexpr (Law::frictional) {
      const Pack first[4] = {report.elastic, report.applied, report.spring_energy, contact_length_};
      simd::scatter_rows(first, row);
      const Pack second[4] = {report.centre_x, report.centre_y, report.slip, remembered(g)};
      simd::scatter_rows(second, second_row);
    }
    if (loads.reports != nullptr) write_contacts(loads, g, report, refused);
  }

  void write_contacts(const ContactLoads& loads, const LaneGroup& g, const Report& report,
                      unsigned refused) const {
    Pack load = 0.0;
    Packs2 moment{0.0, 0.0}, normal{0.0, 0.0};
    for (int role = 0; role < roles_; ++role) {
      for (const LaneCell& cell : cells_[role].cells()) {
        const LaneCorner& master = *cell.master;
        load = load + cell.load;
        moment = moment + cell.load * (master.at + cell.lever * master.length * master.tangent);
        normal = normal + (role == 0 ? cell.load : -cell.load) * master.normal();
      }
    }
    const Pack side = simd::select(simd::nonzero(g.swapped), -1.0, 1.0), inverse = 1.0 / load;
    const Mask loaded = load > 0.0;
    const Pack x = simd::select(loaded, moment.x * inverse, cells_[0].moment_x / cells_[0].area),
               y = simd::select(loaded, moment.y * inverse, cells_[0].moment_y / cells_[0].area);
    alignas(64) double value[8][lanes];
    simd::store(x, value[0]);
    simd::store(y, value[1]);
    simd::store(side * normal.x, value[2]);
    simd::store(side * normal.y, value[3]);
    simd::store(side * report.tangential * tangent_.x, value[4]);
    simd::store(side * report.tangential * tangent_.y, value[5]);
    simd::store(report.penetration, value[6]);
    simd::store(simd::abs(report.slip), value[7]);
    for (int lane = 0; lane < g.count; ++lane) {
      if ((refused >> lane & 1) != 0) continue;
      loads.reports[g.pairs.at[lane]->slot_start] = {value[0][lane], value[1][lane], value[2][lane],
                                                     value[3][lane], value[4][lane], value[5][lane],
                                                     value[6][lane], value[7][lane]};
    }
  }

  std::vector<std::uint32_t> pairs_;
  std::vector<TouchingPair> touching_[2];  ///< [both roles count half]
  std::size_t touching_count_[2] = {0, 0};
  std::vector<TouchingPair> sorted_;
  LaneSieve<corners> sieve_;
  LaneGroup group_;
  LanePiece<corners> piece_[2];
  LaneCells<corners> cells_[2];
  int roles_ = 1;
  Packs2 tangent_;
  Pack contact_length_;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
