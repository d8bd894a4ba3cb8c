#include "contact/contact_stage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

/// Skin as a share of the mean width of the moving bodies: at the speeds of the shipped scenes a search
/// serves some 20 to 100 steps, and few pairs are candidates that do not touch.
constexpr double skin_share = 0.1;
constexpr std::uint32_t first_capacity = 2;     ///< contacts of a new pair before room must be made
constexpr std::uint32_t pairs_per_thread = 64;  ///< fewer than this many pairs are not worth a second thread

void noop(void* /*object*/) noexcept {}

}  // namespace

ContactStage::ContactStage(const Scene& scene, const Model& model, int threads, bool neighbour_skin)
    : law_(nullptr, noop),
      threads_(threads),
      skin_(neighbour_skin ? skin_share * model.mean_width : 0),
      search_(model) {
  for (const Body& body : model.bodies) fixed_.push_back(body.kinematics == Kinematics::fixed);
  if (scene.contact.component == nullptr) return;
  law_ = make<ContactModel>(*scene.contact.component, scene.contact.values);
  history_doubles_ = law_->doubles_per_contact();
  interfaces_ = {scene.interface_row.data(), nullptr, static_cast<std::uint32_t>(scene.surfaces.size()),
                 scene.contact.component->component->interface_parameter_count};
  set_interfaces(scene.interface_values);
  if (scene.roles_by_priority) {
    for (const SceneBody& body : scene.bodies) priority_.push_back(body.priority);
  }
}

void ContactStage::set_interfaces(const std::vector<std::vector<double>>& values) {
  if (!law_) return;
  former_interface_values_.swap(interface_values_);
  interface_values_.clear();
  for (std::vector<double> row : values) {
    law_->prepare_interface(row.data());
    interface_values_.insert(interface_values_.end(), row.begin(), row.end());
  }
  interfaces_.value = interface_values_.data();
}

/// A fixed body is master; between moving bodies both roles count half, or a declared priority decides.
double ContactStage::master_share(std::uint32_t a, std::uint32_t b) const {
  if (fixed_[a]) return 1;
  if (fixed_[b]) return 0;
  if (priority_.empty() || priority_[a] == priority_[b]) return 0.5;
  return priority_[a] > priority_[b] ? 1 : 0;
}

void ContactStage::find_pairs(const Model& model, const MotionState& motion, double travelled) {
  if (!law_) return;
  // Both bodies of a pair may have moved; the boxes leave skin/2 to each.
  slack_ -= travelled;
  if (slack_ > 0) return;
  search_.find(model, motion, skin_, candidates_);
  rebuild_pairs(model);
  slack_ = skin_ / 2;
  ++searches_;
}

void ContactStage::rebuild_pairs(const Model& model) {
  old_pairs_.swap(pairs_);
  old_damping_power_.swap(damping_power_);
  pairs_.clear();
  piece_pairs_.clear();
  std::uint32_t loads = 0;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& candidate = candidates_[i];
    if (pairs_.empty() || pairs_.back().a != candidate.body_a || pairs_.back().b != candidate.body_b) {
      const Body &a = model.bodies[candidate.body_a], &b = model.bodies[candidate.body_b];
      const double reduced_mass = fixed_[candidate.body_a] ? b.contact_mass
                                  : fixed_[candidate.body_b]
                                      ? a.contact_mass
                                      : a.contact_mass * b.contact_mass / (a.contact_mass + b.contact_mass);
      const auto first = static_cast<std::uint32_t>(piece_pairs_.size());
      pairs_.push_back({candidate.body_a, candidate.body_b, first, first, b.centre.x - a.centre.x,
                        b.centre.y - a.centre.y, master_share(candidate.body_a, candidate.body_b),
                        reduced_mass, 0, 0, 0});
    }
    piece_pairs_.push_back({candidate.piece_a, candidate.piece_b, loads});
    pairs_.back().piece_pair_end = static_cast<std::uint32_t>(piece_pairs_.size());
    loads += model.piece_start[candidate.piece_a + 1] - model.piece_start[candidate.piece_a];
    loads += model.piece_start[candidate.piece_b + 1] - model.piece_start[candidate.piece_b];
  }
  load_x_.resize(loads);
  load_y_.resize(loads);
  pair_reports_.resize(pairs_.size());

  // History goes with its pair: both lists are sorted by bodies.
  damping_power_.assign(pairs_.size(), 0.0);
  capacities_.assign(pairs_.size(), first_capacity);
  std::size_t old = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto before = [&](const BodyPair& p) {
      return std::pair{p.a, p.b} < std::pair{pairs_[i].a, pairs_[i].b};
    };
    while (old < old_pairs_.size() && before(old_pairs_[old])) ++old;
    if (old == old_pairs_.size() || old_pairs_[old].a != pairs_[i].a || old_pairs_[old].b != pairs_[i].b)
      continue;
    pairs_[i].slot_start = old_pairs_[old].slot_start;
    pairs_[i].contact_count = old_pairs_[old].contact_count;
    capacities_[i] = old_pairs_[old].slot_capacity;
    damping_power_[i] = old_damping_power_[old];
  }
  lay_out_slots(capacities_);
}

