#include "contact/contact_stage.hpp"

#include "geometry/vanishing_depth.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace talus {
namespace {

/// Skin as a share of the mean width of the moving bodies: at the speeds of the shipped scenes a search
/// serves some 40 to 200 steps, and few pairs are candidates that do not touch.
constexpr double skin_share = 0.1;
/// Share of the vanishing depth at the start that a law may count on: bodies strain. Measured once, for what
/// a law does must not depend on when neighbours were sought.
constexpr double clear_share = 0.8;

void noop(void* /*object*/) noexcept {}

/// A few; a call would cost more than they do.
void copy_doubles(const double* from, std::size_t count, double* to) {
  std::size_t i = 0;
  for (; i + 2 <= count; i += 2) std::memcpy(to + i, from + i, 2 * sizeof(double));
  if (i < count) to[i] = from[i];
}

/// Whether laws may take it for one convex piece of one surface class all around.
bool is_plain(const Model& model, const Body& body) {
  if (!model.one_piece(body)) return false;
  if (body.corner_end - body.corner_begin > std::numeric_limits<std::uint16_t>::max()) return false;
  const std::uint32_t surface = model.surface[body.corner_begin];
  for (std::uint32_t c = body.corner_begin; c < body.corner_end; ++c) {
    if (model.surface[c] != surface || surface == internal_side) return false;
  }
  return true;
}

}  // namespace

