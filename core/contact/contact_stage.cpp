#include "contact/contact_stage.hpp"

#include "geometry/straight_beyond.hpp"
#include "geometry/vanishing_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

/// Skin as a share of the mean width of the moving bodies: at the speeds of the shipped scenes a search
/// serves some 40 to 200 steps, and few pairs are candidates that do not touch.
constexpr double skin_share = 0.1;
/// Share of the vanishing depth at the start that a law may count on: bodies strain. Measured once, for what
/// a law does must not depend on when neighbours were sought.
constexpr double clear_share = 0.8;

/// Of near_: m, by which places may be off by rounding, and gaps so much smaller than a law says.
constexpr double rounding_share = 1e-9;

/// What a step looks up of more pairs is no longer in the cache that is nearest to a core.
constexpr std::size_t most_near_pairs = 4096;

void noop(void* /*object*/) noexcept {}

/// Across a gap that may be wider than what is sifted out.
bool may_pull(const Scene& scene) {
  return scene.contact.component != nullptr &&
         ((scene.contact.component->component->traits & trait::pulls) != 0 || may_bond(scene));
}

/// [surface class] the first that meets all others at the same interfaces.
std::vector<std::uint32_t> alike_surfaces(const Interfaces& interfaces) {
  const std::uint32_t count = interfaces.surface_count;
  std::vector<std::uint32_t> alike(count);
  for (std::uint32_t surface = 0; surface < count; ++surface) {
    const std::uint32_t* const row = interfaces.row + std::size_t{surface} * count;
    while (!std::equal(row, row + count, interfaces.row + std::size_t{alike[surface]} * count))
      ++alike[surface];
  }
  return alike;
}

/// The surface class of a body that laws may take for one convex piece of one class all around, or
/// internal_side: of several that are alike, the first stands for all.
std::uint32_t plain_surface(const Model& model, const Body& body, const std::vector<std::uint32_t>& alike) {
  if (!model.one_piece(body)) return internal_side;
  if (body.corner_end - body.corner_begin > most_plain_corners) return internal_side;
  const auto surface_of = [&](std::uint32_t corner) {
    const std::uint32_t surface = model.surface[corner];
    return surface < alike.size() ? alike[surface] : surface;
  };
  for (std::uint32_t c = body.corner_begin; c < body.corner_end; ++c) {
    if (surface_of(c) != surface_of(body.corner_begin)) return internal_side;
  }
  return model.surface[body.corner_begin];
}

std::vector<BoundaryCorner> ring_at_start(const Model& model, std::uint32_t piece) {
  std::vector<BoundaryCorner> ring;
  for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c)
    ring.push_back(
        {model.reference_x[c], model.reference_y[c], 0, 0, 0, 0, 0, model.surface[c], model.cut[c]});
  measure_sides(ring);
  return ring;
}

/// Boundaries::straight_beyond; empty where no body is cut into pieces.
std::vector<double> straight_beyond_of(const Model& model) {
  std::vector<double> all;
  for (const Body& body : model.bodies) {
    if (body.piece_end <= body.piece_begin + 1 || model.is_strip[body.piece_begin] != 0) continue;
    std::vector<BoundaryCorner> corners;
    for (std::uint32_t p = body.piece_begin; p < body.piece_end; ++p) {
      const std::vector<BoundaryCorner> ring = ring_at_start(model, p);
      corners.insert(corners.end(), ring.begin(), ring.end());
    }
    const std::vector<double> own = straight_beyond(
        corners,
        std::span(model.piece_start).subspan(body.piece_begin, body.piece_end - body.piece_begin + 1));
    all.resize(4 * model.reference_x.size());
    std::ranges::copy(own, all.begin() + std::ptrdiff_t{4} * model.piece_start[body.piece_begin]);
  }
  return all;
}

}  // namespace

