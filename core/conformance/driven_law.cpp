#include "conformance/driven_law.hpp"

#include "conformance/guarded.hpp"

#include "conformance/boundary_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace talus::conformance {
namespace {

constexpr double nothing_kept = std::numeric_limits<double>::quiet_NaN();

template <class T>
std::span<const T> span_of(const std::vector<T>& values) {
  return values;
}

}  // namespace

double Evaluation::size() const {
  double sum = 0;
  for (const LoadedCorner& load : corners) sum += std::hypot(load.force.x, load.force.y);
  return sum;
}

Vec2 Evaluation::net_force() const {
  Vec2 sum;
  for (const LoadedCorner& load : corners) sum.x += load.force.x, sum.y += load.force.y;
  return sum;
}

double Evaluation::net_moment() const {
  double sum = 0;
  const Vec2 about = corners.empty() ? Vec2{} : corners[0].at;
  for (const LoadedCorner& load : corners) {
    sum += (load.at.x - about.x) * load.force.y - (load.at.y - about.y) * load.force.x;
  }
  return sum;
}

Vec2 Evaluation::on(std::uint32_t body) const {
  return forces[body].force;
}

double Evaluation::moment_on(std::uint32_t body, Vec2 reference) const {
  double sum = 0;
  for (const LoadedCorner& load : corners) {
    if (load.body != body) continue;
    sum += (load.reference.x - reference.x) * load.force.y - (load.reference.y - reference.y) * load.force.x;
  }
  return sum;
}

DrivenLaw::DrivenLaw(const RegisteredComponent& component, const Values& interface, const Values& parameters)
    : component_(&component),
      law_(make<ContactModel>(
          component,
          in_order({component.component->parameters, component.component->parameter_count}, parameters))) {
  set_interfaces({interface}, [](std::uint32_t, std::uint32_t) { return 0U; });
}

std::vector<double> DrivenLaw::prepared(const Values& interface) const {
  Guarded<double> values(in_order(
      {component_->component->interface_parameters, component_->component->interface_parameter_count},
      interface));
  law_->prepare_interface(values.data());
  return {values.begin(), values.end()};
}

void DrivenLaw::set_interfaces(const std::vector<Values>& rows,
                               const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& row) {
  rows_.clear();
  for (const Values& values : rows) rows_.push_back(prepared(values));
  row_ = row;
}

Evaluation DrivenLaw::look(double dt) {
  const History before = history;
  Evaluation result = evaluate(dt);
  history = before;
  return result;
}

Evaluation DrivenLaw::step(double dt) {
  for (HeldBody& body : bodies) {
    BodyMotion& m = body.motion;
    m.u.x += dt * m.velocity.x, m.u.y += dt * m.velocity.y;
    m.h.xx += dt * m.rate.xx, m.h.xy += dt * m.rate.xy, m.h.yx += dt * m.rate.yx, m.h.yy += dt * m.rate.yy;
  }
  return evaluate(dt);
}

GivenBatch DrivenLaw::given(double dt) {
  if (met.empty()) {
    for (std::uint32_t a = 0; a < bodies.size(); ++a) {
      for (std::uint32_t b = a + 1; b < bodies.size(); ++b) met.emplace_back(a, b);
    }
  }
  const BoundaryArrays arrays(bodies);
  GivenBatch batch;
  batch.doubles_per_contact = law_->doubles_per_contact();
  batch.dt = dt, batch.hold_stick = hold_stick, batch.bonds_form = bonds_form;
  give_boundaries(arrays, batch);
  give_interfaces(batch);
  give_pairs(arrays, batch);
  give_history(batch);
  batch.active.resize(batch.pairs.size(), 0);
  std::iota(batch.active.begin(), batch.active.end(), 0U);
  return batch;
}

