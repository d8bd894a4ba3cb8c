#pragma once

#include "contact/contact_stage.hpp"
#include "model/model.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace talus {

struct CriticalStep {
  double dt;         ///< s; infinite if nothing vibrates
  double spring_dt;  ///< s, with contacts and supports alone, undamped, among fixed things: see StepVote
  std::uint32_t body, spring_body;  ///< who limits them
  bool strained;                    ///< dt mostly by strain modes, not by contacts
  double lambda;  ///< 1/s², no vibration has a larger square of its angular frequency, of those who vote
};

/// Where a step is less of the critical one than this, energy that is lost has hardly to do with it.
inline constexpr double hardly_the_step = 0.1;

/// In words, who limits the critical step.
std::string limiter_of(const Scene& scene, const CriticalStep& step);

/// Upper bound of the stable step of central differences: the smallest vote of all moving bodies, each over
/// its strain modes, its whole boundary in contact, and its penalty supports together. Tangential springs and
/// dashpots are included.
///
/// A contact between moving bodies a and b is split by (q_a − q_b)² ≤ (1 + √(m_a/m_b)) q_a² + (1 +
/// √(m_b/m_a)) q_b², so the votes of single bodies bound the coupled system; with a fixed body the factor
/// is 1. Who meets whom changes, and with it that factor alone.
///
/// A bounce is as accurate as its springs are resolved. Strain modes, dashpots, which lag by half a step, and
/// neighbours that move against each other make the stable step shorter, but a bounce no less accurate; so
/// the automatic step is a share of the bound with springs alone, as if nothing else moved, and kept below
/// the stable one. Two rigid equals that bounce off each other swing as fast as either held on both sides.
class StepVote {
 public:
  StepVote(const Scene& scene, const StageSettings& settings, const Model& model,
           const ContactStage& contacts);

  /// Whoever meets whom.
  CriticalStep anyhow() const;
  /// While each body meets none lighter than `lightest` [body], kg per metre of thickness; infinite: it meets
  /// fixed bodies only. And one that is held none heavier than `heaviest` [body]; empty: any. Never shorter
  /// than anyhow().
  CriticalStep among(std::span<const double> lightest, std::span<const double> heaviest = {}) const;

 private:
  /// The largest eigenvalue is convex in the factor of the contact springs: between none and the largest it
  /// stays below the chord.
  struct Ballot {
    double lambda_alone, lambda;  ///< 1/s², without contacts, and with the springs times `factor`
    double gamma_alone, gamma;    ///< 1/s, without dashpots of contacts, and with all of them
    double factor, mass;
    bool strained;  ///< see CriticalStep
    bool held;      ///< its dashpots go by the heaviest that it may meet
  };
  struct Shares {
    double springs, dashpots;
  };
  Shares shares_of(const Ballot& ballot, double lightest, double heaviest) const;
  double longest_step_of(const Ballot& ballot) const;
  static double lambda_of(const Ballot& ballot, double share);
  static double step_of(const Ballot& ballot, Shares shares);
  template <class Share>
  CriticalStep count(const Share& share) const;
  void drop_beyond(double longest);

  std::vector<Ballot> ballots_;  ///< one for all that vote alike
  /// Bodies that may limit the step, whoever meets whom.
  struct Voter {
    std::uint32_t body, ballot;
  };
  std::vector<Voter> voters_;
  double heaviest_ = 0;  ///< kg per metre of thickness, of all that a held one may meet
  double spring_dt_ = std::numeric_limits<double>::infinity();  ///< s, the shortest
  std::uint32_t spring_body_ = 0;
};

/// The automatic step, s: min(safety · spring_dt, max(0.8, safety) · dt); safety · dt without springs.
double automatic_step(const CriticalStep& critical, double safety);

/// In words, who limits the automatic step.
std::string limiter_of_automatic(const Scene& scene, const CriticalStep& step);

/// What the treatment of slivers does to the stable step of a body without its contacts.
struct SliverEffect {
  std::uint32_t body;
  std::size_t tied, heavier;  ///< patches merged into their neighbours, patches with inertia added
  double dt, untreated_dt;    ///< s
};
std::vector<SliverEffect> sliver_effects(const Scene& scene, const Model& model);

}  // namespace talus
