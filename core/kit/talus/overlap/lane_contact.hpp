#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/cell_loads.hpp>
#include <talus/overlap/friction.hpp>
#include <talus/overlap/lane_cells.hpp>

#include <vector>

namespace talus::overlap {
inline namespace TALUS_SIMD_LEVEL {

/// The distributed law for many pairs of plain bodies at once, one pair in each lane: the same forces as
/// DistributedContact, without clipping polygons. A lane that it cannot serve it hands back.
template <class Law, int corners>
class LaneContact {
 public:
  /// Starts a batch.
  void clear() {
    pairs_.clear();
    one_sided_.clear();
    averaged_.clear();
  }
  void add(std::uint32_t pair) { pairs_.push_back(pair); }

  /// Calls general(pair) for the pairs that need the general path. Pairs are independent of each other, so
  /// which of them share a group cannot be seen in the result.
  template <class General>
  void evaluate(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
                const General& general) {
    for (std::size_t i = 0; i < pairs_.size(); i += lanes) sieve(batch, loads, i);
    for (std::size_t i = 0; i < one_sided_.size(); i += lanes)
      group(law, batch, loads, one_sided_, i, false, general);
    for (std::size_t i = 0; i < averaged_.size(); i += lanes)
      group(law, batch, loads, averaged_, i, true, general);
  }

 private:
  /// A pair whose pieces no side keeps apart. Corners are counted from the side that faces the other piece
  /// most, as side 1, so that the lanes of a group work on the same sides.
  struct Touching {
    std::uint32_t pair;
    std::int32_t start[2];
  };

  static LanePieces pieces_of(const ContactBatch& batch, const std::uint32_t* pair, int piece) {
    LanePieces result;
    for (int lane = 0; lane < lanes; ++lane) {
      const BodyPair& at = batch.pairs[pair[lane]];
      const PiecePair& pieces = batch.piece_pairs[at.piece_pair_start];
      result.set(lane, batch.boundaries, piece == 0 ? pieces.a : pieces.b, piece == 0 ? 0 : at.offset_x,
                 piece == 0 ? 0 : at.offset_y);
    }
    return result;
  }

  /// Leaves the pairs that overlap: those no side of which has the other piece outside.
  void sieve(const ContactBatch& batch, const ContactLoads& loads, std::size_t begin) {
    const int count = static_cast<int>(std::min<std::size_t>(lanes, pairs_.size() - begin));
    std::uint32_t pair[lanes];
    for (int lane = 0; lane < lanes; ++lane) pair[lane] = pairs_[begin + (lane < count ? lane : 0)];
    const LanePieces pieces[2] = {pieces_of(batch, pair, 0), pieces_of(batch, pair, 1)};
    LaneShape<corners> shape[2];
    shape[0].read(pieces[0]);
    shape[1].read(pieces[1]);
    alignas(64) double facing[2][lanes], gap[lanes];
    const Pack least =
        simd::min(least_reach(shape[0], shape[1], facing[0]), least_reach(shape[1], shape[0], facing[1]));
    const unsigned apart_bits = simd::bits(least <= 0.0);
    simd::store(-least, gap);
    for (int lane = 0; lane < count; ++lane) {
      const BodyPair& at = batch.pairs[pair[lane]];
      if ((apart_bits >> lane & 1) != 0) {
        PairReport& report = loads.pairs[pair[lane]];
        report = {};
        report.gap = gap[lane];
        if constexpr (Law::frictional) report.slip_loss = stored_before(batch, at);
        continue;
      }
      Touching touching{pair[lane], {0, 0}};
      for (int p = 0; p < 2; ++p) {
        const auto side = static_cast<std::int32_t>(facing[p][lane]);
        touching.start[p] = side == 0 ? pieces[p].size[lane] - 1 : side - 1;
      }
      (at.master_share == 0.5 ? averaged_ : one_sided_).push_back(touching);
    }
  }

  /// How far `other` reaches behind the side it reaches least behind, `facing`; not at all: they are as far
  /// apart.
  static Pack least_reach(const LaneShape<corners>& shape, const LaneShape<corners>& other, double* facing) {
    Pack least = 1e300, side = 0.0;
    for (int k = 0; k < corners; ++k) {
      Pack deepest = shape.depth(k, other.at[0]);
      for (int j = 1; j < corners; ++j) deepest = simd::max(deepest, shape.depth(k, other.at[j]));
      const Mask less = shape.real[k] & (deepest < least);
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

  /// What a group knows of its pairs. Piece 0 is the master, where only one is.
  struct Group {
    std::uint32_t pair[lanes];
    int count;
    bool swapped[lanes];  ///< piece 0 is that of body b
    LanePieces pieces[2];
    alignas(64) double parameter[5][lanes], reduced_mass[lanes], side[lanes];
    const double* history[lanes];  ///< of the previous step, or zeros
  };
  static constexpr double none[4] = {0, 0, 0, 0};

  template <class General>
  void group(const Law& law, const ContactBatch& batch, const ContactLoads& loads,
             const std::vector<Touching>& touching, std::size_t begin, bool averaged,
             const General& general) {
    Group g;
    g.count = static_cast<int>(std::min<std::size_t>(lanes, touching.size() - begin));
    collect(law, batch, &touching[begin], g);
    piece_[0].read(g.pieces[0]);
    piece_[1].read(g.pieces[1]);
    loads_.clear();

    const Pack share = averaged ? 0.5 : 1.0, alpha = simd::load(g.parameter[0]);
    roles_ = averaged ? 2 : 1;
    Mask refused = piece_[0].degenerate | piece_[1].degenerate;
    Pack area = 0.0;
    for (int role = 0; role < roles_; ++role) {
      cells_[role].find(piece_[role], piece_[1 - role], share * alpha);
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
    write(batch, loads, g, report, simd::bits(refused), general);
  }

  void collect(const Law& law, const ContactBatch& batch, const Touching* touching, Group& g) const {
    for (int lane = 0; lane < lanes; ++lane) g.pair[lane] = touching[lane < g.count ? lane : 0].pair;
    const LanePieces a = pieces_of(batch, g.pair, 0), b = pieces_of(batch, g.pair, 1);
    for (int lane = 0; lane < lanes; ++lane) {
      const Touching& touch = touching[lane < g.count ? lane : 0];
      const BodyPair& pair = batch.pairs[touch.pair];
      g.swapped[lane] = pair.master_share == 0;
      g.side[lane] = g.swapped[lane] ? -1 : 1;
      for (int p = 0; p < 2; ++p) {
        const int from = g.swapped[lane] ? 1 - p : p;
        const LanePieces& source = from == 0 ? a : b;
        LanePieces& to = g.pieces[p];
        to.first[lane] = source.first[lane];
        to.size[lane] = source.size[lane];
        to.start[lane] = touch.start[from];
        to.offset_x[lane] = source.offset_x[lane];
        to.offset_y[lane] = source.offset_y[lane];
        to.clear_depth[lane] = source.clear_depth[lane];
      }
      const Interfaces& interfaces = batch.interfaces;
      const std::uint32_t row =
          interfaces.row[a.first[lane]->surface * interfaces.surface_count + b.first[lane]->surface];
      const InterfaceParameters parameters =
          law.interface(interfaces.value + row * interfaces.parameter_count);
      g.parameter[0][lane] = parameters.normal_stiffness;
      g.parameter[1][lane] = parameters.tangential_stiffness;
      g.parameter[2][lane] = parameters.friction;
      g.parameter[3][lane] = parameters.normal_damping;
      g.parameter[4][lane] = parameters.tangential_damping;
      g.reduced_mass[lane] = pair.reduced_mass;
      g.history[lane] = pair.contact_count == 0 ? none : batch.history + pair.slot_start * friction_doubles;
    }
  }

  /// Eqs. 28–36: on the master through the centroid of the cell, on the slave by the trapezoid rule.
  void normal_loads(int role) {
    const LaneCells<corners>& cells = cells_[role];
    const LanePiece<corners>&master = piece_[role], &slave = piece_[1 - role];
    Pack at_start[corners] = {}, at_end[corners] = {};
    bool loaded[corners] = {};
    for (int k = 0; k < corners; ++k) {
      if (!cells.side_used[k]) continue;
      const Packs2 inward = Pack(-1.0) * master.normal(k);
      loads_.add(role, k, (1.0 - cells.lever[k]) * cells.load[k], inward);
      loads_.add(role, k + 1, cells.lever[k] * cells.load[k], inward);
      for (int j = 0; j < corners; ++j) {
        if (!cells.used[k][j]) continue;
        const LaneSegment& at = cells.segment[k][j];
        const Pack end = at.start_load * at.start + at.end_load * at.end;
        const Pack start = at.start_load + at.end_load - end;
        at_start[j] = at_start[j] + start;
        at_end[j] = at_end[j] + end;
        loaded[j] = true;
      }
    }
    for (int j = 0; j < corners; ++j) {
      if (!loaded[j]) continue;
      const Packs2 inward = Pack(-1.0) * slave.normal(j);
      loads_.add(1 - role, j, at_start[j], inward);
      loads_.add(1 - role, j + 1, at_end[j], inward);
    }
  }

  /// §3.2.2: n_c is the direction of the resultant, s_c is perpendicular to it. Of the arcs, which share
  /// their ends, one tells the contact length.
  void find_tangent() {
    force_ = roles_ == 2 ? cells_[0].force - cells_[1].force : cells_[0].force;
    const Pack size = simd::sqrt(simd::dot(force_, force_));
    tangent_ = {-force_.y / size, force_.x / size};
    contact_length_ = simd::abs(simd::dot(cells_[0].arc, tangent_));
  }

  struct Report {
    Pack stored, penetration, slip_loss = 0.0, damping_power = 0.0;
    Pack elastic = 0.0, applied = 0.0, spring_energy = 0.0, centre_x = 0.0, centre_y = 0.0, slip = 0.0;
    Pack tangential = 0.0;  ///< N/m along the tangent, on piece 1
  };

  /// A dashpot along the normal of each cell, never pulling.
  void normal_damping(const Group& g, Pack share, double dt, Report& report) {
    const Pack ratio = simd::load(g.parameter[3]);
    if (!simd::any(ratio > 0.0)) return;
    const Pack viscosity = simd::only_where(
        contact_length_ > 0.0,
        share * 2.0 * ratio *
            simd::sqrt(simd::load(g.parameter[0]) * simd::load(g.reduced_mass) / contact_length_));
    for (int role = 0; role < roles_; ++role) {
      LaneCells<corners>& cells = cells_[role];
      for (int k = 0; k < corners; ++k) {
        if (cells.side_used[k]) damp_cell(role, k, viscosity, dt, report);
      }
    }
  }

  void damp_cell(int role, int k, Pack viscosity, double dt, Report& report) {
    LaneCells<corners>& cells = cells_[role];
    const LanePiece<corners>&master = piece_[role], &slave = piece_[1 - role];
    const Packs2 normal = master.normal(k);
    const Pack master_start = simd::dot(normal, master.velocity[k]),
               master_change = simd::dot(normal, master.velocity[k + 1]) - master_start;
    Pack on_start = 0.0, on_end = 0.0, power = 0.0;
    for (int j = 0; j < corners; ++j) {
      if (!cells.used[k][j]) continue;
      const LaneSegment& at = cells.segment[k][j];
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
    cells.load[k] = simd::max(0.0, cells.load[k] + on_start + on_end);
  }

  /// Loads of a unit tangential force on piece 1: by the shares of the cells, on both pieces at one common
  /// point of each cell.
  void unit_tangential_loads(Pack load, LaneLoads<corners>& unit) const {
    unit.clear();
    for (int role = 0; role < roles_; ++role) {
      const LaneCells<corners>& cells = cells_[role];
      const LanePiece<corners>&master = piece_[role], &slave = piece_[1 - role];
      Pack force[corners] = {}, at_end[corners] = {}, couple[corners] = {};
      bool loaded[corners] = {};
      for (int k = 0; k < corners; ++k) {
        if (!cells.side_used[k]) continue;
        const Pack lever = cells.lever[k];
        const Pack part = simd::only_where(load > 0.0, cells.load[k] / load) * (role == 0 ? 1.0 : -1.0);
        unit.add(role, k, -(1.0 - lever) * part, tangent_);
        unit.add(role, k + 1, -lever * part, tangent_);
        const Packs2 foot = master.at[k] + lever * master.length[k] * master.tangent[k];
        for (int j = 0; j < corners; ++j) {
          if (!cells.used[k][j]) continue;
          const Pack here =
              simd::only_where(cells.share[k] > 0.0, part * cells.segment[k][j].share / cells.share[k]);
          const Packs2 from = foot - slave.at[j];
          const Pack end = here * simd::dot(slave.tangent[j], from) * slave.inverse_length[j];
          const Pack turn = here * simd::cross(slave.tangent[j], from);
          force[j] = force[j] + here;
          at_end[j] = at_end[j] + end;
          couple[j] = couple[j] + turn;
          loaded[j] = true;
        }
      }
      for (int j = 0; j < corners; ++j) {
        if (!loaded[j]) continue;
        const Packs2 normal = slave.normal(j);
        const Pack across =
            couple[j] * simd::cross(Packs2{-normal.x, -normal.y}, tangent_) * slave.inverse_length[j];
        unit.add(1 - role, j, force[j] - at_end[j], tangent_);
        unit.add(1 - role, j, across, normal);
        unit.add(1 - role, j + 1, at_end[j], tangent_);
        unit.add(1 - role, j + 1, -across, normal);
      }
    }
  }

  /// Eqs. 37–44: the slip is that through which the tangential loads work.
  void friction(const Group& g, const ContactBatch& batch, Pack area, Report& report) {
    Pack load = 0.0;
    for (int role = 0; role < roles_; ++role) {
      for (int k = 0; k < corners; ++k) {
        if (cells_[role].side_used[k]) load = load + cells_[role].load[k];
      }
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
    const Pack limit = simd::load(g.parameter[2]) * load;
    const Mask holds = (limit > 0.0) & (contact_length_ > 0.0);
    const Pack bound = batch.hold_stick ? Pack(1e300) : limit;
    const Pack stiffness = simd::load(g.parameter[1]) * contact_length_;
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

    const Pack ratio = simd::load(g.parameter[4]);
    const Pack viscosity = 2.0 * ratio * simd::sqrt(stiffness * simd::load(g.reduced_mass));
    const Pack damped = simd::clamp(elastic - viscosity * slip, -bound, bound);
    report.tangential = simd::select(holds & !slips & (ratio > 0.0), damped, elastic);
    report.damping_power = report.damping_power + simd::max(0.0, -(report.tangential - elastic) * increment);
    for (int p = 0; p < 2; ++p) {
      for (int i = 0; i <= corners; ++i)
        loads_.at[p][i] = loads_.at[p][i] + report.tangential * unit.at[p][i];
    }
    const Pack x = roles_ == 2 ? cells_[0].moment_x + cells_[1].moment_x : cells_[0].moment_x;
    const Pack y = roles_ == 2 ? cells_[0].moment_y + cells_[1].moment_y : cells_[0].moment_y;
    report.centre_x = x / area;
    report.centre_y = y / area;
  }

  template <class General>
  void write(const ContactBatch& batch, const ContactLoads& loads, const Group& g, const Report& report,
             unsigned refused, const General& general) {
    alignas(64) double x[2][corners][lanes], y[2][corners][lanes];
    for (int p = 0; p < 2; ++p) {
      loads_.at[p][0] = loads_.at[p][0] + loads_.at[p][corners];
      for (int i = 0; i < corners; ++i) {
        simd::store(loads_.at[p][i].x, x[p][i]);
        simd::store(loads_.at[p][i].y, y[p][i]);
      }
    }
    fold_short_pieces(g, x, y);
    alignas(64) double energy[4][lanes];
    simd::store(report.stored, energy[0]);
    simd::store(report.penetration, energy[1]);
    simd::store(report.slip_loss, energy[2]);
    simd::store(report.damping_power, energy[3]);
    alignas(64) double history[7][lanes];
    if constexpr (Law::frictional) {
      simd::store(report.elastic, history[0]);
      simd::store(report.applied, history[1]);
      simd::store(report.spring_energy, history[2]);
      simd::store(contact_length_, history[3]);
      simd::store(report.centre_x, history[4]);
      simd::store(report.centre_y, history[5]);
      simd::store(report.slip, history[6]);
    }
    for (int lane = 0; lane < g.count; ++lane) {
      if ((refused >> lane & 1) != 0) {
        general(g.pair[lane]);
        continue;
      }
      const BodyPair& pair = batch.pairs[g.pair[lane]];
      double *fx = loads.fx + batch.piece_pairs[pair.piece_pair_start].load_start,
             *fy = loads.fy + batch.piece_pairs[pair.piece_pair_start].load_start;
      for (int body = 0; body < 2; ++body) {
        const int p = g.swapped[lane] ? 1 - body : body;
        const std::int32_t size = g.pieces[p].size[lane];
        std::int32_t corner = g.pieces[p].start[lane];
        for (std::int32_t i = 0; i < size; ++i) {
          fx[corner] = x[p][i][lane];
          fy[corner] = y[p][i][lane];
          if (++corner == size) corner = 0;
        }
        fx += size;
        fy += size;
      }
      loads.pairs[g.pair[lane]] = {1, energy[1][lane], energy[0][lane], energy[2][lane], energy[3][lane], 0};
      if constexpr (Law::frictional) {
        double* to = loads.history + pair.slot_start * friction_doubles;
        for (unsigned i = 0; i < 7; ++i) to[i] = history[i][lane];
        to[7] = to[8] = 0;
      }
    }
    if (loads.reports != nullptr) write_contacts(batch, loads, g, report, refused);
  }

  /// Load that came to the repeated first corner of a piece with fewer corners.
  static void fold_short_pieces(const Group& g, double (&x)[2][corners][lanes],
                                double (&y)[2][corners][lanes]) {
    for (int p = 0; p < 2; ++p) {
      for (int lane = 0; lane < g.count; ++lane) {
        for (std::int32_t i = g.pieces[p].size[lane]; i < corners; ++i) {
          x[p][0][lane] += x[p][i][lane];
          y[p][0][lane] += y[p][i][lane];
        }
      }
    }
  }

  void write_contacts(const ContactBatch& batch, const ContactLoads& loads, const Group& g,
                      const Report& report, unsigned refused) const {
    Pack load = 0.0;
    Packs2 moment{0.0, 0.0}, normal{0.0, 0.0};
    for (int role = 0; role < roles_; ++role) {
      const LaneCells<corners>& cells = cells_[role];
      for (int k = 0; k < corners; ++k) {
        if (!cells.side_used[k]) continue;
        load = load + cells.load[k];
        moment = moment + cells.load[k] * (piece_[role].at[k] +
                                           cells.lever[k] * piece_[role].length[k] * piece_[role].tangent[k]);
        normal = normal + (role == 0 ? cells.load[k] : -cells.load[k]) * piece_[role].normal(k);
      }
    }
    const Pack side = simd::load(g.side), inverse = 1.0 / load;
    alignas(64) double value[8][lanes];
    simd::store(moment.x * inverse, value[0]);
    simd::store(moment.y * inverse, value[1]);
    simd::store(side * normal.x, value[2]);
    simd::store(side * normal.y, value[3]);
    simd::store(side * report.tangential * tangent_.x, value[4]);
    simd::store(side * report.tangential * tangent_.y, value[5]);
    simd::store(report.penetration, value[6]);
    simd::store(simd::abs(report.slip), value[7]);
    for (int lane = 0; lane < g.count; ++lane) {
      if ((refused >> lane & 1) != 0) continue;
      loads.reports[batch.pairs[g.pair[lane]].slot_start] = {value[0][lane], value[1][lane], value[2][lane],
                                                             value[3][lane], value[4][lane], value[5][lane],
                                                             value[6][lane], value[7][lane]};
    }
  }

  std::vector<std::uint32_t> pairs_;
  std::vector<Touching> one_sided_, averaged_;
  LanePiece<corners> piece_[2];
  LaneCells<corners> cells_[2];
  LaneLoads<corners> loads_;
  int roles_ = 1;
  Packs2 force_, tangent_;
  Pack contact_length_;
};

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::overlap
