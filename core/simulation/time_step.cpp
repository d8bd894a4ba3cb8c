#include "simulation/time_step.hpp"

#include "simulation/body_vote.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace talus {
namespace {

constexpr std::size_t most_compared = 64;    ///< bodies that vote differently, to which others are compared
constexpr double rounded = 1 + 1e-9;         ///< by how much rounding may make a step longer, and more
constexpr double most_contacts_on_side = 3;  ///< of a body of many elements, that act on one side at once

/// The stiffest springs a side can meet on any other body, lumped at its ends.
SideSprings stiffest_meeting(const Body& body, std::uint32_t surface, double length,
                             const ContactStage& contacts, const Meetings& met, bool spread) {
  ContactStiffness most{};
  const Interfaces& interfaces = contacts.interfaces();
  for (std::uint32_t other = 0; other < interfaces.surface_count; ++other) {
    if (!met.surfaces[other]) continue;
    const std::uint32_t row = interfaces.row[surface * interfaces.surface_count + other];
    const ContactStiffness here = contacts.law()->stiffness(
        interfaces.value + std::size_t{row} * interfaces.parameter_count, length / 2);
    most.normal = std::max(most.normal, here.normal);
    most.tangential = std::max(most.tangential, here.tangential);
    most.normal_damping_ratio = std::max(most.normal_damping_ratio, here.normal_damping_ratio);
    most.tangential_damping_ratio = std::max(most.tangential_damping_ratio, here.tangential_damping_ratio);
  }
  // c = 2ζ√(k m) shared along the side: c/k = 2ζ√(m/k) with k of the whole side, two corners. Several short
  // contacts on one side of a body of many elements add up to more than one long one.
  const double pieces = body.kinematics == Kinematics::covered ? most_contacts_on_side : 1;
  const auto damping = [&](double stiffness, double ratio) {
    return stiffness > 0
               ? met.damping_factor * 2 * ratio * std::sqrt(pieces * met.dashpot_mass * stiffness / 2)
               : 0.0;
  };
  return {.normal = most.normal,
          .tangential = most.tangential,
          .normal_damping = damping(most.normal, most.normal_damping_ratio),
          .tangential_damping = damping(most.tangential, most.tangential_damping_ratio),
          .spread = spread};
}

double length_of(const BoundarySide& side) {
  const double dx = side.end.reference.x - side.start.reference.x;
  const double dy = side.end.reference.y - side.start.reference.y;
  return std::sqrt(dx * dx + dy * dy);
}

/// What all bodies show each other, counted once.
class Crowd {
 public:
  Crowd(const Model& model, std::span<const Support> supports, std::size_t surface_count)
      : model_(model), supports_(supports), showing_(surface_count, 0) {
    for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
      for (const std::uint32_t surface : surfaces_of(model.bodies[i])) ++showing_[surface];
      if (!model.moves(i)) continue;
      const double mass = model.bodies[i].contact_mass;
      if (!is_held(i)) heaviest_ = std::max(heaviest_, mass);
      if (is_held(i) && model.bodies[i].kinematics == Kinematics::rigid) continue;
      if (mass < lightest_) {
        second_lightest_ = lightest_;
        lightest_ = mass;
        lightest_body_ = i;
      } else {
        second_lightest_ = std::min(second_lightest_, mass);
      }
    }
  }

  /// Whether others meet it as a fixed body.
  bool is_held(std::uint32_t index) const {
    return model_.moves_as_a_whole(index) && support_of(supports_, index).all();
  }

  /// kg per metre of thickness, of those that are not held.
  double heaviest() const { return heaviest_; }

  /// What a body can meet: all others, and itself where it may.
  Meetings met_by(std::uint32_t index) const {
    const Body& own = model_.bodies[index];
    Meetings result{std::vector<char>(showing_.size(), 0)};
    result.dashpot_mass = is_held(index) ? std::max(heaviest_, own.contact_mass) : own.contact_mass;
    std::vector<std::size_t> others = showing_;
    if (!own.meets_itself) {
      for (const std::uint32_t surface : surfaces_of(own)) --others[surface];
    }
    for (std::size_t i = 0; i < others.size(); ++i) result.surfaces[i] = others[i] > 0 ? 1 : 0;
    const double lightest = index == lightest_body_ && !own.meets_itself ? second_lightest_ : lightest_;
    if (std::isfinite(lightest)) {
      result.stiffness_factor = 1 + std::sqrt(own.contact_mass / lightest);
      // c = 2ζ√(k m_a m_b/(m_a + m_b)) split alike: (1 + √r)/√(1 + r) is at most √2.
      result.damping_factor = std::sqrt(2.0);
    }
    return result;
  }