ContactStage::ContactStage(const Scene& scene, const Model& model, Workers& workers, bool neighbour_skin,
                           SimdLevel level, bool seen)
    : law_(nullptr, noop),
      workers_(workers),
      kernels_(kernels::contact_kernels(level)),
      sharing_(model.mostly_covered() ? heavy_pairs : plain_pairs),
      near_(skin_share * model.mean_width),
      skin_(neighbour_skin ? near_ : 0),
      sifts_(skin_ > 0 && model.mostly_covered() && !may_pull(scene)),
      workspaces_(static_cast<std::size_t>(workers.threads())),
      keeps_stored_(scene.sleep.has_value()),
      search_(model),
      lightest_neighbour_(model.bodies.size(), std::numeric_limits<double>::infinity()),
      loads_(model, level, workers, scene.sleep.has_value()),
      corner_drift_(model.reference_x.size()),
      drift_(model.bodies.size()) {
  for (const Body& body : model.bodies) fixed_.push_back(body.kinematics == Kinematics::fixed);
  set_supports(model, settings_of(scene).supports);
  heaviest_neighbour_.assign(holds_any() ? model.bodies.size() : 0, 0.0);
  if (scene.contact.component == nullptr) return;
  clear_depth_.reserve(model.piece_body.size());
  for (std::uint32_t p = 0; p < model.piece_body.size(); ++p) {
    const std::vector<BoundaryCorner> ring = ring_at_start(model, p);
    clear_depth_.push_back(clear_share * vanishing_depth(ring.data(), ring.size()));
  }
  straight_beyond_ = straight_beyond_of(model);
  law_ = make<ContactModel>(*scene.contact.component, scene.contact.values);
  const std::uint32_t history_doubles = law_->doubles_per_contact();
  if (history_doubles > most_state_doubles) {
    throw PluginError(fmt::format(
        "{}: contact law '{}' gave {} doubles of history per contact; wanted {} at most; mend the law",
        scene.contact.component->file.string(), scene.contact.component->component->name, history_doubles,
        most_state_doubles));
  }
  slots_.keep(history_doubles, seen);
  interfaces_ = {scene.interface_row.data(), nullptr, static_cast<std::uint32_t>(scene.surfaces.size()),
                 scene.contact.component->component->interface_parameter_count};
  const std::vector<std::uint32_t> alike = alike_surfaces(interfaces_);
  for (const Body& body : model.bodies) {
    plain_surface_.push_back(plain_surface(model, body, alike));
    first_piece_.push_back(body.piece_begin);
  }
  set_interfaces(scene.interface_values);
  refuse_unsound_interfaces(*scene.contact.component);
  if (scene.roles_by_priority) {
    for (const SceneBody& body : scene.bodies) priority_.push_back(body.priority);
  }
}

/// The time step is voted by them. Stages write other numbers into the same formulas.
void ContactStage::refuse_unsound_interfaces(const RegisteredComponent& law) const {
  for (std::size_t i = 0; i < interface_values_.size(); ++i) {
    if (!std::isnan(interface_values_[i])) continue;
    const Parameter& parameter = law.component->interface_parameters[i % interfaces_.parameter_count];
    throw PluginError(
        fmt::format("{}: contact law '{}' prepared {} from '{}' of an interface; wanted a number; "
                    "mend the law",
                    law.file.string(), law.component->name, interface_values_[i], parameter.key));
  }
  for (std::size_t at = 0; at < interface_values_.size(); at += interfaces_.parameter_count) {
    const ContactStiffness found = law_->stiffness(&interface_values_[at], 1);
    for (const double value :
         {found.normal, found.tangential, found.normal_damping_ratio, found.tangential_damping_ratio}) {
      if (std::isfinite(value) && value >= 0) continue;
      throw PluginError(
          fmt::format("{}: contact law '{}' gave {} as a stiffness or damping ratio of an "
                      "interface; wanted finite numbers from 0 on; mend the law",
                      law.file.string(), law.component->name, value));
    }
  }
}

bool ContactStage::set_interfaces(const std::vector<std::vector<double>>& values) {
  if (!law_) return false;
  const std::vector<double> former = std::exchange(interface_values_, {});
  for (std::vector<double> row : values) {
    law_->prepare_interface(row.data());
    interface_values_.insert(interface_values_.end(), row.begin(), row.end());
  }
  interfaces_.value = interface_values_.data();
  loads_.renew();  // with other parameters a law may find contact where it finds none now
  for (std::size_t at = 0; at < former.size(); at += interfaces_.parameter_count) {
    const double one = law_->stiffness(&former[at], 1).tangential,
                 other = law_->stiffness(&interface_values_[at], 1).tangential;
    if (one > 0 && other > 0 && one != other) return true;
  }
  return false;
}

void ContactStage::set_supports(const Model& model, std::span<const Support> supports) {
  const std::vector<char> former = std::move(held_);
  held_.clear();
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i)
    held_.push_back(model.moves_as_a_whole(i) && support_of(supports, i).all());
  if (held_ == former) return;
  heaviest_neighbour_.clear();  // any may be near, until neighbours are sought
  for (BodyPair& pair : pairs_) pair.reduced_mass = reduced_mass(model, pair.a, pair.b);
  slack_ = -1;
}