ContactStage::ContactStage(const Scene& scene, const Model& model, Workers& workers, bool neighbour_skin,
                           SimdLevel level)
    : law_(nullptr, noop),
      workers_(workers),
      near_(skin_share * model.mean_width),
      skin_(neighbour_skin ? near_ : 0),
      workspaces_(static_cast<std::size_t>(workers.threads())),
      keeps_stored_(scene.sleep.has_value()),
      search_(model),
      lightest_neighbour_(model.bodies.size(), std::numeric_limits<double>::infinity()),
      loads_(model, level, workers) {
  for (const Body& body : model.bodies) {
    fixed_.push_back(body.kinematics == Kinematics::fixed);
    plain_.push_back(is_plain(model, body) ? 1 : 0);
  }
  if (scene.contact.component == nullptr) return;
  const MotionState at_start(model);
  for (std::size_t p = 0; p < model.piece_body.size(); ++p) {
    const std::uint32_t begin = model.piece_start[p], end = model.piece_start[p + 1];
    clear_depth_.push_back(clear_share * vanishing_depth(&at_start.corners[begin], end - begin));
  }
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

ContactTotals ContactStage::evaluate(const Model& model, MotionState& motion, const Conditions& conditions) {
  if (!law_ || pairs_.empty()) return {};
  touched_.clear();
  fault_ = {};
  chunk_totals_.assign(chunk_totals_.size(), {});
  evaluate(model, motion, conditions, travelled_);
  while (wake_touched()) evaluate(model, motion, conditions, in_this_step);
  return totals();
}

/// Of the pairs whose time has come (see ask_again_), wave after wave of them.
void ContactStage::evaluate(const Model& model, MotionState& motion, const Conditions& conditions,
                            double until) {
  const auto close_batch = [&](std::size_t batch, std::span<const std::uint32_t> active, Workspace& found) {
    close(model, batch, active, found);
  };
  for (std::size_t number = 0; number < loads_.waves(); ++number) {
    const Wave now = wave(number);
    ask(model, motion, conditions, now, until, true, close_batch);
    while (any_chunk(now, [](const ChunkTotals& chunk) { return chunk.short_of_room; })) {
      make_room();
      ask(model, motion, conditions, now, in_this_step, false, close_batch);
    }
    if (!loads_.due()) continue;
    const bool finite = loads_.add(model, still_, motion);
    const bool unsound = any_chunk(now, [](const ChunkTotals& chunk) { return chunk.unsound != no_pair; });
    if ((conditions.observed || unsound || !finite) && fault_.found.empty())
      fault_ = fault_of(model, motion, now);
  }
}

double ContactStage::with_former_interfaces(const Model& model, const MotionState& motion,
                                            const Conditions& conditions) {
  if (!law_ || pairs_.empty()) return 0;
  chunk_totals_.assign(chunk_totals_.size(), {});
  interfaces_.value = former_interface_values_.data();
  for (std::size_t number = 0; number < loads_.waves(); ++number) {
    ask(model, motion, conditions, wave(number), travelled_, true,
        [&](std::size_t batch, std::span<const std::uint32_t> active, const Workspace& found) {
          for (const std::uint32_t i : active) {
            ChunkTotals& chunk = chunk_totals_[(batch_begin_[batch] + i) / pair_chunk];
            chunk.stored += found.reports[i].stored;
            chunk.slip_loss += found.reports[i].slip_loss;
          }
        });
  }
  interfaces_.value = interface_values_.data();
  loads_.renew();  // with other parameters a law may find contact where it finds none now
  const ContactTotals found = totals();
  return found.stored + found.slip_loss;
}

/// Asks the law about pairs of a wave: anew, or once more about some. Calls each(batch, pairs of it that were
/// asked about, what the law said).
template <class Each>
void ContactStage::ask(const Model& model, const MotionState& motion, const Conditions& conditions,
                       const Wave& wave, double until, bool anew, const Each& each) {
  const Boundaries boundaries{motion.corners.data(), model.piece_start.data(), model.is_strip.data(),
                              clear_depth_.data()};
  if (anew) loads_.begin(wave.number);
  const std::size_t first = batch_of(wave.begin), batches = batch_of(wave.end - 1) + 1 - first;
  const auto ask_batch = [&](std::size_t in_wave, std::size_t, std::size_t, std::size_t thread) {
    const std::size_t number = first + in_wave, slot = slot_base_[number];
    if (anew) loads_.prepare(number);
    Workspace& found = workspaces_[thread];
    const std::size_t begin = batch_begin_[number], end = batch_begin_[number + 1];
    const std::uint32_t count = choose_active(begin, end, until, found.active);
    if (count == 0) return;
    loads_.expect();
#ifdef TALUS_AUDIT
    const double poison = std::numeric_limits<double>::quiet_NaN();
    std::fill(found.history.begin(), found.history.end(), poison);
    for (std::uint32_t i = 0; i < count; ++i) fill_loads(model, pairs_[begin + found.active[i]], poison);
#endif
    const ContactBatch batch{boundaries,
                             interfaces_,
                             pairs_.data() + begin,
                             piece_pairs_.data(),
                             history_.data() + slot * history_doubles_,
                             found.active.data(),
                             count,
                             conditions.dt,
                             conditions.hold_stick,
                             conditions.bonds_form};
    law_->evaluate(batch, {loads_.x(), loads_.y(), found.history.data(),
                           conditions.observed ? reports_.data() + slot : nullptr, found.reports.data()});
#ifdef TALUS_AUDIT
    for (std::uint32_t i = 0; i < count; ++i) {
      if (found.reports[found.active[i]].contact_count == 0)
        fill_loads(model, pairs_[begin + found.active[i]], 0);
    }
#endif
    each(number, std::span<const std::uint32_t>(found.active).first(count), found);
  };
  workers_.over(batches, 1, ask_batch);
}

/// Pairs that were apart need no look until both bodies together may have closed the gap.
std::uint32_t ContactStage::choose_active(std::size_t begin, std::size_t end, double until,
                                          std::vector<std::uint32_t>& active) const {
  std::uint32_t count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    active[count] = static_cast<std::uint32_t>(i - begin);
    count += ask_again_[i] <= until ? 1 : 0;
  }
  return count;
}

/// What the law found becomes what it is told of the previous step next time, while it is at hand.
void ContactStage::close(const Model& model, std::size_t batch, std::span<const std::uint32_t> active,
                         const Workspace& found) {
  while (!active.empty()) {
    const std::size_t in_batch = active.front() / pair_chunk, end = (in_batch + 1) * pair_chunk;
    const auto of_chunk = std::lower_bound(active.begin(), active.end(), end) - active.begin();
    close_chunk(model, batch, active.first(of_chunk), found,
                chunk_totals_[batch_begin_[batch] / pair_chunk + in_batch]);
    active = active.subspan(of_chunk);
  }
}