 private:
  std::vector<std::uint32_t> surfaces_of(const Body& body) const {
    std::vector<std::uint32_t> surfaces;
    for (std::uint32_t c = body.corner_begin; c < body.corner_end; ++c) {
      if (model_.surface[c] != internal_side) surfaces.push_back(model_.surface[c]);
    }
    std::sort(surfaces.begin(), surfaces.end());
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    return surfaces;
  }

  const Model& model_;
  std::span<const Support> supports_;
  std::vector<std::size_t> showing_;  ///< [surface] how many bodies have it
  double heaviest_ = 0;               ///< of those whose mass dashpots meet
  double lightest_ = std::numeric_limits<double>::infinity(), second_lightest_ = lightest_;
  std::uint32_t lightest_body_ = 0;
};

/// Dashpots of an absorbing boundary: the stiffer of the two at both ends.
double impedance(const Scene& scene, std::uint32_t body) {
  const SceneMaterial& material = scene.materials[scene.bodies[body].material];
  double tangent[9];
  make<Material>(*material.model.component, material.model.values)->stiffest_tangent(tangent);
  return std::sqrt(material.density * tangent[0]);
}

SpringsOfSides springs_of(const Scene& scene, const StageSettings& settings, const Model& model,
                          const ContactStage& contacts, const Meetings& met, std::uint32_t index) {
  const Body& body = model.bodies[index];
  const std::vector<BoundarySide> sides = boundary_of(scene, model, index);
  SpringsOfSides springs(sides.size());
  const auto on_surface = [&](std::uint32_t surface, const auto& visit) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (sides[i].surface == surface) visit(springs[i], length_of(sides[i]));
    }
  };
  if (contacts.law() != nullptr) {
    const bool spread = (scene.contact.component->component->traits & trait::spread_springs) != 0;
    for (std::size_t i = 0; i < sides.size(); ++i)
      springs[i] = stiffest_meeting(body, sides[i].surface, length_of(sides[i]), contacts, met, spread);
  }
  for (const PrescribedSurface& prescribed : settings.prescribed) {
    if (prescribed.body != index) continue;
    on_surface(prescribed.surface_class,
               [&](SideSprings& side, double length) { side.support += prescribed.stiffness * length / 2; });
  }
  for (const AbsorbingSurface& absorbing : settings.absorbing) {
    if (absorbing.body != index) continue;
    on_surface(absorbing.surface_class, [&](SideSprings& side, double length) {
      side.support_damping += impedance(scene, index) * length / 2;
    });
  }
  return springs;
}

/// Central differences with dashpots taken at t_n − Δt/2: Δt² λ/4 + Δt γ/2 ≤ 1.
double stable_step(double lambda, double gamma) {
  if (!(lambda > 0)) return std::numeric_limits<double>::infinity();
  return 2 * (std::sqrt(gamma * gamma / 4 + lambda) - gamma / 2) / lambda;
}

/// Bodies alike in shape, material and meetings vote alike; walls and columns have few different ones.
bool votes_alike(const Scene& scene, const StageSettings& settings, const Model& model, std::uint32_t i,
                 std::uint32_t j) {
  const Body &p = model.bodies[i], &q = model.bodies[j];
  if (p.kinematics != q.kinematics || scene.bodies[i].material != scene.bodies[j].material) return false;
  if (p.kinematics == Kinematics::covered || p.strain_mass_scale != q.strain_mass_scale) return false;
  if (support_of(settings.supports, i).any() || support_of(settings.supports, j).any()) return false;
  if (p.corner_end - p.corner_begin != q.corner_end - q.corner_begin) return false;
  for (std::uint32_t c = 0; c < p.corner_end - p.corner_begin; ++c) {
    const std::uint32_t a = p.corner_begin + c, b = q.corner_begin + c;
    const double near = 1e-9 * p.width;
    if (std::abs(model.reference_x[a] - model.reference_x[b]) > near) return false;
    if (std::abs(model.reference_y[a] - model.reference_y[b]) > near) return false;
    if (model.surface[a] != model.surface[b]) return false;
  }
  return settings.prescribed.empty() && settings.absorbing.empty();
}

struct Vote : BodyVote {
  double factor;        ///< of stiffness, for what it meets
  bool contacts_alone;  ///< it has no springs but those of contacts
};

