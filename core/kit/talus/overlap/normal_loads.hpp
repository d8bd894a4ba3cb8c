#pragma once

#include <talus/overlap/cells.hpp>
#include <talus/overlap/closing_loads.hpp>
#include <talus/overlap/pressure.hpp>
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
    pressure_jumps_ = among_strips_ && interfaces.surface_count > 1 && differs(law, interfaces, overlaps);
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
  /// Eqs. 28–36: the load on a master side is α_N times the area of its cell, through the centroid; on the
  /// slave the trapezoid rule on the sub-segments. Energy is Π = ∫ α_N g dA.
  void press_in_role(const Law& law, const Interfaces& interfaces, const LoadSink& sink,
                     const OverlapGroups& overlaps, std::uint32_t cluster, std::uint32_t master_body,
                     double share, PairReport& report) {
    const std::size_t first_cell = cells.size();
    if (!among_strips_) closing_.clear();
    bool uniform = !HasOwnPressure<Law>;
    std::uint32_t members = 0;
    for (const std::uint32_t member : overlaps.cluster_members(cluster)) {
      const Overlap& overlap = overlaps.overlaps()[member];
      ++members;
      const Piece& master = overlap.piece[master_body];
      const Piece& slave = overlap.piece[1 - master_body];
      divider_.divide(master, overlap.polygon, [&](std::uint32_t side, const Polygon& cell) {
        const AreaCentroid region = &cell == &overlap.polygon ? overlap.region : area_centroid(cell);
        if (!(region.area > 0)) return;
        const auto first_segment = static_cast<std::uint32_t>(segments.size());
        const double deepest = find_segments(master, slave, side, 1 - master_body, cell);
        InterfaceParameters parameters = interface_of(law, interfaces, overlap, master, slave, side,
                                                      std::span(segments).subspan(first_segment));
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
        on_b[member] = on_b[member] + (master_body == 0 ? load : -load) * normal;
        sink.on_side(master, side, master.lever(side, foot), -load * normal);
        closing_.add(foot, -load * normal);
        for (std::size_t s = first_segment; s < segments.size(); ++s) {
          find_slave_loads(law, parameters, share, segments[s]);
          load_slave(sink, slave, segments[s]);
        }
        for (InnerSegment& inner : inner_segments_) {
          find_slave_loads(law, parameters, share, inner.segment);
          const bool between_strips = pressure_jumps_ && overlap.piece[inner.body].is_strip();
          if (between_strips) lines_.add(inner, overlap.piece[inner.body]);
          for (int end = 0; end < 2; ++end) {
            const Point at = inner.segment.at[end], force = inner.segment.load[end] * inner.inward;
            if (!between_strips) closing_.add_within(inner.body, at, force);
            // Cells count what their master bears: what it bears elsewhere presses on the other body, too.
            if (inner.body == master_body) beside_.add(at, (master_body == 1 ? 1.0 : -1.0) * force);
          }
        }
        total_load_ += load;
        largest_side_ = std::max(largest_side_, master.length(side));
        closing_.may_bear(master_body, {master, side, foot, load, true});
        closing_.may_bear(1 - master_body, {slave, bounding_side(overlap, slave), foot, load});
        // What a dashpot is measured by: the mean slope of the pressure.
        if constexpr (HasOwnPressure<Law>) parameters.normal_stiffness = load / (share * region.area);
        if (cells.size() > first_cell) {
          uniform = uniform && cells[first_cell].interface.normal_stiffness == parameters.normal_stiffness;
        }
        cells.push_back({&overlap, master_body, side, normal, foot, load, deepest, parameters, first_segment,
                         static_cast<std::uint32_t>(segments.size())});
      });
    }
    if (!among_strips_ && (members > 1 || !uniform)) closing_.close(sink);
  }

  /// Whether the pressure goes by something else in some overlaps than in others.
  static bool differs(const Law& law, const Interfaces& interfaces, std::span<const Overlap> overlaps) {
    constexpr std::uint32_t none = -1;
    std::uint32_t first = none;
    double stiffness = 0;
    const auto is_other = [&](std::uint32_t row) {
      if (row == first) return false;
      const double own = law.interface(interfaces.value + row * interfaces.parameter_count).normal_stiffness;
      if (first == none) first = row, stiffness = own;
      return row != first && (HasOwnPressure<Law> || own != stiffness);
    };
    for (const Overlap& overlap : overlaps) {
      const Piece &a = overlap.piece[0], &b = overlap.piece[1];
      for (std::uint32_t i = 0; i < a.size(); ++i) {
        for (std::uint32_t j = 0; j < b.size() && a.real(i); ++j) {
          if (b.real(j) && is_other(interfaces.row[a.surface(i) * interfaces.surface_count + b.surface(j)]))
            return true;
        }
      }
    }
    return false;
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
        inner_segments_.push_back(
            {label.body > 1 ? 1 - slave_body : label.body, segment, {-along.y, along.x}});
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

  CellDivider divider_;
  std::vector<InnerSegment> inner_segments_;  ///< of the cell at hand
  ClosingLoads closing_;
  StripLines lines_;  ///< where the pressure jumps
  Balance beside_;
  double total_load_ = 0, largest_side_ = 0;  ///< N/m and m, to tell beside_ from rounding
  bool among_strips_ = false, pressure_jumps_ = false;
};

}  // namespace talus::overlap