/// A pair that is short of room is left as it was, to be asked about again.
void ContactStage::close_chunk(const Model& model, std::size_t batch, std::span<const std::uint32_t> active,
                               const Workspace& found, ChunkTotals& chunk) {
  const std::size_t begin = batch_begin_[batch];
  const double travelled = travelled_;
  const bool skin = skin_ > 0;
  double *const ask_again = ask_again_.data() + begin, *const damping_power = damping_power_.data() + begin;
  double* const stored = stored_.empty() ? nullptr : stored_.data() + begin;
  double* const history = history_.data() + std::size_t{slot_base_[batch]} * history_doubles_;
  ChunkTotals totals = chunk;
  totals.short_of_room = false;
  double sound = 0;
  for (const std::uint32_t i : active) {
    BodyPair& pair = pairs_[begin + i];
    const PairReport& report = found.reports[i];
    if (report.contact_count > pair.slot_capacity) {
      totals.short_of_room = true;
      capacities_[begin + i] = 2 * report.contact_count;
      ask_again[i] = in_this_step;
      continue;
    }
    sound += (report.penetration + report.stored) + (report.slip_loss + report.damping_power);
    totals.stored += report.stored;
    totals.slip_loss += report.slip_loss;
    if (stored != nullptr) stored[i] = report.stored;
    if (report.contact_count == 0) {
      if (pair.contact_count != 0) fill_loads(model, pair, 0);
      pair.contact_count = 0;
      damping_power[i] = 0;
      ask_again[i] = skin ? travelled + report.gap / 2 : 0;
      continue;
    }
    // Work of the dashpots between t_{n-1} and t_n, from their power at both ends.
    totals.damping_loss +=
        (report.damping_power + std::sqrt(std::max(0.0, report.damping_power * damping_power[i]))) / 2;
    if (!(report.penetration <= totals.penetration)) {
      totals.penetration = report.penetration;
      totals.deepest_a = pair.a;
      totals.deepest_b = pair.b;
    }
    pair.contact_count = report.contact_count;
    damping_power[i] = report.damping_power;
    ask_again[i] = 0;
    const std::size_t slot = std::size_t{pair.slot_start} * history_doubles_;
    copy_doubles(found.history.data() + slot, std::size_t{report.contact_count} * history_doubles_,
                 history + slot);
  }
  if (!std::isfinite(sound)) totals.unsound = first_unsound(begin, active, found);
  chunk = totals;
}

/// The first pair with a report that is no number.
std::uint32_t ContactStage::first_unsound(std::size_t begin, std::span<const std::uint32_t> active,
                                          const Workspace& found) {
  for (const std::uint32_t i : active) {
    const PairReport& r = found.reports[i];
    if (!std::isfinite(r.penetration + r.stored + r.slip_loss + r.damping_power))
      return static_cast<std::uint32_t>(begin + i);
  }
  return no_pair;
}

ContactTotals ContactStage::totals() const {
  ContactTotals totals;
  for (const ChunkTotals& chunk : chunk_totals_) {
    totals.stored += chunk.stored;
    totals.slip_loss += chunk.slip_loss;
    totals.damping_loss += chunk.damping_loss;
    if (chunk.penetration <= totals.penetration) continue;
    totals.penetration = chunk.penetration;
    totals.deepest_a = chunk.deepest_a;
    totals.deepest_b = chunk.deepest_b;
  }
  return totals;
}

void ContactStage::fill_loads(const Model& model, const BodyPair& pair, double value) {
  loads_.fill(
      model,
      std::span(piece_pairs_).subspan(pair.piece_pair_start, pair.piece_pair_end - pair.piece_pair_start),
      value);
}

}  // namespace talus