void DrivenLaw::give_boundaries(const BoundaryArrays& arrays, GivenBatch& batch) {
  batch.corners = Guarded(span_of(arrays.corners));
  batch.piece_start = Guarded(span_of(arrays.piece_start));
  batch.is_strip = Guarded(span_of(arrays.is_strip));
  batch.clear_depth = Guarded(span_of(arrays.clear_depth));
  batch.straight_beyond = Guarded(span_of(arrays.straight_beyond));
  batch.first_piece = Guarded(span_of(arrays.body_piece));
  for (const BoundaryCorner& corner : arrays.corners) {
    if (corner.surface != internal_side)
      batch.surface_count = std::max(batch.surface_count, corner.surface + 1);
  }
}

void DrivenLaw::give_interfaces(GivenBatch& batch) const {
  batch.row.resize(std::size_t{batch.surface_count} * batch.surface_count, 0);
  for (std::uint32_t i = 0; i < batch.surface_count; ++i) {
    for (std::uint32_t j = 0; j < batch.surface_count; ++j)
      batch.row[i * batch.surface_count + j] = row_(i, j);
  }
  std::vector<double> values;
  for (const auto& one : rows_) values.insert(values.end(), one.begin(), one.end());
  batch.values = Guarded(span_of(values));
  batch.parameter_count = component_->component->interface_parameter_count;
}

void DrivenLaw::give_pairs(const BoundaryArrays& arrays, GivenBatch& batch) {
  std::vector<BodyPair> pairs;
  std::vector<PiecePair> piece_pairs;
  for (const auto& [a, b] : met) {
    const HeldBody &one = bodies[a], &other = bodies[b];
    const PairState fresh{{}, 0, next_slot(), first_capacity};
    const PairState& state = history.try_emplace({a, b}, fresh).first->second;
    BodyPair pair{};
    pair.a = a, pair.b = b;
    pair.offset_x = other.centre.x - one.centre.x, pair.offset_y = other.centre.y - one.centre.y;
    pair.master_halves = static_cast<std::uint16_t>(2 * master_share);
    pair.reduced_mass = static_cast<float>(one.mass * other.mass / (one.mass + other.mass));
    pair.slot_start = state.slot_start, pair.slot_capacity = state.capacity;
    pair.contact_count = state.contacts;
    pair.load_start = batch.load_count;
    const std::uint32_t surfaces[] = {arrays.plain_surface(a), arrays.plain_surface(b)};
    if (plain && surfaces[0] != internal_side && surfaces[1] != internal_side) {
      describe_plain(pair, arrays.body_piece[a], arrays.body_piece[b], arrays.view(),
                     batch.row[surfaces[0] * batch.surface_count + surfaces[1]]);
      batch.load_count += pair.plain_corners[0] + pair.plain_corners[1];
    } else {
      pair.piece_pair_range[0] = static_cast<std::uint32_t>(piece_pairs.size());
      for (std::uint32_t p = arrays.body_piece[a]; p < arrays.body_piece[a + 1]; ++p) {
        for (std::uint32_t q = arrays.body_piece[b]; q < arrays.body_piece[b + 1]; ++q) {
          piece_pairs.push_back({p, q, batch.load_count});
          batch.load_count += batch.corners_of(piece_pairs.back());
        }
      }
      pair.piece_pair_range[1] = static_cast<std::uint32_t>(piece_pairs.size());
    }
    pairs.push_back(pair);
  }
  batch.pairs = Guarded(span_of(pairs));
  batch.piece_pairs = Guarded(span_of(piece_pairs));
}

void DrivenLaw::give_history(GivenBatch& batch) const {
  const std::size_t doubles = batch.doubles_per_contact;
  batch.slot_count = next_slot();
  std::vector<double> kept(batch.slot_count * doubles, nothing_kept);
  for (std::size_t i = 0; i < met.size(); ++i) {
    const std::vector<double>& of_pair = history.at(met[i]).history;
    std::ranges::copy(of_pair,
                      kept.begin() + static_cast<std::ptrdiff_t>(batch.pairs[i].slot_start * doubles));
  }
  batch.history = Guarded(span_of(kept));
}

