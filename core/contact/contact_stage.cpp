#include "contact/contact_stage.hpp"

#include "contact/room.hpp"
#include "geometry/vanishing_depth.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace talus {
namespace {

/// Skin as a share of the mean width of the moving bodies: at the speeds of the shipped scenes a search
/// serves some 40 to 200 steps, and few pairs are candidates that do not touch.
constexpr double skin_share = 0.1;
/// Share of the mean width by which boxes are grown at least: bodies that only rounding makes overlap are
/// candidates with the skin off, too.
constexpr double rounding = 1e-9;
constexpr std::uint32_t first_capacity = 2;  ///< contacts of a new pair before room must be made
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

bool ContactStage::find_pairs(const Model& model, const MotionState& motion, double travelled) {
  if (!law_) return false;
  // Both bodies of a pair may have moved; the boxes leave half of what is near to each.
  slack_ -= travelled;
  travelled_ += travelled;
  const bool due = !(slack_ > 0), every_step = !(skin_ > 0);
  if (!due && !every_step) return false;
  const double rounded = rounding * model.mean_width;
  if (due) {
    search_.find(model, motion, std::max(near_, rounded), candidates_);
    note_neighbours(model);
    slack_ = near_ / 2;
  }
  if (every_step) search_.find(model, motion, rounded, candidates_);
  rebuild_pairs(model);
  travelled_ = 0;
  ++searches_;
  return due;
}

void ContactStage::note_neighbours(const Model& model) {
  lightest_neighbour_.assign(model.bodies.size(), std::numeric_limits<double>::infinity());
  for (const Candidate& candidate : candidates_) {
    const std::uint32_t a = candidate.body_a, b = candidate.body_b;
    if (fixed_[a] != 0 || fixed_[b] != 0) continue;
    lightest_neighbour_[a] = std::min(lightest_neighbour_[a], model.bodies[b].contact_mass);
    lightest_neighbour_[b] = std::min(lightest_neighbour_[b], model.bodies[a].contact_mass);
  }
}

void ContactStage::rebuild_pairs(const Model& model) {
  former_pairs_.clear();
  make_room_in(former_pairs_, pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const BodyPair& pair = pairs_[i];
    former_pairs_.push_back(
        {pair.a, pair.b, slot_of(i), pair.slot_capacity, pair.contact_count, damping_power_[i]});
  }
  pairs_.clear();
  piece_pairs_.clear();
  const auto same_bodies = [](const Candidate& p, const Candidate& q) {
    return p.body_a == q.body_a && p.body_b == q.body_b;
  };
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < candidates_.size(); ++i)
    repeated += same_bodies(candidates_[i - 1], candidates_[i]) ? 1 : 0;
  make_room_in(pairs_, candidates_.size() - repeated);
  make_room_in(piece_pairs_, candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& candidate = candidates_[i];
    if (pairs_.empty() || pairs_.back().a != candidate.body_a || pairs_.back().b != candidate.body_b) {
      const Body &a = model.bodies[candidate.body_a], &b = model.bodies[candidate.body_b];
      const double reduced_mass = fixed_[candidate.body_a] ? b.contact_mass
                                  : fixed_[candidate.body_b]
                                      ? a.contact_mass
                                      : a.contact_mass * b.contact_mass / (a.contact_mass + b.contact_mass);
      const auto first = static_cast<std::uint32_t>(piece_pairs_.size());
      BodyPair pair{};
      pair.a = candidate.body_a, pair.b = candidate.body_b;
      pair.piece_pair_start = first;
      pair.master_share = master_share(pair.a, pair.b);
      pair.offset_x = b.centre.x - a.centre.x, pair.offset_y = b.centre.y - a.centre.y;
      pair.reduced_mass = reduced_mass;
      pairs_.push_back(pair);
    }
    piece_pairs_.push_back({candidate.piece_a, candidate.piece_b, 0});
    pairs_.back().piece_pair_end = static_cast<std::uint32_t>(piece_pairs_.size());
  }
  ask_again_.assign(pairs_.size(), 0.0);
  lay_out_loads(model);

  // History goes with its pair: both lists are sorted by bodies.
  damping_power_.assign(pairs_.size(), 0.0);
  capacities_.clear();
  for (const BodyPair& pair : pairs_) capacities_.push_back(pair.plain() ? 1 : first_capacity);
  auto former = former_pairs_.cbegin();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto bodies = [](const auto& pair) { return std::pair{pair.a, pair.b}; };
    while (former != former_pairs_.cend() && bodies(*former) < bodies(pairs_[i])) ++former;
    if (former == former_pairs_.cend()) break;
    if (bodies(*former) != bodies(pairs_[i])) continue;
    pairs_[i].slot_start = former->slot_start;
    pairs_[i].contact_count = former->contact_count;
    capacities_[i] = former->slot_capacity;
    damping_power_[i] = former->damping_power;
  }
  lay_out_slots(capacities_);
  if (!island_.empty()) hold_sleeping_pairs();
}

