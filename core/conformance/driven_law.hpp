#pragma once

#include "conformance/given_batch.hpp"
#include "conformance/held_body.hpp"
#include "conformance/sample_values.hpp"
#include "plugin/registry.hpp"

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace talus::conformance {

struct BoundaryArrays;

struct LoadedCorner {
  std::uint32_t body;
  Vec2 at;         ///< m, in the world
  Vec2 reference;  ///< m, from the centre of the body
  Vec2 force;      ///< N/m
  bool carries;    ///< the corner is an end of a side that is not internal
};

struct Evaluation {
  std::vector<LoadedCorner> corners;
  std::vector<BodyForce> forces;  ///< [body] ΣF and ΣF ⊗ X
  std::vector<PairReport> pairs;
  std::vector<ContactReport> contacts;  ///< of all pairs, one after the other
  std::vector<double> history;

  double size() const;                                         ///< N/m, Σ|F|
  Vec2 net_force() const;                                      ///< N/m
  double net_moment() const;                                   ///< N, about the first loaded corner
  Vec2 on(std::uint32_t body) const;                           ///< N/m, ΣF
  double moment_on(std::uint32_t body, Vec2 reference) const;  ///< N, about a place relative to its centre
};

/// Drives one contact law as the host does, without covers and masses around it. Throws std::runtime_error
/// where the law asks for room without end.
class DrivenLaw {
 public:
  explicit DrivenLaw(const RegisteredComponent& component, const Values& interface = lively_interface(),
                     const Values& parameters = {});

  std::vector<HeldBody> bodies;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> met;  ///< pairs of bodies; all of them if empty
  std::uint32_t first_capacity = 1;                          ///< slots of a pair before it has asked for any
  double master_share = 0.5;                                 ///< of the body of lower number, in every pair
  bool hold_stick = false, bonds_form = false;
  bool plain = true;  ///< false: bodies are never said to be plain, so every pair goes the general way

  /// Interface of surface classes i and j, where there are several.
  void set_interfaces(const std::vector<Values>& rows,
                      const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& row);

  /// Evaluates in the present place; history stays as it was.
  Evaluation look(double dt = 1e-4);
  /// Bodies move with their velocities for dt, the law is evaluated there, history goes on.
  Evaluation step(double dt = 1e-4);
  /// What a call at the present place gives to the law, history as it stands.
  GivenBatch given(double dt = 1e-4);

  const ContactModel& law() const { return *law_; }
  std::vector<double> prepared(const Values& interface) const;

  struct PairState {
    std::vector<double> history;
    std::uint32_t contacts = 0, slot_start = 0, capacity = 0;
  };
  using History = std::map<std::pair<std::uint32_t, std::uint32_t>, PairState>;
  History history;
  std::uint64_t layout = 1;  ///< as ContactBatch::layout, while `met` stays as it is

 private:
  static void give_boundaries(const BoundaryArrays& arrays, GivenBatch& batch);
  void give_interfaces(GivenBatch& batch) const;
  void give_pairs(const BoundaryArrays& arrays, GivenBatch& batch);
  void give_history(GivenBatch& batch) const;

  Evaluation evaluate(double dt);
  /// Gives pairs that report more contacts than slots as many as they ask for; false: ask again.
  bool had_room(const GivenBatch& batch, const TakenLoads& taken);
  void take_contacts(std::size_t pair, const GivenBatch& batch, const TakenLoads& taken, Evaluation& result);
  void take_loads(const BodyPair& pair, const GivenBatch& batch, const TakenLoads& taken,
                  const BoundaryArrays& arrays, Evaluation& result) const;
  std::uint32_t next_slot() const;  ///< behind all that pairs have

  const RegisteredComponent* component_;
  Made<ContactModel> law_;
  std::vector<std::vector<double>> rows_;
  std::function<std::uint32_t(std::uint32_t, std::uint32_t)> row_;
};

}  // namespace talus::conformance
