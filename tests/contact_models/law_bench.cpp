#include "contact_models/law_bench.hpp"

#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace talus::bench {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Values of a table in declared order, as the scene reader would hand them over.
std::vector<double> in_order(const Parameter* table, std::uint32_t count, const Values& given) {
  std::vector<double> values;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto found = given.find(table[i].key);
    const double value = found != given.end() ? found->second : table[i].default_value;
    if (std::isnan(value)) throw std::logic_error(std::string("the bench needs a value for ") + table[i].key);
    values.push_back(std::string(table[i].unit) == "deg" ? value * degree : value);
  }
  return values;
}

Vec2 times(const Matrix2& m, Vec2 p) {
  return {m.xx * p.x + m.xy * p.y, m.yx * p.x + m.yy * p.y};
}

/// Q M Qᵀ.
Matrix2 conjugated(const Matrix2& q, const Matrix2& m) {
  const Vec2 x = times(q, {m.xx, m.yx}), y = times(q, {m.xy, m.yy});  // columns of Q M
  return {x.x * q.xx + y.x * q.xy, x.x * q.yx + y.x * q.yy, x.y * q.xx + y.y * q.xy, x.y * q.yx + y.y * q.yy};
}

}  // namespace

Registry& registry() {
  static Registry all = [] {
    Registry made;
    const std::filesystem::path folder = TALUS_PLUGINS;
    load_folders(made, {&folder, 1});
    if (!made.refused.empty()) throw std::runtime_error(made.refused[0].reason);
    return made;
  }();
  return all;
}

std::vector<std::string> laws() {
  return registry().names(ComponentKind::contact_model);
}

Values lively_interface() {
  return {{"normal_stiffness", 1e9},
          {"tangential_stiffness", 7e8},
          {"friction_angle", 25},
          {"normal_damping", 0.2},
          {"tangential_damping", 0.3}};
}

Values undamped_interface() {
  return with(lively_interface(), {{"normal_damping", 0}, {"tangential_damping", 0}});
}

Values with(Values values, const Values& changes) {
  for (const auto& [key, value] : changes) values[key] = value;
  return values;
}

HeldBody held(const std::vector<Vec2>& outline, const std::vector<std::uint32_t>& surfaces) {
  const AreaMoments moments = ring_moments(outline, outline[0]);
  HeldBody body;
  body.centre = {outline[0].x + moments.x / moments.area, outline[0].y + moments.y / moments.area};
  Loop loop;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    loop.vertices.push_back(body.reference_of(outline[i]));
    loop.surface_class.push_back(surfaces.empty() ? 0 : surfaces[i]);
  }
  body.pieces = convex_pieces(loop, {});
  return body;
}