/// Of the pairs there are.
void ContactStage::lay_out_loads(const Model& model) {
  loads_.lay_out(model, pairs_, piece_pairs_);
  if (keeps_stored_) stored_.resize(pairs_.size());
  chunk_totals_.resize((pairs_.size() + pair_chunk - 1) / pair_chunk);
  describe_plain_pairs(model);
}

void ContactStage::describe_plain_pairs(const Model& model) {
  const Boundaries boundaries{nullptr, model.piece_start.data(), nullptr, clear_depth_.data()};
  const auto surface = [&](std::uint32_t body) { return model.surface[model.bodies[body].corner_begin]; };
  for (BodyPair& pair : pairs_) {
    pair.plain_corners[0] = pair.plain_corners[1] = 0;
    if (plain_[pair.a] == 0 || plain_[pair.b] == 0) continue;
    describe_plain(pair, piece_pairs_[pair.piece_pair_start], boundaries,
                   interfaces_.row[surface(pair.a) * interfaces_.surface_count + surface(pair.b)]);
  }
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
  const auto close_chunk = [&](std::size_t chunk, std::span<const std::uint32_t> active, Workspace& found) {
    close(model, chunk, active, found);
  };
  for (std::size_t number = 0; number < loads_.waves(); ++number) {
    const Wave now = wave(number);
    ask(model, motion, conditions, now, until, true, close_chunk);
    while (any_chunk(now, [](const ChunkTotals& chunk) { return chunk.short_of_room; })) {
      make_room();
      ask(model, motion, conditions, now, in_this_step, false, close_chunk);
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
        [&](std::size_t chunk, std::span<const std::uint32_t> active, const Workspace& found) {
          for (const std::uint32_t in_chunk : active) {
            chunk_totals_[chunk].stored += found.reports[in_chunk].stored;
            chunk_totals_[chunk].slip_loss += found.reports[in_chunk].slip_loss;
          }
        });
  }
  interfaces_.value = interface_values_.data();
  loads_.renew();  // with other parameters a law may find contact where it finds none now
  const ContactTotals found = totals();
  return found.stored + found.slip_loss;
}

/// Asks the law about pairs of a wave: anew, or once more about some. Calls each(chunk, pairs of it that were
/// asked about, what the law said).
template <class Each>
void ContactStage::ask(const Model& model, const MotionState& motion, const Conditions& conditions,
                       const Wave& wave, double until, bool anew, const Each& each) {
  const Boundaries boundaries{motion.corners.data(), model.piece_start.data(), model.is_strip.data(),
                              clear_depth_.data()};
  if (anew) loads_.begin(wave.number);
  const auto ask_chunk = [&](std::size_t in_wave, std::size_t begin, std::size_t end, std::size_t thread) {
    if (anew) loads_.prepare(in_wave);
    Workspace& found = workspaces_[thread];
    begin += wave.begin, end += wave.begin;
    const std::uint32_t count = choose_active(begin, end, until, found.active);
    if (count == 0) return;
    loads_.expect();
#ifdef TALUS_AUDIT
    const double poison = std::numeric_limits<double>::quiet_NaN();
    std::fill(found.history.begin(), found.history.end(), poison);
    for (std::uint32_t i = 0; i < count; ++i) fill_loads(model, pairs_[begin + found.active[i]], poison);
#endif
    const std::size_t chunk = wave.first_chunk() + in_wave, slot = slot_base_[chunk];
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
    each(chunk, std::span<const std::uint32_t>(found.active).first(count), found);
  };
  workers_.over(wave.end - wave.begin, pair_chunk, ask_chunk);
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

/// What the law found becomes what it is told of the previous step next time, while it is at hand. A pair
/// that is short of room is left as it was, to be asked about again.
void ContactStage::close(const Model& model, std::size_t chunk, std::span<const std::uint32_t> active,
                         const Workspace& found) {
  const std::size_t begin = chunk * pair_chunk;
  const double travelled = travelled_;
  const bool skin = skin_ > 0;
  double *const ask_again = ask_again_.data() + begin, *const damping_power = damping_power_.data() + begin;
  double* const stored = stored_.empty() ? nullptr : stored_.data() + begin;
  double* const history = history_.data() + std::size_t{slot_base_[chunk]} * history_doubles_;
  ChunkTotals totals = chunk_totals_[chunk];
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
  if (!std::isfinite(sound)) totals.unsound = first_unsound(chunk, active, found);
  chunk_totals_[chunk] = totals;
}

/// The first pair with a report that is no number.
std::uint32_t ContactStage::first_unsound(std::size_t chunk, std::span<const std::uint32_t> active,
                                          const Workspace& found) {
  for (const std::uint32_t in_chunk : active) {
    const PairReport& r = found.reports[in_chunk];
    if (!std::isfinite(r.penetration + r.stored + r.slip_loss + r.damping_power))
      return static_cast<std::uint32_t>(chunk * pair_chunk + in_chunk);
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
