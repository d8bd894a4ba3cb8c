#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/lane_cells.hpp>
#include <talus/overlap/lane_group.hpp>

#include <algorithm>
#include <vector>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// Loads at the corners of both pieces of a pair, N/m.
template <int corners>
struct LaneLoads {
  Packs2 at[2][corners + 1];  ///< entry `corners` is added to entry 0 in the end

  void clear() {
    for (auto& piece : at) {
      for (Packs2& load : piece) load = {0.0, 0.0};
    }
  }
  void add(int piece, int corner, Pack size, Packs2 direction) {
    at[piece][corner] = at[piece][corner] + size * direction;
  }
};

/// The distributed law for many pairs of plain bodies at once, one pair in each lane: the same forces as
/// DistributedContact, without clipping polygons. A lane that it cannot serve it hands back.
template <class Law, int corners>
class LaneContact {
 public:
  /// Starts a batch.
  void clear() {
    pairs_.clear();
    for (auto& of_roles : touching_) of_roles.clear();
  }

  /// Where friction is remembered, so is the side that faces the other body; pairs that overlapped a step ago
  /// mostly still do.
  void add(const ContactBatch& batch, std::uint32_t pair) {
    if constexpr (Law::frictional) {
      const BodyPair& at = batch.pairs[pair];
      if (at.contact_count == 1) {
        const double* old = batch.history + at.slot_start * friction_doubles;
        if (old[7] > 0) {
          touching_[at.master_share == 0.5].push_back(TouchingPair::remembered(pair, old[7]));
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
      sort_by_pattern(touching);
      for (std::size_t i = 0; i < touching.size(); i += lanes)
        evaluate_group(law, batch, loads, touching, i, averaged, general);
      touching.clear();
    }
  }

  /// Lanes that meet at the same sides waste the least. Those meet at the same sides next time, mostly.
  void sort_by_pattern(std::vector<TouchingPair>& touching) {
    if (lanes == 1 || touching.size() <= lanes) return;
    constexpr std::size_t bins = 64;
    const auto bin = [](const TouchingPair& pair) { return (pair.pattern() * 40503u >> 10) % bins; };
    std::uint32_t start[bins + 1] = {};
    for (const TouchingPair& pair : touching) ++start[bin(pair) + 1];
    for (std::size_t i = 0; i < bins; ++i) start[i + 1] += start[i];
    sorted_.resize(touching.size());
    for (const TouchingPair& pair : touching) sorted_[start[bin(pair)]++] = pair;
    touching.swap(sorted_);
  }

  /// Leaves the pairs that overlap: those no side of which has the other piece outside.
  void sieve(const ContactBatch& batch, const ContactLoads& loads, std::size_t begin) {
    const int count = static_cast<int>(std::min<std::size_t>(lanes, pairs_.size() - begin));
    LanePieces pieces[2];
    for (int lane = 0; lane < lanes; ++lane) {
      const BodyPair& pair = batch.pairs[pairs_[begin + (lane < count ? lane : 0)]];
      const PiecePair& piece = batch.piece_pairs[pair.piece_pair_start];
      pieces[0].set(lane, batch.boundaries, piece.a, 0, 0, 0);
      pieces[1].set(lane, batch.boundaries, piece.b, pair.offset_x, pair.offset_y, 0);
    }
    LaneShape<corners> shape[2];
    shape[0].template read<false>(pieces[0]);
    shape[1].template read<false>(pieces[1]);
    alignas(64) double facing[2][lanes], gap[lanes];
    const Pack least =
        simd::min(least_reach(shape[0], shape[1], facing[0]), least_reach(shape[1], shape[0], facing[1]));
    const unsigned apart_bits = simd::bits(least <= 0.0);
    simd::store(-least, gap);
    for (int lane = 0; lane < count; ++lane) {
      const std::uint32_t number = pairs_[begin + lane];
      const BodyPair& pair = batch.pairs[number];
      if ((apart_bits >> lane & 1) != 0) {
        PairReport& report = loads.pairs[number];
        report = {};
        report.gap = gap[lane];
        if constexpr (Law::frictional) report.slip_loss = stored_before(batch, pair);
        continue;
      }
      const auto start = [&](int p) {  // the corner before the side that faces the other
        const auto side = static_cast<std::uint32_t>(facing[p][lane]);
        return (side == 0 ? pieces[p].corners_in[lane] : side) - 1;
      };
      touching_[pair.master_share == 0.5].push_back(TouchingPair::seen(number, start(0), start(1)));
    }
  }

  /// How far `other` reaches behind the side it reaches least behind, `facing`; not at all: they are as far
  /// apart.
  static Pack least_reach(const LaneShape<corners>& shape, const LaneShape<corners>& other, double* facing) {
    Pack least = 1e300, side = 0.0;
    for (int k = 0; k < corners; ++k) {
      Pack deepest = shape.depth(k, other.at[0]);
      for (int j = 1; j < corners; ++j) deepest = simd::max(deepest, shape.depth(k, other.at[j]));
      const Mask less = simd::mask_of(shape.real[k]) & (deepest < least);
      least = simd::select(less, deepest, least);
      side = simd::select(less, static_cast<double>(k), side);
    }
    simd::store(side, facing);
    return least;
  }

  static double stored_before(const ContactBatch& batch, const BodyPair& pair) {
    double sum = 0;
    for (std::uint32_t i = 0; i < pair.contact_count; ++i)
      sum += batch.history[(pair.slot_start + i) * friction_doubles + 2];
    return sum;
  }

  template <class General>
  void evaluate_group(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                      const std::vector<TouchingPair>& touching, std::size_t begin, bool averaged,
                      const General& general) {
    LaneGroup& g = group_;
    g.collect(law, batch, &touching[begin],
              static_cast<int>(std::min<std::size_t>(lanes, touching.size() - begin)));
    // Quadrilaterals, which most blocks are, need no look at which lane has which side.
    if constexpr (corners == 4) {
      if (g.pieces[0].all_have(corners) && g.pieces[1].all_have(corners))
        return evaluate_group_of<true>(batch, loads, touching, begin, averaged, general);
    }
    evaluate_group_of<false>(batch, loads, touching, begin, averaged, general);
  }

  template <bool full, class General>
  void evaluate_group_of(const ContactBatch& batch, const ContactLoads& loads,
                         const std::vector<TouchingPair>& touching, std::size_t begin, bool averaged,
                         const General& general) {
    LaneGroup& g = group_;
    piece_[0].template read<full>(g.pieces[0]);
    piece_[1].template read<full>(g.pieces[1]);
    loads_.clear();

    const Pack share = averaged ? 0.5 : 1.0;
    roles_ = averaged ? 2 : 1;
    Mask refused = piece_[0].degenerate | piece_[1].degenerate;
    Pack area = 0.0;
    for (int role = 0; role < roles_; ++role) {
      cells_[role].template find<full>(piece_[role], piece_[1 - role], share * g.normal_stiffness);
      refused = refused | cells_[role].deep | !(cells_[role].area > 0.0);
      area = area + cells_[role].area;
      normal_loads(role);
    }
    find_tangent();
    Report report;
    report.stored = roles_ == 2 ? cells_[0].stored + cells_[1].stored : cells_[0].stored;
    report.penetration =
        roles_ == 2 ? simd::max(cells_[0].penetration, cells_[1].penetration) : cells_[0].penetration;
    normal_damping(g, share, batch.dt, report);
    if constexpr (Law::frictional) friction(g, batch, area, report);
    const unsigned refused_bits = simd::bits(refused) & ((1u << g.count) - 1);
    write<full>(loads, g, report, refused_bits);
    for (int lane = 0; refused_bits >> lane != 0; ++lane) {
      if ((refused_bits >> lane & 1) == 0) continue;
      if (touching[begin + lane].unseen()) {
        pairs_.push_back(g.pair[lane]);
      } else {
        general(g.pair[lane]);
      }
    }
  }

  /// Eqs. 28–36: on the master through the centroid of the cell, on the slave by the trapezoid rule.
  void normal_loads(int role) {
    const LaneCells<corners>& cells = cells_[role];
    const LanePiece<corners>&master = piece_[role], &slave = piece_[1 - role];
    for (int c = 0; c < cells.cell_count; ++c) {
      const LaneCell& cell = cells.cell[c];
      const Packs2 inward = Pack(-1.0) * master.normal(cell.side);
      const Pack at_end = cell.lever * cell.load;
      loads_.add(role, cell.side, cell.load - at_end, inward);
      loads_.add(role, cell.side + 1, at_end, inward);
    }
    for (int i = 0; i < cells.segment_start[cells.cell_count]; ++i) {
      const LaneSegment& at = cells.segment[i];
      const Packs2 inward = Pack(-1.0) * slave.normal(at.slave_side);
      const Pack end = at.start_load * at.start + at.end_load * at.end;
      loads_.add(1 - role, at.slave_side, at.start_load + at.end_load - end, inward);
      loads_.add(1 - role, at.slave_side + 1, end, inward);
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
    Pack longest = arc_size(cells_[0]);
    if (roles_ == 2) {
      const Pack other = simd::abs(simd::dot(cells_[1].arc, tangent_));
      contact_length_ = simd::select(other > contact_length_ + contact_length_, other, contact_length_);
      longest = simd::max(longest, arc_size(cells_[1]));
    }
    contact_length_ = simd::only_where(contact_length_ > 1e-9 * longest, contact_length_);
  }

  static Pack arc_size(const LaneCells<corners>& cells) {
    Pack size = 0.0;
    for (int i = 0; i < cells.segment_start[cells.cell_count]; ++i) size = size + cells.segment[i].length;
    return size;
  }

  struct Report {
    Pack stored, penetration, slip_loss = 0.0, damping_power = 0.0;
    Pack elastic = 0.0, applied = 0.0, spring_energy = 0.0, centre_x = 0.0, centre_y = 0.0, slip = 0.0;
    Pack tangential = 0.0;  ///< N/m along the tangent, on piece 1
  };

  /// A dashpot along the normal of each cell, never pulling.
  void normal_damping(const LaneGroup& g, Pack share, double dt, Report& report) {
    if (!simd::any(g.normal_damping > 0.0)) return;
    const Pack viscosity =
        simd::only_where(contact_length_ > 0.0,
                         share * 2.0 * g.normal_damping *
                             simd::sqrt(g.normal_stiffness * simd::load(g.reduced_mass) / contact_length_));
    for (int role = 0; role < roles_; ++role) {
      for (int c = 0; c < cells_[role].cell_count; ++c) damp_cell(role, c, viscosity, dt, report);
    }
  }

  void damp_cell(int role, int c, Pack viscosity, double dt, Report& report) {
    LaneCells<corners>& cells = cells_[role];
    const LanePiece<corners>&master = piece_[role], &slave = piece_[1 - role];
    const int k = cells.cell[c].side;
    const Packs2 normal = master.normal(k);
    const Pack master_start = simd::dot(normal, master.velocity[k]),
               master_change = simd::dot(normal, master.velocity[k + 1]) - master_start;
    Pack on_start = 0.0, on_end = 0.0, power = 0.0;
    for (int i = cells.segment_start[c]; i < cells.segment_start[c + 1]; ++i) {
      const LaneSegment& at = cells.segment[i];
      const int j = at.slave_side;
      const Pack facing = simd::max(0.0, -simd::dot(slave.normal(j), normal));
      const Pack slave_start = simd::dot(normal, slave.velocity[j]),
                 slave_change = simd::dot(normal, slave.velocity[j + 1]) - slave_start;
      const Pack rate0 =
          master_start + at.start_lever * master_change - slave_start - at.start * slave_change;
      const Pack rate1 = master_start + at.end_lever * master_change - slave_start - at.end * slave_change;
      const Pack scale = viscosity * facing * at.length * (1.0 / 6.0);
      const Pack force0 =
          simd::only_where(at.valid, simd::max(scale * (rate0 + rate0 + rate1), -facing * at.start_load));
      const Pack force1 =
          simd::only_where(at.valid, simd::max(scale * (rate1 + rate1 + rate0), -facing * at.end_load));
      const Pack both = force0 + force1, slave_end = force0 * at.start + force1 * at.end,
                 master_end = force0 * at.start_lever + force1 * at.end_lever;
      loads_.add(1 - role, j, both - slave_end, normal);
      loads_.add(1 - role, j + 1, slave_end, normal);
      on_start = on_start + both - master_end;
      on_end = on_end + master_end;
      power = power + simd::only_where(at.valid, force0 * rate0 + force1 * rate1);
    }
    loads_.add(role, k, -on_start, normal);
    loads_.add(role, k + 1, -on_end, normal);
    report.damping_power = report.damping_power + power * dt;
    cells.cell[c].load = simd::max(0.0, cells.cell[c].load + on_start + on_end);
  }

  /// Loads of a unit tangential force on piece 1: by the shares of the cells, on both pieces at one common
  /// point of each cell.
  void unit_tangential_loads(Pack load, LaneLoads<corners>& unit) const {
    unit.clear();
    const Pack inverse_load = simd::only_where(load > 0.0, 1.0 / load);
    for (int role = 0; role < roles_; ++role) {
      const LaneCells<corners>& cells = cells_[role];
      const LanePiece<corners>&master = piece_[role], &slave = piece_[1 - role];
      for (int c = 0; c < cells.cell_count; ++c) {
        const LaneCell& cell = cells.cell[c];
        const int k = cell.side;
        const Pack part = cell.load * inverse_load * (role == 0 ? 1.0 : -1.0);
        const Pack at_end = cell.lever * part;
        unit.add(role, k, at_end - part, tangent_);
        unit.add(role, k + 1, -at_end, tangent_);
        const Packs2 foot = master.at[k] + cell.lever * master.length[k] * master.tangent[k];
        const Pack scale = simd::only_where(cell.share > 0.0, part / cell.share);
        for (int i = cells.segment_start[c]; i < cells.segment_start[c + 1]; ++i)
          at_common_point(foot, scale * cells.segment[i].share, slave, cells.segment[i].slave_side, unit,
                          1 - role);
      }
    }
  }

  /// `size` along the tangent at `foot`, off the slave side: as forces on its ends.
  void at_common_point(Packs2 foot, Pack size, const LanePiece<corners>& slave, int side,
                       LaneLoads<corners>& unit, int piece) const {
    const Packs2 from = foot - slave.at[side], normal = slave.normal(side);
    const Pack part = size * slave.inverse_length[side];
    const Pack end = part * simd::dot(slave.tangent[side], from);
    const Pack across =
        part * simd::cross(slave.tangent[side], from) * simd::cross(Packs2{-normal.x, -normal.y}, tangent_);
    unit.at[piece][side] = unit.at[piece][side] + (size - end) * tangent_ + across * normal;
    unit.at[piece][side + 1] = unit.at[piece][side + 1] + end * tangent_ - across * normal;
  }

  /// Eqs. 37–44: the slip is that through which the tangential loads work.
  void friction(const LaneGroup& g, const ContactBatch& batch, Pack area, Report& report) {
    Pack load = 0.0;
    for (int role = 0; role < roles_; ++role) {
      for (int c = 0; c < cells_[role].cell_count; ++c) load = load + cells_[role].cell[c].load;
    }
    LaneLoads<corners> unit;
    unit_tangential_loads(load, unit);
    Pack slip = 0.0;
    for (int p = 0; p < 2; ++p) {
      for (int i = 0; i <= corners; ++i) slip = slip + simd::dot(unit.at[p][i], piece_[p].velocity[i]);
    }
    const Pack increment = slip * batch.dt;

    Pack old[4];
    simd::gather_rows(g.history, old);
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
      const Pack viscosity = 2.0 * g.tangential_damping * simd::sqrt(stiffness * simd::load(g.reduced_mass));
      const Pack damped = simd::clamp(elastic - viscosity * slip, -bound, bound);
      report.tangential = simd::select(holds & !slips & (g.tangential_damping > 0.0), damped, elastic);
      report.damping_power =
          report.damping_power + simd::max(0.0, -(report.tangential - elastic) * increment);
    }
    for (int p = 0; p < 2; ++p) {
      for (int i = 0; i <= corners; ++i)
        loads_.at[p][i] = loads_.at[p][i] + report.tangential * unit.at[p][i];
    }
    const Pack x = roles_ == 2 ? cells_[0].moment_x + cells_[1].moment_x : cells_[0].moment_x;
    const Pack y = roles_ == 2 ? cells_[0].moment_y + cells_[1].moment_y : cells_[0].moment_y;
    const Pack inverse = 1.0 / area;
    report.centre_x = x * inverse;
    report.centre_y = y * inverse;
  }

  /// What TouchingPair::remembered() reads.
  Pack remembered(const LaneGroup& g) const {
    Pack pattern = 0.0;
    for (int i = 0; i < cells_[0].segment_start[cells_[0].cell_count]; ++i) {
      const LaneSegment& at = cells_[0].segment[i];
      const auto bit = static_cast<double>(1u << (at.master_side % 4 * 4 + at.slave_side % 4));
      pattern = pattern + simd::only_where(at.valid, bit);
    }
    return TouchingPair::pattern_unit * pattern + simd::load(g.starts);
  }

  template <bool full>
  void write(const ContactLoads& loads, const LaneGroup& g, const Report& report, unsigned refused) {
    for (auto& piece : loads_.at) piece[0] = piece[0] + piece[corners];
    g.write_loads<corners, full>(loads, refused, loads_.at);
    double* report_row[lanes];
    double spare[lanes][8];
    for (int lane = 0; lane < lanes; ++lane) {
      const bool wanted = lane < g.count && (refused >> lane & 1) == 0;
      PairReport& to = loads.pairs[g.pair[lane]];
      report_row[lane] = wanted ? &to.penetration : spare[lane];
      if (!wanted) continue;
      to.contact_count = 1;
      to.gap = 0;
    }
    const Pack energies[4] = {report.penetration, report.stored, report.slip_loss, report.damping_power};
    simd::scatter_rows(energies, report_row);
    if constexpr (Law::frictional) {
      double *row[lanes], *second_row[lanes];
      for (int lane = 0; lane < lanes; ++lane) {
        const bool wanted = report_row[lane] != spare[lane];
        row[lane] = wanted ? loads.history + g.slot[lane] * friction_doubles : spare[lane];
        second_row[lane] = row[lane] + 4;
        if (wanted) row[lane][8] = 0;
      }
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
      const LanePiece<corners>& master = piece_[role];
      for (int c = 0; c < cells_[role].cell_count; ++c) {
        const LaneCell& cell = cells_[role].cell[c];
        const int k = cell.side;
        load = load + cell.load;
        moment = moment + cell.load * (master.at[k] + cell.lever * master.length[k] * master.tangent[k]);
        normal = normal + (role == 0 ? cell.load : -cell.load) * master.normal(k);
      }
    }
    const Pack side = simd::load(g.side), inverse = 1.0 / load;
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
      loads.reports[g.slot[lane]] = {value[0][lane], value[1][lane], value[2][lane], value[3][lane],
                                     value[4][lane], value[5][lane], value[6][lane], value[7][lane]};
    }
  }

  std::vector<std::uint32_t> pairs_;
  std::vector<TouchingPair> touching_[2];  ///< [both roles count half]
  std::vector<TouchingPair> sorted_;
  LaneGroup group_;
  LanePiece<corners> piece_[2];
  LaneCells<corners> cells_[2];
  LaneLoads<corners> loads_;
  int roles_ = 1;
  Packs2 tangent_;
  Pack contact_length_;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