Vote vote_of(const Scene& scene, const StageSettings& settings, const Model& model,
             const ContactStage& contacts, const PatchMass& mass, const Crowd& crowd, std::uint32_t body) {
  const Meetings met = crowd.met_by(body);
  const SpringsOfSides springs = springs_of(scene, settings, model, contacts, met, body);
  const double factor = contacts.law() != nullptr ? met.stiffness_factor : 1;
  const bool supported =
      std::any_of(springs.begin(), springs.end(), [](const SideSprings& side) { return side.support > 0; });
  const bool contacts_alone = !model.covered(body) && !supported && contacts.law() != nullptr;
  if (model.covered(body))
    return {vote_of_patches(scene, model, mass, body, springs, factor), factor, contacts_alone};
  const Support& support = support_of(settings.supports, body);
  return {vote_as_a_whole(scene, model, body, springs, support, factor), factor, contacts_alone};
}

/// Where most of the room is left over; what nobody has touched takes none.
template <class T>
void give_back(std::vector<T>& values) {
  if (values.size() < values.capacity() / 2) values.shrink_to_fit();
}

}  // namespace

StepVote::StepVote(const Scene& scene, const StageSettings& settings, const Model& model,
                   const ContactStage& contacts) {
  const Crowd crowd(model, settings.supports, scene.surfaces.size());
  const PatchMass mass(model);
  heaviest_ = crowd.heaviest();
  // Bodies that vote differently, as far as they are compared.
  struct Different {
    std::uint32_t body;
    Ballot ballot;
    double spring_lambda;                 ///< 1/s², of springs alone
    std::optional<std::uint32_t> number;  ///< in ballots_
  };
  std::vector<Different> different;
  // What is reserved and never used costs nothing; growing would leave holes in memory.
  ballots_.reserve(model.moving_bodies.size());
  voters_.reserve(model.moving_bodies.size());
  double longest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
    if (!model.moves(i)) continue;
    const Support& support = support_of(settings.supports, i);
    if (support.all() && model.bodies[i].kinematics == Kinematics::rigid) continue;
    auto alike = std::find_if(different.begin(), different.end(), [&](const Different& other) {
      return votes_alike(scene, settings, model, i, other.body);
    });
    Different here{i, {}, 0, {}};
    if (alike == different.end()) {
      const Vote vote = vote_of(scene, settings, model, contacts, mass, crowd, i);
      here.ballot = {vote.contacts_alone ? vote.elastic_lambda : vote.lambda,
                     vote.lambda,
                     vote.contacts_alone ? vote.gamma_alone : vote.gamma,
                     vote.gamma,
                     vote.factor,
                     model.bodies[i].contact_mass,
                     vote.elastic_lambda > 0.5 * vote.lambda,
                     contacts.law() != nullptr && crowd.is_held(i)};
      here.spring_lambda = vote.spring_lambda;
      if (different.size() < most_compared) {
        different.push_back(here);
        alike = different.end() - 1;
      }
    }
    Different& known = alike == different.end() ? here : *alike;
    const Ballot& ballot = known.ballot;
    const double bounce = stable_step(known.spring_lambda, 0);
    if (bounce < spring_dt_) {
      spring_dt_ = bounce;
      spring_body_ = i;
    }
    const double alone = longest_step_of(ballot);
    longest = std::min(longest, std::max(alone, step_of(ballot, {1, 1})));
    if (std::min(alone, step_of(ballot, {1, 1})) > rounded * longest) continue;
    if (!known.number) {
      known.number = static_cast<std::uint32_t>(ballots_.size());
      ballots_.push_back(ballot);
    }
    voters_.push_back({i, *known.number});
  }
  drop_beyond(rounded * longest);
}

/// Who never has a step so short leaves, and so do ballots of nobody else.
void StepVote::drop_beyond(double longest) {
  const auto beyond = [&](const Ballot& ballot) {
    return std::min(longest_step_of(ballot), step_of(ballot, {1, 1})) > longest;
  };
  constexpr std::uint32_t none = 0xFFFFFFFFu;
  std::vector<std::uint32_t> number(ballots_.size());
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < ballots_.size(); ++i) {
    number[i] = beyond(ballots_[i]) ? none : kept;
    if (number[i] != none) ballots_[kept++] = ballots_[i];
  }
  ballots_.resize(kept);
  std::erase_if(voters_, [&](const Voter& voter) { return number[voter.ballot] == none; });
  for (Voter& voter : voters_) voter.ballot = number[voter.ballot];
  give_back(ballots_);
  give_back(voters_);
}