std::uint32_t DrivenLaw::next_slot() const {
  std::uint32_t next = 0;
  for (const auto& [bodies_of_pair, state] : history)
    next = std::max(next, state.slot_start + state.capacity);
  return next;
}

Evaluation DrivenLaw::evaluate(double dt) {
  for (int asked = 0; asked < 4; ++asked) {
    const GivenBatch batch = given(dt);
    TakenLoads taken(batch, 0xFF);
    law_->evaluate(batch.view(), taken.view());
    if (!had_room(batch, taken)) continue;
    Evaluation result;
    result.forces.resize(bodies.size());
    result.pairs.assign(taken.pairs.begin(), taken.pairs.end());
    const BoundaryArrays arrays(bodies);
    for (std::size_t i = 0; i < batch.pairs.size(); ++i) {
      take_contacts(i, batch, taken, result);
      if (taken.pairs[i].contact_count > 0)  // else a law need not write its loads
        take_loads(batch.pairs[i], batch, taken, arrays, result);
    }
    return result;
  }
  throw std::runtime_error("the law asks for room for more contacts again and again");
}

bool DrivenLaw::had_room(const GivenBatch& batch, const TakenLoads& taken) {
  bool room = true;
  for (std::size_t i = 0; i < batch.pairs.size(); ++i) {
    PairState& state = history[met[i]];
    const std::uint32_t count = taken.pairs[i].contact_count;
    if (count <= state.capacity) continue;
    if (count > 100000) throw std::runtime_error(fmt::format("a pair reports {} contacts", count));
    // A pair gets other slots, behind all there are; one that has had none moves nothing a plan may know.
    if (state.capacity > 0) ++layout;
    state.slot_start = next_slot();
    state.capacity = count;
    room = false;
  }
  return room;
}

void DrivenLaw::take_contacts(std::size_t i, const GivenBatch& batch, const TakenLoads& taken,
                              Evaluation& result) {
  PairState& state = history[met[i]];
  const std::size_t doubles = batch.doubles_per_contact, start = batch.pairs[i].slot_start;
  state.contacts = taken.pairs[i].contact_count;
  const double* begin = taken.history.data() + start * doubles;
  state.history.assign(begin, begin + state.contacts * doubles);
  result.history.insert(result.history.end(), state.history.begin(), state.history.end());
  for (std::uint32_t c = 0; c < state.contacts; ++c) result.contacts.push_back(taken.reports[start + c]);
}

void DrivenLaw::take_loads(const BodyPair& pair, const GivenBatch& batch, const TakenLoads& taken,
                           const BoundaryArrays& arrays, Evaluation& result) const {
  const PiecePairs all = batch.all_piece_pairs();
  for (const PiecePair pieces : all.of(pair)) {
    std::uint32_t load = pieces.load_start;
    for (const std::uint32_t piece : {pieces.a, pieces.b}) {
      for (std::uint32_t c = arrays.piece_start[piece]; c < arrays.piece_start[piece + 1]; ++c, ++load) {
        const Vec2 force{taken.corner[load].x, taken.corner[load].y};
        if (force.x == 0 && force.y == 0) continue;
        const BoundaryCorner& corner = arrays.corners[c];
        const std::uint32_t body = arrays.corner_body[c];
        const Vec2 centre = bodies[body].centre;
        const std::uint32_t before =
            c == arrays.piece_start[piece] ? arrays.piece_start[piece + 1] - 1 : c - 1;
        const bool carries =
            corner.surface != internal_side || arrays.corners[before].surface != internal_side;
        result.corners.push_back(
            {body, {centre.x + corner.x, centre.y + corner.y}, arrays.reference[c], force, carries});
        result.forces[body].add(arrays.reference[c], force);
      }
    }
  }
}

}  // namespace talus::conformance
