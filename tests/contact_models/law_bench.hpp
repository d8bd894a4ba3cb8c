#pragma once

#include "contact_models/boundary_arrays.hpp"
#include "plugin/registry.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace talus::bench {

/// The registry of the laws that ship, and the names of all contact laws in it.
Registry& registry();
std::vector<std::string> laws();

/// Parameters by key, in the unit a user writes.
using Values = std::map<std::string, double>;

/// An interface that excites everything: friction, damping, different stiffness along and across.
Values lively_interface();
/// Springs and friction without dashpots.
Values undamped_interface();
Values with(Values values, const Values& changes);

/// A body from its outline (counter-clockwise), side i of surface class `surfaces[i]` (all 0 if left out).
HeldBody held(const std::vector<Vec2>& outline, const std::vector<std::uint32_t>& surfaces = {});
HeldBody box(double left, double bottom, double right, double top);

/// An isometry of the plane: q, then a shift of all centres.
struct Isometry {
  Matrix2 q{1, 0, 0, 1};
  Vec2 shift{0, 0};
};
Isometry turned_by(double degrees);
Isometry mirrored();
HeldBody moved(const Isometry& isometry, const HeldBody& body);
BodyForce moved(const Isometry& isometry, const BodyForce& force);

struct CornerLoad {
  std::uint32_t body;
  Vec2 at;         ///< m, in the world
  Vec2 reference;  ///< m, from the centre of the body
  Vec2 force;      ///< N/m
};

struct Evaluation {
  std::vector<CornerLoad> corners;
  std::vector<BodyForce> forces;  ///< [body] ΣF and ΣF ⊗ X
  std::vector<PairReport> pairs;
  std::vector<ContactReport> contacts;  ///< of all pairs, one after the other
  std::vector<double> history;

  double size() const;                ///< N/m, Σ|F|
  Vec2 net_force() const;             ///< N/m
  double net_moment() const;          ///< N, about the first loaded corner
  Vec2 on(std::uint32_t body) const;  ///< N/m, ΣF
};

/// Drives one contact law as the host does, without covers and masses around it.
class LawBench {
 public:
  explicit LawBench(const std::string& law, const Values& interface = lively_interface(),
                    const Values& parameters = {});

  std::vector<HeldBody> bodies;
  double master_share = 0.5;  ///< of the body of lower number, in every pair
  bool hold_stick = false, bonds_form = false;
  bool plain = true;  ///< false: bodies are never said to be plain, so every pair goes the general way

  /// Interface of surface classes i and j, where there are several.
  void set_interfaces(const std::vector<Values>& rows,
                      const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& row);

  /// Evaluates in the present place; history stays as it was.
  Evaluation look(double dt = 1e-4);
  /// Bodies move with their velocities for dt, the law is evaluated there, history goes on.
  Evaluation step(double dt = 1e-4);

  const ContactModel& law() const { return *law_; }
  std::vector<double> prepared(const Values& interface) const;

 private:
  struct PairState {
    std::vector<double> history;
    std::uint32_t contacts = 0, capacity = 1;
  };
  Evaluation evaluate(double dt);

  const RegisteredComponent* component_;
  Made<ContactModel> law_;
  std::vector<std::vector<double>> rows_;
  std::function<std::uint32_t(std::uint32_t, std::uint32_t)> row_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairState> states_;
};

}  // namespace talus::bench