/// Gives every pair its contact slots, one pair after the other, and moves its history there.
void ContactStage::lay_out_slots(std::span<const std::uint32_t> capacities) {
  std::uint32_t slots = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) slots += capacities[i];
  next_history_.resize(std::size_t{slots} * history_doubles_);
  std::uint32_t start = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    BodyPair& pair = pairs_[i];
    const std::size_t count = std::size_t{pair.contact_count} * history_doubles_;
    const double* from = history_.data() + std::size_t{pair.slot_start} * history_doubles_;
    std::copy(from, from + count, next_history_.data() + std::size_t{start} * history_doubles_);
    pair.slot_start = start;
    pair.slot_capacity = capacities[i];
    start += capacities[i];
  }
  history_.swap(next_history_);
  next_history_.resize(history_.size());
  reports_.resize(slots);
}

ContactTotals ContactStage::evaluate(const Model& model, MotionState& motion, const Conditions& conditions) {
  if (!law_ || pairs_.empty()) return {};
  call_law(model, motion, conditions);
  while (make_room()) call_law(model, motion, conditions);
  history_.swap(next_history_);
  return gather(model, motion);
}

double ContactStage::with_former_interfaces(const Model& model, const MotionState& motion,
                                            const Conditions& conditions) {
  if (!law_ || pairs_.empty()) return 0;
  interfaces_.value = former_interface_values_.data();
  call_law(model, motion, conditions);
  interfaces_.value = interface_values_.data();
  double sum = 0;
  for (const PairReport& report : pair_reports_) sum += report.stored + report.slip_loss;
  return sum;
}

void ContactStage::call_law(const Model& model, const MotionState& motion, const Conditions& conditions) {
#ifdef TALUS_AUDIT
  std::fill(next_history_.begin(), next_history_.end(), std::numeric_limits<double>::quiet_NaN());
#endif
  std::fill(load_x_.begin(), load_x_.end(), 0.0);
  std::fill(load_y_.begin(), load_y_.end(), 0.0);
  std::fill(pair_reports_.begin(), pair_reports_.end(), PairReport{});
  const Boundaries boundaries{motion.x.data(),          motion.y.data(),         motion.vx.data(),
                              motion.vy.data(),         motion.tangent_x.data(), motion.tangent_y.data(),
                              motion.length.data(),     model.surface.data(),    model.cut.data(),
                              model.piece_start.data(), model.is_strip.data()};
  const auto evaluate_range = [&](std::size_t begin, std::size_t end) {
    if (begin == end) return;
    const ContactBatch batch{
        boundaries,          interfaces_,           pairs_.data() + begin,
        piece_pairs_.data(), history_.data(),       static_cast<std::uint32_t>(end - begin),
        conditions.dt,       conditions.hold_stick, conditions.bonds_form};
    law_->evaluate(batch, {load_x_.data(), load_y_.data(), next_history_.data(), reports_.data(),
                           pair_reports_.data() + begin});
  };
  const std::size_t count = pairs_.size();
  if (threads_ == 1 || count < 2 * pairs_per_thread) {
    evaluate_range(0, count);
    return;
  }
  const std::size_t ranges =
      std::min<std::size_t>(static_cast<std::size_t>(threads_), count / pairs_per_thread);
#pragma omp parallel for num_threads(static_cast <int>(ranges)) schedule(static, 1)
  for (std::size_t r = 0; r < ranges; ++r) evaluate_range(count * r / ranges, count * (r + 1) / ranges);
}

/// Where a law found more contacts than there are slots; true if it must be asked again.
bool ContactStage::make_room() {
  bool short_of_room = false;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    capacities_[i] = pairs_[i].slot_capacity;
    if (pair_reports_[i].contact_count > capacities_[i]) {
      capacities_[i] = 2 * pair_reports_[i].contact_count;
      short_of_room = true;
    }
  }
  if (short_of_room) lay_out_slots(capacities_);
  return short_of_room;
}

/// f_c of Eq. 48: adds the loads at the corners to their bodies, pair after pair, whatever the threads did.
ContactTotals ContactStage::gather(const Model& model, MotionState& motion) {
  ContactTotals totals;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    BodyPair& pair = pairs_[i];
    const PairReport& report = pair_reports_[i];
    pair.contact_count = report.contact_count;
    totals.stored += report.stored;
    totals.slip_loss += report.slip_loss;
    // Work of the dashpots between t_{n-1} and t_n, from their power at both ends.
    totals.damping_loss +=
        (report.damping_power + std::sqrt(std::max(0.0, report.damping_power * damping_power_[i]))) / 2;
    damping_power_[i] = report.damping_power;
    if (!(report.penetration <= totals.penetration)) {
      totals.penetration = report.penetration;
      totals.deepest_a = pair.a;
      totals.deepest_b = pair.b;
    }
    if (report.contact_count == 0) continue;
    for (std::uint32_t p = pair.piece_pair_start; p < pair.piece_pair_end; ++p) {
      std::uint32_t load = piece_pairs_[p].load_start;
      for (const std::uint32_t piece : {piece_pairs_[p].a, piece_pairs_[p].b}) {
        if (model.is_strip[piece] != 0) {
          const BoundarySide& side = model.sides[model.strips[model.piece_strip[piece]].side];
          motion.add_force(side.start, {load_x_[load], load_y_[load]});
          motion.add_force(side.end, {load_x_[load + 1], load_y_[load + 1]});
          load += model.piece_start[piece + 1] - model.piece_start[piece];
          continue;
        }
        BodyForce& force = motion.forces[model.piece_body[piece]];
        for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c, ++load) {
          force.add({model.reference_x[c], model.reference_y[c]}, {load_x_[load], load_y_[load]});
        }
      }
    }
  }
  return totals;
}

}  // namespace talus
