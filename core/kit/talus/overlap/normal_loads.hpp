#pragma once

#include <talus/overlap/cells.hpp>
#include <talus/overlap/closing_loads.hpp>
#include <talus/overlap/pressure.hpp>
#include <talus/overlap/pressure_jumps.hpp>
#include <talus/overlap/strip_lines.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace talus::overlap {

/// What the springs of the overlaps of a pair press with, cluster by cluster.
template <class Law>
class NormalLoads {
 public:
  std::vector<Cell> cells;        ///< of the cluster at hand
  std::vector<Segment> segments;  ///< the same
  std::vector<Point> on_b;        ///< [overlap] N/m on body b

  /// Whether a body of the pair has many elements.
  bool among_strips() const { return among_strips_; }

  /// `one_body`: both bodies of the pair are the same.
  void start(const Law& law, const Interfaces& interfaces, std::span<const Overlap> overlaps, bool one_body) {
    on_b.assign(overlaps.size(), {0, 0});
    among_strips_ = overlaps[0].piece[0].is_strip() || overlaps[0].piece[1].is_strip();
    closing_.clear();
    lines_.start(one_body);
    beside_ = {};
    total_load_ = largest_side_ = 0;
    pressure_jumps_ = jumps_anywhere(law, interfaces, overlaps);
  }

  /// Loads both bodies, each as master as far as its role says.
  void press(const Law& law, const Interfaces& interfaces, const LoadSink& sink,
             const OverlapGroups& overlaps, std::uint32_t cluster, const BodyPair& pair, PairReport& report) {
    cells.clear();
    segments.clear();
    for (std::uint32_t master = 0; master < 2; ++master) {
      const double share = master == 0 ? pair.master_share() : 1 - pair.master_share();
      if (share > 0) press_in_role(law, interfaces, sink, overlaps, cluster, master, share, report);
    }
  }

  /// After the last cluster: a strip ends at division lines of its own, where its neighbour takes over, so
  /// that only all strips together are in balance. Returns what jumps of the pressure put on body b beside
  /// the loads of cells; nothing where that is rounding.
  Balance finish(const LoadSink& sink) {
    if (among_strips_) {
      lines_.close(sink, closing_);
      closing_.close(sink);
    }
    const double rounding = 1e-9 * total_load_;
    const bool some = length(beside_.force) > rounding || std::abs(beside_.moment) > rounding * largest_side_;
    return some ? beside_ : Balance{};
  }

 private:
  /// One overlap with one of the bodies as master.
  struct InRole {
    const Law& law;
    const Interfaces& interfaces;
    const LoadSink& sink;
    const Overlap& overlap;
    std::uint32_t member;  ///< its place among the overlaps
    std::uint32_t master_body;
    double share;  ///< of the load, for this role
    PairReport& report;

    const Piece& master() const { return overlap.piece[master_body]; }
    const Piece& slave() const { return overlap.piece[1 - master_body]; }
    std::uint32_t row(std::uint32_t side, std::uint32_t slave_side) const {
      return interfaces.row[master().surface(side) * interfaces.surface_count + slave().surface(slave_side)];
    }
    InterfaceParameters parameters(std::uint32_t interface_row) const {
      return law.interface(interfaces.value + interface_row * interfaces.parameter_count);
    }
  };

  void press_in_role(const Law& law, const Interfaces& interfaces, const LoadSink& sink,
                     const OverlapGroups& overlaps, std::uint32_t cluster, std::uint32_t master_body,
                     double share, PairReport& report) {
    const std::size_t first_cell = cells.size();
    if (!among_strips_) closing_.clear();
    std::uint32_t members = 0;
    for (const std::uint32_t member : overlaps.cluster_members(cluster)) {
      const InRole role{law,    interfaces,  sink,  overlaps.overlaps()[member],
                        member, master_body, share, report};
      ++members;
      divider_.divide(
          role.master(), master_body, role.overlap.polygon, [&](std::uint32_t side, const Polygon& cell) {
            if (pressure_jumps_ && jumps_under(law, interfaces, role.master(), side, role.slave()))
              press_parts(role, side, cell);
            else
              press_cell(role, side, cell, no_side);
          });
    }
    const auto differs = [&](const Cell& cell) {
      return cell.interface.normal_stiffness != cells[first_cell].interface.normal_stiffness;
    };
    const bool uniform =
        !HasOwnPressure<Law> &&
        std::none_of(cells.begin() + static_cast<std::ptrdiff_t>(first_cell), cells.end(), differs);
    if (!among_strips_ && (members > 1 || !uniform)) closing_.close(sink);
  }

  /// Part by part, as it is nearest to the sides of the slave: each has the pressure of its two sides.
  void press_parts(const InRole& role, std::uint32_t side, const Polygon& cell) {
    slave_divider_.divide(
        role.slave(), 1 - role.master_body, cell,
        [&](std::uint32_t slave_side, const Polygon& part) { press_cell(role, side, part, slave_side); });
  }

