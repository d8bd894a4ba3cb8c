#pragma once

#include <talus/contact_model.hpp>
#include <talus/overlap/carried_history.hpp>
#include <talus/overlap/face_friction.hpp>
#include <talus/overlap/grouping.hpp>
#include <talus/overlap/lane_contact.hpp>
#include <talus/overlap/normal_dashpots.hpp>
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
    normal_.start(law, batch.interfaces, finder_.overlaps(), pair.a == pair.b);
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
    if (contact_.cells.empty()) {
      write_nothing(loads, pair, group, report);
      return;
    }
    measure(group, batch.dt);
    if (!several_faces_) cluster_length_ = contact_.length;
    dashpots_.press(contact_, sink, pair, cluster_length_, batch.dt, report);
    contact_.share_pressure();
    Point tangential{0, 0};
    double slip = 0;
    if constexpr (Law::frictional) {
      FrictionHistory& history = carried_[group];
      tangential =
          FaceFriction(contact_, law.rule(), batch, pair).act(sink, cluster_length_, history, report);
      slip = history.slip;
      if (group < pair.slot_capacity)
        write_history(history, loads.history + (pair.slot_start + group) * friction_doubles);
    }
    report.penetration = std::max(report.penetration, contact_.penetration());
    if (group < pair.slot_capacity && loads.reports != nullptr)
      loads.reports[pair.slot_start + group] = contact_.report(tangential, slip);
  }

  void take_cells(std::uint32_t group) {
    contact_.springs = {finder_.overlaps(), normal_.on_b, normal_.segments};
    if (!several_faces_) {
      contact_.cells.swap(normal_.cells);
      return;
    }
    contact_.cells.clear();
    for (const Cell& cell : normal_.cells) {
      if (cell.overlap->group == group) contact_.cells.push_back(cell);
    }
  }

  void measure(std::uint32_t group, double dt) {
    contact_.find_tangent(finder_.members(group));
    contact_.measure_arcs(finder_.members(group), !normal_.among_strips() && !several_faces_, dt);
  }

  /// The faces of a cluster have dashpots as one contact of all their length has, however often they bend.
  void measure_cluster(std::uint32_t first_group, std::uint32_t end, double dt) {
    cluster_length_ = 0;
    for (std::uint32_t g = first_group; g < end; ++g) {
      take_cells(g);
      if (contact_.cells.empty()) continue;
      measure(g, dt);
      cluster_length_ += contact_.length;
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

  std::vector<std::uint32_t> loose_;  ///< pairs that have no lane in a plan
  LaneContact<Law, 4> quadrilaterals_;
  LaneContact<Law, 8> octagons_;
  OverlapGroups finder_;
  NormalLoads<Law> normal_;
  FaceContact contact_;
  NormalDashpots dashpots_;
  CarriedHistory carried_;
  bool several_faces_ = false;  ///< whether the cluster at hand has more groups than one
  double cluster_length_ = 0;   ///< m, of all its faces
};

}  // namespace talus::overlap