/// m_a m_b/(m_a + m_b), or the mass of the one that alone can move; of two that are held, as of two that are
/// not, for they may deform.
float ContactStage::reduced_mass(const Model& model, std::uint32_t a, std::uint32_t b) const {
  const double of_a = model.bodies[a].contact_mass, of_b = model.bodies[b].contact_mass;
  if (fixed_[a] || (held_[a] && !held_[b] && !fixed_[b])) return static_cast<float>(of_b);
  if (fixed_[b] || (held_[b] && !held_[a])) return static_cast<float>(of_a);
  return static_cast<float>(of_a * of_b / (of_a + of_b));
}

/// A fixed body is master; between moving bodies both roles count half, or a declared priority decides.
std::uint16_t ContactStage::master_halves(std::uint32_t a, std::uint32_t b) const {
  if (fixed_[a]) return 2;
  if (fixed_[b]) return 0;
  if (priority_.empty() || priority_[a] == priority_[b]) return 1;
  return priority_[a] > priority_[b] ? 2 : 0;
}

ContactTotals ContactStage::evaluate(const Model& model, MotionState& motion, const Conditions& conditions) {
  if (!law_ || pairs_.empty()) return {};
  touched_.clear();
  fault_ = {};
  chunk_totals_.assign(chunk_totals_.size(), {});
  evaluate(model, motion, conditions, way_);
  while (wake_touched()) evaluate(model, motion, conditions, no_way);
  return totals();
}

/// Of the pairs whose time has come (see ask_again_), wave after wave of them.
void ContactStage::evaluate(const Model& model, MotionState& motion, const Conditions& conditions,
                            const kernels::Way& gone) {
  const auto close_batch = [&](std::size_t batch, std::span<const std::uint32_t> active, Workspace& found) {
    close(model, batch, active, found);
  };
  for (std::size_t number = 0; number < loads_.waves(); ++number) {
    const Wave now = wave(number);
    ask(model, motion, conditions, now, gone, close_batch);
    while (some_short_of_room()) {
      if (const LawFault found = runaway(); !found.found.empty()) {
        fault_ = found;
        return;
      }
      make_room();
      ask_again(model, motion, conditions, close_batch);
    }
    if (!loads_.due()) continue;
    const bool finite = loads_.add(model, still_, motion);
    const bool unsound = any_chunk(now, [](const ChunkTotals& chunk) { return chunk.unsound != no_pair; });
    if ((conditions.observed || unsound || !finite) && fault_.found.empty())
      fault_ = fault_of(model, motion, now);
  }
}

/// Asks the law about the pairs of a wave whose time has come. Calls each(batch, pairs of it that were asked
/// about, what the law said).
template <class Each>
void ContactStage::ask(const Model& model, const MotionState& motion, const Conditions& conditions,
                       const Wave& wave, const kernels::Way& gone, const Each& each) {
  loads_.begin(wave.number);
  const bool all = gone.travelled != in_this_step;
  const std::size_t first = batch_of(wave.begin), batches = batch_of(wave.end - 1) + 1 - first;
  workers_.over(batches, 1, [&](std::size_t in_wave, std::size_t, std::size_t, std::size_t thread) {
    const std::size_t batch = first + in_wave, begin = batch_begin_[batch], end = batch_begin_[batch + 1];
    loads_.prepare(batch);
    Workspace& found = workspaces_[thread];
    // Pairs that were apart need no look until both bodies together may have closed the gap.
    const std::uint32_t count =
        kernels_.choose(ask_again_.data() + begin, approach_.data() + begin,
                        static_cast<std::uint32_t>(end - begin), gone, found.active.data());
    if (count > 0) ask_about(model, motion, conditions, batch, count, all, found, each);
  });
}

/// Asks once more about those that were short of room, few in all steps but the first.
template <class Each>
void ContactStage::ask_again(const Model& model, const MotionState& motion, const Conditions& conditions,
                             const Each& each) {
  Workspace& found = workspaces_.front();
  for (auto at = short_of_room_.begin(); at != short_of_room_.end();) {
    const std::size_t batch = batch_of(at->pair);
    std::uint32_t count = 0;
    for (; at != short_of_room_.end() && at->pair < batch_begin_[batch + 1]; ++at)
      found.active[count++] = at->pair - batch_begin_[batch];
    ask_about(model, motion, conditions, batch, count, false, found, each);
  }
}