  /// Eqs. 28–36: the load on a master side is α_N times the area of its cell, through the centroid; on the
  /// slave the trapezoid rule on the sub-segments. Energy is Π = ∫ α_N g dA.
  /// `slave_side`: that by which the pressure goes, where it jumps under the master's.
  void press_cell(const InRole& role, std::uint32_t side, const Polygon& cell, std::uint32_t slave_side) {
    const Piece &master = role.master(), &slave = role.slave();
    const AreaCentroid region = &cell == &role.overlap.polygon ? role.overlap.region : area_centroid(cell);
    if (!(region.area > 0)) return;
    const auto first_segment = static_cast<std::uint32_t>(segments.size());
    const double deepest = find_segments(master, slave, side, 1 - role.master_body, cell);
    InterfaceParameters parameters = interface_of(role.law, role.interfaces, role.overlap, master, slave,
                                                  side, std::span(segments).subspan(first_segment));
    if (slave_side != no_side) go_by(role.parameters(role.row(side, slave_side)), parameters);
    const Point normal = master.normal(side);
    double load = 0;
    Point foot{0, 0};
    if constexpr (HasOwnPressure<Law>) {
      const CellPressure in_cell = integrate(role.law, parameters, master, side, cell);
      load = role.share * in_cell.load;
      role.report.stored += role.share * in_cell.energy;
      foot = in_cell.centre + master.depth(side, in_cell.centre) * normal;
    } else {
      load = role.share * parameters.normal_stiffness * region.area;
      const double depth = master.depth(side, region.centroid);
      role.report.stored += load * depth;
      foot = region.centroid + depth * normal;
    }
    on_b[role.member] = on_b[role.member] + (role.master_body == 0 ? load : -load) * normal;
    role.sink.on_side(master, side, master.lever(side, foot), -load * normal);
    closing_.add(foot, -load * normal);
    for (std::size_t s = first_segment; s < segments.size(); ++s) {
      find_slave_loads(role.law, parameters, role.share, segments[s]);
      load_slave(role.sink, slave, segments[s]);
    }
    for (InnerSegment& inner : inner_segments_) {
      find_slave_loads(role.law, parameters, role.share, inner.segment);
      bear(role, side, slave_side, inner);
    }
    total_load_ += load;
    largest_side_ = std::max(largest_side_, master.length(side));
    closing_.may_bear(role.master_body, {master, side, foot, load, true});
    closing_.may_bear(1 - role.master_body, {slave, bounding_side(role.overlap, slave), foot, load});
    // What a dashpot is measured by: the mean slope of the pressure.
    if constexpr (HasOwnPressure<Law>) parameters.normal_stiffness = load / (role.share * region.area);
    cells.push_back({&role.overlap, role.master_body, side, normal, foot, load, deepest, parameters,
                     first_segment, static_cast<std::uint32_t>(segments.size())});
  }

  /// The pressure is that of one interface, also where sides of others are in the cell.
  static void go_by(const InterfaceParameters& pressure, InterfaceParameters& mean) {
    if constexpr (HasOwnPressure<Law>)
      mean = pressure;
    else
      mean.normal_stiffness = pressure.normal_stiffness;
  }

  /// What presses on a line within a body. Cells count what their master bears: what it bears elsewhere
  /// presses on the other body, too.
  void bear(const InRole& role, std::uint32_t side, std::uint32_t slave_side, const InnerSegment& inner) {
    const Piece& piece = role.overlap.piece[inner.body];
    if (pressure_jumps_ && inner.between_sides) {
      Balance load;
      inner.add_to(load);
      const Point middle = 0.5 * (inner.segment.at[0] + inner.segment.at[1]);
      const LineSide own{&piece, inner.body == role.master_body ? side : slave_side};
      bear_line(role.sink, own, {&piece, inner.segment.side}, middle, load);
      closing_.add(middle, load.force, load.moment_about(middle));
    } else if (pressure_jumps_ && piece.is_strip()) {
      lines_.add(inner, piece);
    } else {
      for (int end = 0; end < 2; ++end)
        closing_.add_within(inner.body, inner.segment.at[end], inner.load(end));
    }
    if (inner.body != role.master_body) return;
    for (int end = 0; end < 2; ++end)
      beside_.add(inner.segment.at[end], (role.master_body == 1 ? 1.0 : -1.0) * inner.load(end));
  }

  /// Returns the depth of the deepest point, m.
  double find_segments(const Piece& master, const Piece& slave, std::uint32_t side, std::uint32_t slave_body,
                       const Polygon& cell) {
    inner_segments_.clear();
    double deepest = 0;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const SideLabel label = cell[i].side;
      const Point start = cell[i].at, end = cell[cell.next(i)].at;
      const double depth = master.depth(side, start);
      deepest = std::max(deepest, depth);
      const bool on_slave = label.body == slave_body && slave.real(label.index);
      if (!on_slave && label.body == 1 - slave_body && master.real(label.index)) continue;
      Segment segment{};
      segment.side = label.index;
      segment.at[0] = start;
      segment.at[1] = end;
      segment.depth[0] = std::max(0.0, depth);
      segment.depth[1] = std::max(0.0, master.depth(side, end));
      segment.length = length(end - start);
      if (on_slave) {
        segment.facing = std::max(0.0, -dot(slave.normal(segment.side), master.normal(side)));
        segments.push_back(segment);
      } else if (segment.length > 0) {
        const Point along = (1 / segment.length) * (end - start);
        const bool between = label.body >= between_sides;
        inner_segments_.push_back(
            {between ? label.body - between_sides : label.body, between, segment, {-along.y, along.x}});
      }
    }
    return deepest;
  }

  void load_slave(const LoadSink& sink, const Piece& slave, const Segment& segment) {
    const Point inward = -1.0 * slave.normal(segment.side);
    for (int end = 0; end < 2; ++end) {
      const Point force = segment.load[end] * inward;
      sink.on_side(slave, segment.side, slave.lever(segment.side, segment.at[end]), force);
      closing_.add(segment.at[end], force);
    }
  }

  static constexpr std::uint32_t no_side = -1;

  CellDivider divider_, slave_divider_;
  std::vector<InnerSegment> inner_segments_;  ///< of the cell at hand
  ClosingLoads closing_;
  StripLines lines_;  ///< where the pressure jumps
  Balance beside_;
  double total_load_ = 0, largest_side_ = 0;  ///< N/m and m, to tell beside_ from rounding
  bool among_strips_ = false, pressure_jumps_ = false;
};

}  // namespace talus::overlap
