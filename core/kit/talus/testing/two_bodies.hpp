#pragma once

#include <talus/contact_model.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace talus::testing {

struct Vertex {
  double x, y;  ///< m
};

/// What a contact law made of two bodies.
struct Outcome {
  PairReport report{};
  std::vector<ContactReport> contacts;
  std::vector<Vertex> loads;    ///< N/m, at the corners of a, then of b
  Vertex on_b{0, 0};            ///< N/m, the resultant on body b
  Vertex net{0, 0};             ///< N/m, of both bodies together: zero
  double net_moment = 0;        ///< N, about the origin: zero
  std::vector<double> history;  ///< of t_n
};

/// Two convex bodies of one piece and one surface class, held against a contact law without a program around
/// it. The law's history goes on from one evaluation to the next.
class TwoBodies {
 public:
  double dt = 1e-4;            ///< s
  double master_share = 0.5;   ///< of body a: 0, 0.5 or 1
  double reduced_mass = 1000;  ///< kg per metre of thickness
  bool hold_stick = false, bonds_form = false;

  /// Vertices counter-clockwise.
  TwoBodies(const std::vector<Vertex>& a, const std::vector<Vertex>& b) : count_a_(a.size()) {
    for (const std::vector<Vertex>* body : {&a, &b}) {
      for (const Vertex& vertex : *body) corners_.push_back({vertex.x, vertex.y, 0, 0, 0, 0, 0, 0, 0});
      piece_start_.push_back(static_cast<std::uint32_t>(corners_.size()));
    }
    measure_sides(0, count_a_);
    measure_sides(count_a_, corners_.size());
  }

  /// Moves body b by a displacement that takes dt, so that its velocity is displacement/dt.
  void move_b(double dx, double dy) {
    for (std::size_t i = count_a_; i < corners_.size(); ++i) {
      corners_[i].x += dx, corners_[i].y += dy;
      corners_[i].vx = dx / dt, corners_[i].vy = dy / dt;
    }
  }

  /// `interface` in declared order and SI, as a scene gives it; the law prepares it.
  Outcome evaluate(const ContactModel& law, std::vector<double> interface) {
    law.prepare_interface(interface.data());
    const std::uint32_t doubles = law.doubles_per_contact(), row = 0, active = 0;
    const std::uint8_t strips[2] = {0, 0};
    const double clear_depth[2] = {0, 0};
    history_.resize(std::size_t{capacity} * doubles);
    BodyPair pair{};
    if (master_share != 0 && master_share != 0.5 && master_share != 1)
      throw std::invalid_argument("master_share of TwoBodies is none of 0, 0.5 and 1");
    pair.b = 1;
    pair.master_halves = static_cast<std::uint16_t>(2 * master_share);
    pair.reduced_mass = static_cast<float>(reduced_mass);
    pair.slot_capacity = capacity;
    pair.contact_count = contacts_;
    const std::uint32_t first_piece[2] = {0, 1};
    const Boundaries boundaries{corners_.data(), piece_start_.data(), strips, clear_depth, nullptr};
    describe_plain(pair, 0, 1, boundaries, row);
    const ContactBatch batch{boundaries,
                             {&row, interface.data(), 1, static_cast<std::uint32_t>(interface.size())},
                             &pair,
                             {nullptr, first_piece},
                             history_.data(),
                             &active,
                             1,
                             dt,
                             hold_stick,
                             bonds_form};
    // Nothing is zero before the call; what stays unwritten shows as not a number.
    std::vector<CornerLoad> load(corners_.size(), {NAN, NAN});
    std::vector<double> next(history_.size(), NAN);
    Outcome outcome;
    outcome.contacts.resize(capacity);
    law.evaluate(batch, {load.data(), next.data(), outcome.contacts.data(), &outcome.report});
    contacts_ = outcome.report.contact_count;
    if (contacts_ > capacity) throw std::runtime_error("more contacts than TwoBodies has room for");
    outcome.contacts.resize(contacts_);
    history_ = next;
    outcome.history.assign(next.begin(), next.begin() + std::size_t{contacts_} * doubles);
    outcome.loads.assign(corners_.size(), {0, 0});
    for (std::size_t i = 0; contacts_ > 0 && i < corners_.size(); ++i) {
      outcome.loads[i] = {load[i].x, load[i].y};
      outcome.net.x += load[i].x, outcome.net.y += load[i].y;
      outcome.net_moment += corners_[i].x * load[i].y - corners_[i].y * load[i].x;
      if (i >= count_a_) outcome.on_b.x += load[i].x, outcome.on_b.y += load[i].y;
    }
    return outcome;
  }

 private:
  static constexpr std::uint32_t capacity = 8;

  void measure_sides(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      BoundaryCorner& corner = corners_[i];
      const BoundaryCorner& next = corners_[i + 1 == end ? begin : i + 1];
      const double dx = next.x - corner.x, dy = next.y - corner.y;
      corner.length = std::sqrt(dx * dx + dy * dy);
      corner.tangent_x = corner.length > 0 ? dx / corner.length : 0;
      corner.tangent_y = corner.length > 0 ? dy / corner.length : 0;
    }
  }

  std::size_t count_a_;
  std::vector<BoundaryCorner> corners_;
  std::vector<std::uint32_t> piece_start_{0};
  std::vector<double> history_;
  std::uint32_t contacts_ = 0;
};

}  // namespace talus::testing