/// Asks about the first `count` of found.active; `all`: they are all of the batch whose time has come.
template <class Each>
void ContactStage::ask_about(const Model& model, const MotionState& motion, const Conditions& conditions,
                             std::size_t batch, std::uint32_t count, bool all, Workspace& found,
                             const Each& each) {
  const std::size_t begin = batch_begin_[batch], slot = slots_.first_of(batch);
  loads_.expect();
  if (pairs_.size() > most_near_pairs) fetch_ahead(motion, begin, slot, {found.active.data(), count});
#ifdef TALUS_AUDIT
  const double poison = std::numeric_limits<double>::quiet_NaN();
  std::fill(found.history.begin(), found.history.end(), poison);
  for (std::uint32_t i = 0; i < count; ++i)
    loads_.fill(model, pairs_[begin + found.active[i]], piece_pairs(), poison);
#endif
  const ContactBatch asked{
      {motion.corners.data(), model.piece_start.data(), model.is_strip.data(), clear_depth_.data(),
       straight_beyond_.empty() ? nullptr : straight_beyond_.data()},
      interfaces_,
      pairs_.data() + begin,
      piece_pairs(),
      slots_.history(slot),
      found.active.data(),
      count,
      conditions.dt,
      conditions.hold_stick,
      conditions.bonds_form,
      all && !plans_.empty() ? plans_[batch].get() : nullptr,
      layout_};
  law_->evaluate(asked, {loads_.corner(), found.history.data(),
                         conditions.observed && slots_.keeps_reports() ? slots_.reports(slot) : nullptr,
                         found.reports.data()});
  each(batch, std::span<const std::uint32_t>(found.active).first(count), found);
}

/// Pairs, their history and their corners lie scattered, so that a law would wait for one after the other.
/// The corners of body a mostly come with an earlier pair, for pairs are sorted by it.
void ContactStage::fetch_ahead(const MotionState& motion, std::size_t begin, std::size_t slot,
                               std::span<const std::uint32_t> active) const {
  constexpr std::size_t pairs_before = 12;
  constexpr std::uint32_t most_corners = 4;
  const BodyPair* const pairs = pairs_.data() + begin;
  const double* const history = slots_.history(slot);
  for (std::size_t k = 0; k < active.size(); ++k) {
    if (k + pairs_before < active.size()) __builtin_prefetch(pairs + active[k + pairs_before]);
    const BodyPair& pair = pairs[active[k]];
    if (!pair.plain()) continue;
    __builtin_prefetch(history + std::size_t{pair.slot_start} * slots_.doubles());
    const BoundaryCorner* const corner = motion.corners.data() + pair.corner_start[1];
    for (std::uint32_t i = 0; i < most_corners; ++i) __builtin_prefetch(corner + i);
  }
}

/// What the law found becomes what it is told of the previous step next time, while it is at hand. A pair
/// that is short of room is left as it was, to be asked about again.
void ContactStage::close(const Model& model, std::size_t batch, std::span<const std::uint32_t> active,
                         Workspace& found) {
  const std::size_t begin = batch_begin_[batch], slot = slots_.first_of(batch);
  const kernels::PairBooks books{pairs_.data() + begin,
                                 ask_again_.data() + begin,
                                 approach_.data() + begin,
                                 slots_.dashpots(slot),
                                 slots_.history(slot),
                                 found.history.data(),
                                 found.reports.data(),
                                 slots_.doubles(),
                                 drift_.data(),
                                 way_,
                                 rounding_share * near_,
                                 skin_ > 0};
  if (keeps_stored_) {
    for (const std::uint32_t i : active) stored_[begin + i] = found.reports[i].stored;
  }
  while (!active.empty()) {
    const std::size_t in_batch = active.front() / sharing_.chunk, end = (in_batch + 1) * sharing_.chunk;
    const auto first = active.begin(), last = first + std::min(active.size(), sharing_.chunk);
    const auto of_chunk = active.first(std::lower_bound(first, last, end) - first);
    ChunkTotals& chunk = chunk_totals_[begin / sharing_.chunk + in_batch];
    kernels::ClosedChunk closed;
    kernels_.close(books, of_chunk.data(), of_chunk.size(), chunk, closed);
    for (const std::uint32_t i : closed.met) loads_.gather(model, pairs_, piece_pairs(), begin + i, true);
    for (const std::uint32_t i : closed.parted) loads_.gather(model, pairs_, piece_pairs(), begin + i, false);
    for (const std::uint32_t i : closed.short_of_room) note_short_of_room(begin + i, i, found);
    if (!closed.finite) chunk.unsound = first_unsound(begin, of_chunk, found);
    active = active.subspan(of_chunk.size());
  }
}

/// The first pair with a report that is no number.
std::uint32_t ContactStage::first_unsound(std::size_t begin, std::span<const std::uint32_t> active,
                                          const Workspace& found) {
  for (const std::uint32_t i : active) {
    const PairReport& r = found.reports[i];
    if (!std::isfinite(r.penetration + r.stored + r.slip_loss + r.damping_power + r.damping_force) ||
        std::isnan(r.gap))
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

}  // namespace talus