double StepVote::step_of(const Ballot& ballot, Shares shares) {
  const double gamma = shares.dashpots == 1
                           ? ballot.gamma
                           : ballot.gamma_alone + shares.dashpots * (ballot.gamma - ballot.gamma_alone);
  return stable_step(lambda_of(ballot, shares.springs), gamma);
}

double StepVote::lambda_of(const Ballot& ballot, double share) {
  return ballot.lambda_alone + share * (ballot.lambda - ballot.lambda_alone);
}

double StepVote::longest_step_of(const Ballot& ballot) const {
  return step_of(ballot, shares_of(ballot, std::numeric_limits<double>::infinity(), 0));
}

/// Of the springs, where a body meets none lighter, and of the dashpots of one that is held, where it meets
/// none heavier: they go with √m.
StepVote::Shares StepVote::shares_of(const Ballot& ballot, double lightest, double heaviest) const {
  const double met = std::max(ballot.mass, heaviest);
  return {std::min(1.0, (1 + std::sqrt(ballot.mass / lightest)) / ballot.factor),
          ballot.held && met < heaviest_ ? std::sqrt(met / heaviest_) : 1};
}

template <class Share>
CriticalStep StepVote::count(const Share& share) const {
  CriticalStep smallest{std::numeric_limits<double>::infinity(), spring_dt_, 0, spring_body_, false, 0};
  for (const Voter& voter : voters_) {
    const Ballot& ballot = ballots_[voter.ballot];
    const Shares shares = share(ballot, voter.body);
    const double dt = step_of(ballot, shares);
    smallest.lambda = std::max(smallest.lambda, lambda_of(ballot, shares.springs));
    if (dt < smallest.dt) {
      smallest.dt = dt;
      smallest.body = voter.body;
      smallest.strained = ballot.strained;
    }
  }
  return smallest;
}

CriticalStep StepVote::anyhow() const {
  return count([](const Ballot&, std::uint32_t) { return Shares{1, 1}; });
}

CriticalStep StepVote::among(std::span<const double> lightest, std::span<const double> heaviest) const {
  return count([&](const Ballot& ballot, std::uint32_t body) {
    return shares_of(ballot, lightest[body],
                     heaviest.empty() ? std::numeric_limits<double>::infinity() : heaviest[body]);
  });
}

std::string limiter_of(const Scene& scene, const CriticalStep& step) {
  if (std::isinf(step.dt)) return "nothing vibrates";
  const char* springs = scene.contact.component == nullptr ? "mostly its supports"
                        : scene.prescribed.empty()         ? "mostly its contacts"
                                                           : "mostly its contacts and supports";
  return fmt::format("body '{}': {}", scene.bodies[step.body].name,
                     step.strained ? "mostly its strain modes" : springs);
}

double automatic_step(const CriticalStep& critical, double safety) {
  constexpr double most_of_stable = 0.8;
  if (std::isinf(critical.spring_dt)) return safety * critical.dt;
  return std::min(safety * critical.spring_dt, std::max(safety, most_of_stable) * critical.dt);
}

std::string limiter_of_automatic(const Scene& scene, const CriticalStep& step) {
  const double safety = scene.time.safety;
  if (std::isinf(step.spring_dt) || automatic_step(step, safety) < safety * step.spring_dt)
    return limiter_of(scene, step);
  return fmt::format("body '{}': its contacts and supports", scene.bodies[step.spring_body].name);
}

std::vector<SliverEffect> sliver_effects(const Scene& scene, const Model& model) {
  if (model.steady.empty()) return {};
  Model untreated = model;
  untreated.patch_mass = untreated.row_sum;
  for (CoverRanges& ranges : untreated.cover_ranges) ranges.steady_end = ranges.steady_begin;
  const PatchMass mass(model), mass_untreated(untreated);
  std::vector<SliverEffect> effects;
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    const CoverRanges& ranges = model.ranges(body);
    if (ranges.steady_begin == ranges.steady_end) continue;
    std::size_t tied = 0;
    for (std::uint32_t s = ranges.steady_begin; s < ranges.steady_end; ++s)
      tied += std::isinf(model.steady[s].inertia) ? 1 : 0;
    const BodyVote with = vote_of_patches(scene, model, mass, i, {}, 1),
                   without = vote_of_patches(scene, untreated, mass_untreated, i, {}, 1);
    effects.push_back({i, tied, ranges.steady_end - ranges.steady_begin - tied,
                       stable_step(with.lambda, with.gamma), stable_step(without.lambda, without.gamma)});
  }
  return effects;
}

}  // namespace talus