HeldBody box(double left, double bottom, double right, double top) {
  return held({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

Isometry turned_by(double degrees) {
  const double c = std::cos(degrees * degree), s = std::sin(degrees * degree);
  return {{c, -s, s, c}, {0, 0}};
}

Isometry mirrored() {
  return {{-1, 0, 0, 1}, {0, 0}};
}

HeldBody moved(const Isometry& isometry, const HeldBody& body) {
  const Matrix2& q = isometry.q;
  const bool mirrors = q.xx * q.yy - q.xy * q.yx < 0;
  HeldBody result = body;
  result.centre = times(q, body.centre);
  result.centre.x += isometry.shift.x;
  result.centre.y += isometry.shift.y;
  result.motion.u = times(q, body.motion.u);
  result.motion.velocity = times(q, body.motion.velocity);
  result.motion.h = conjugated(q, body.motion.h);
  result.motion.rate = conjugated(q, body.motion.rate);
  for (ConvexPiece& piece : result.pieces) {
    for (PieceCorner& corner : piece) corner.at = times(q, corner.at);
    if (!mirrors) continue;
    // The ring runs the other way; a side now starts where it ended.
    const ConvexPiece old = piece;
    const std::size_t n = old.size();
    for (std::size_t i = 0; i < n; ++i) {
      piece[i] = old[(2 * n - 2 - i) % n];
      piece[i].at = old[n - 1 - i].at;
    }
  }
  return result;
}

BodyForce moved(const Isometry& isometry, const BodyForce& force) {
  return {times(isometry.q, force.force), conjugated(isometry.q, force.moment)};
}

double Evaluation::size() const {
  double sum = 0;
  for (const CornerLoad& load : corners) sum += std::hypot(load.force.x, load.force.y);
  return sum;
}

Vec2 Evaluation::net_force() const {
  Vec2 sum;
  for (const CornerLoad& load : corners) sum.x += load.force.x, sum.y += load.force.y;
  return sum;
}

double Evaluation::net_moment() const {
  double sum = 0;
  const Vec2 about = corners.empty() ? Vec2{} : corners[0].at;
  for (const CornerLoad& load : corners) {
    sum += (load.at.x - about.x) * load.force.y - (load.at.y - about.y) * load.force.x;
  }
  return sum;
}

Vec2 Evaluation::on(std::uint32_t body) const {
  return forces[body].force;
}

LawBench::LawBench(const std::string& law, const Values& interface, const Values& parameters)
    : component_(registry().find(ComponentKind::contact_model, law)),
      law_(make<ContactModel>(*component_, in_order(component_->component->parameters,
                                                    component_->component->parameter_count, parameters))) {
  set_interfaces({interface}, [](std::uint32_t, std::uint32_t) { return 0U; });
}

std::vector<double> LawBench::prepared(const Values& interface) const {
  std::vector<double> values = in_order(component_->component->interface_parameters,
                                        component_->component->interface_parameter_count, interface);
  law_->prepare_interface(values.data());
  return values;
}

void LawBench::set_interfaces(const std::vector<Values>& rows,
                              const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& row) {
  rows_.clear();
  for (const Values& values : rows) rows_.push_back(prepared(values));
  row_ = row;
}

Evaluation LawBench::look(double dt) {
  const auto before = states_;
  Evaluation result = evaluate(dt);
  states_ = before;
  return result;
}

Evaluation LawBench::step(double dt) {
  for (HeldBody& body : bodies) {
    BodyMotion& m = body.motion;
    m.u.x += dt * m.velocity.x, m.u.y += dt * m.velocity.y;
    m.h.xx += dt * m.rate.xx, m.h.xy += dt * m.rate.xy, m.h.yx += dt * m.rate.yx, m.h.yy += dt * m.rate.yy;
  }
  return evaluate(dt);
}

Evaluation LawBench::evaluate(double dt) {
  const BoundaryArrays arrays(bodies);
  const std::uint32_t doubles = law_->doubles_per_contact();
  std::uint32_t surfaces = 1;
  for (const BoundaryCorner& corner : arrays.corners) {
    if (corner.surface != internal_side) surfaces = std::max(surfaces, corner.surface + 1);
  }
  std::vector<std::uint32_t> row(std::size_t{surfaces} * surfaces);
  for (std::uint32_t i = 0; i < surfaces; ++i) {
    for (std::uint32_t j = 0; j < surfaces; ++j) row[i * surfaces + j] = row_(i, j);
  }
  std::vector<double> values;
  for (const auto& one : rows_) values.insert(values.end(), one.begin(), one.end());

  for (;;) {
    std::vector<BodyPair> pairs;
    std::vector<PiecePair> piece_pairs;
    std::vector<double> history;
    std::uint32_t loads = 0, slots = 0;
    for (std::uint32_t a = 0; a < bodies.size(); ++a) {
      for (std::uint32_t b = a + 1; b < bodies.size(); ++b) {
        const HeldBody &one = bodies[a], &other = bodies[b];
        PairState& state = states_[{a, b}];
        BodyPair pair{};
        pair.a = a, pair.b = b;
        pair.piece_pair_start = static_cast<std::uint32_t>(piece_pairs.size());
        for (std::uint32_t p = arrays.body_piece[a]; p < arrays.body_piece[a + 1]; ++p) {
          for (std::uint32_t q = arrays.body_piece[b]; q < arrays.body_piece[b + 1]; ++q) {
            piece_pairs.push_back({p, q, loads});
            loads += arrays.piece_start[p + 1] - arrays.piece_start[p];
            loads += arrays.piece_start[q + 1] - arrays.piece_start[q];
          }
        }
        pair.piece_pair_end = static_cast<std::uint32_t>(piece_pairs.size());
        pair.offset_x = other.centre.x - one.centre.x, pair.offset_y = other.centre.y - one.centre.y;
        pair.master_share = master_share;
        const std::uint32_t corners[] = {arrays.plain_corners(a), arrays.plain_corners(b)};
        if (plain && corners[0] > 0 && corners[1] > 0) pair.plain_corners = std::max(corners[0], corners[1]);
        pair.reduced_mass = one.mass * other.mass / (one.mass + other.mass);
        pair.slot_start = slots, pair.slot_capacity = state.capacity, pair.contact_count = state.contacts;
        slots += state.capacity;
        history.resize(std::size_t{slots} * doubles, not_a_number);
        std::copy(state.history.begin(), state.history.end(),
                  history.begin() + std::size_t{pair.slot_start} * doubles);
        pairs.push_back(pair);
      }
    }
    std::vector<double> fx(loads, 0.0), fy(loads, 0.0), next(history.size(), not_a_number);
    std::vector<ContactReport> reports(slots);
    std::vector<PairReport> pair_reports(
        pairs.size(), {77, not_a_number, not_a_number, not_a_number, not_a_number, not_a_number});
    std::vector<std::uint32_t> active(pairs.size());
    std::iota(active.begin(), active.end(), 0U);
    const ContactBatch batch{
        arrays.view(),
        {row.data(), values.data(), surfaces, component_->component->interface_parameter_count},
        pairs.data(),
        piece_pairs.data(),
        history.data(),
        active.data(),
        static_cast<std::uint32_t>(active.size()),
        dt,
        hold_stick,
        bonds_form};
    law_->evaluate(batch, {fx.data(), fy.data(), next.data(), reports.data(), pair_reports.data()});

    bool short_of_room = false;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      PairState& state = states_[{pairs[i].a, pairs[i].b}];
      if (pair_reports[i].contact_count <= state.capacity) continue;
      state.capacity = pair_reports[i].contact_count;
      short_of_room = true;
    }
    if (short_of_room) continue;

    Evaluation result;
    result.forces.resize(bodies.size());
    result.pairs = pair_reports;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      PairState& state = states_[{pairs[i].a, pairs[i].b}];
      state.contacts = pair_reports[i].contact_count;
      const auto begin = next.begin() + std::size_t{pairs[i].slot_start} * doubles;
      state.history.assign(begin, begin + std::size_t{state.contacts} * doubles);
      result.history.insert(result.history.end(), state.history.begin(), state.history.end());
      for (std::uint32_t c = 0; c < state.contacts; ++c) {
        result.contacts.push_back(reports[pairs[i].slot_start + c]);
      }
    }
    for (const PiecePair& pair : piece_pairs) {
      std::uint32_t load = pair.load_start;
      for (const std::uint32_t piece : {pair.a, pair.b}) {
        for (std::uint32_t c = arrays.piece_start[piece]; c < arrays.piece_start[piece + 1]; ++c, ++load) {
          if (fx[load] == 0 && fy[load] == 0) continue;
          const std::uint32_t body = arrays.corner_body[c];
          const Vec2 centre = bodies[body].centre;
          result.corners.push_back({body,
                                    {centre.x + arrays.corners[c].x, centre.y + arrays.corners[c].y},
                                    arrays.reference[c],
                                    {fx[load], fy[load]}});
          result.forces[body].add(arrays.reference[c], {fx[load], fy[load]});
        }
      }
    }
    return result;
  }
}

}  // namespace talus::bench
