#pragma once

#include "geometry/loop.hpp"
#include "geometry/outlines.hpp"
#include "geometry/vec2.hpp"
#include "plugin/registry.hpp"
#include "scene/function.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace talus {

/// A component chosen by a scene, with its parameters in declared order (SI, radians).
struct Choice {
  const RegisteredComponent* component = nullptr;
  std::vector<double> values;
};

struct SceneMaterial {
  std::string name;
  double density;  ///< kg/m³
  Choice model;    ///< component is nullptr where no body needs one (rigid bodies)
};

/// A class of boundary sides that share interface parameters: a material, and a surface name or "".
struct SurfaceClass {
  std::string material;
  std::string surface;
};

/// What is prescribed of a body as a whole; absent entries are free.
struct Support {
  std::optional<double> x, y;      ///< m/s, velocity of the centre of mass; 0 fixes it
  std::optional<double> rotation;  ///< rad/s

  bool any() const { return x || y || rotation; }
  bool all() const { return x && y && rotation; }
  bool drives() const { return x.value_or(0) != 0 || y.value_or(0) != 0 || rotation.value_or(0) != 0; }
};

/// An open polyline along which a body is cut; both faces belong to the surface class.
struct Discontinuity {
  std::vector<Vec2> points;  ///< m, relative to the scene's origin
  std::uint32_t surface_class;
};

/// Triangles of a mesh file that gave a body its shape.
struct MeshTriangles {
  std::vector<Vec2> nodes;  ///< m, relative to the scene's origin
  std::vector<std::array<std::uint32_t, 3>> corners;
};

struct SceneBody {
  std::string name;
  Loop outer;               ///< counter-clockwise
  std::vector<Loop> holes;  ///< clockwise
  std::vector<Discontinuity> discontinuities;
  MeshTriangles mesh;
  bool self_contact =
      false;  ///< whether parts of its own boundary may meet; faces of discontinuities always may
  std::uint32_t material;  ///< index into Scene::materials
  Choice cover;            ///< component is nullptr for a fixed body
  bool fixed = false;      ///< no unknowns
  Support support;
  Vec2 velocity;                ///< m/s at t = 0
  double angular_velocity = 0;  ///< rad/s at t = 0
  double priority = 0;          ///< with roles by priority: the higher one is master
};

/// The outer loop, then the holes.
template <class Body, class Each>
void each_loop(Body& body, const Each& each) {
  each(body.outer);
  for (auto& hole : body.holes) each(hole);
}

/// The vertices of these.
inline Loops loops_of(const SceneBody& body) {
  Loops loops;
  each_loop(body, [&](const Loop& loop) { loops.push_back(loop.vertices); });
  return loops;
}

struct PointLoad {
  std::uint32_t body;
  Vec2 point;            ///< m, in the scene's coordinates at the start; moves with the body
  VectorFunction force;  ///< N/m
};

/// Load on a named surface of a body, per length of the boundary at the start.
struct SurfaceLoad {
  std::uint32_t body;
  std::uint32_t surface_class;
  VectorFunction traction;  ///< Pa, in fixed directions
  Function pressure;        ///< Pa, towards the body, turning with the surface
};

/// Eqs. 18–20: λ∫(u − ū) over a named surface of a body, ū = displacement · min(t/ramp, 1) + ∫velocity dt.
/// What a support takes over from the stages before, along an axis.
struct SupportPast {
  double since = 0;    ///< s, when the ramp begins
  Function former;     ///< m, the displacement that the ramp leads away from
  Function travelled;  ///< m, by former velocities, less what the present one has travelled until it begins
};

/// Holds a surface to ū = displacement · r + former · (1 − r) + ∫velocity dt + travelled, r the share of the
/// ramp.
struct PrescribedSurface {
  std::uint32_t body;
  std::uint32_t surface_class;
  double stiffness;                                     ///< λ, Pa/m
  double ramp;                                          ///< s
  std::array<std::optional<Function>, 2> displacement;  ///< m, per axis
  std::array<std::optional<Function>, 2> velocity;      ///< m/s, per axis; an axis with neither is free
  std::array<SupportPast, 2> past;

  bool holds(std::size_t axis) const { return displacement[axis] || velocity[axis]; }
  double ramp_share(std::size_t axis, double time) const {
    return ramp > 0 ? std::clamp((time - past[axis].since) / ramp, 0.0, 1.0) : 1.0;
  }
};

/// A boundary that lets plane waves out: traction −ρ c_p v_n n − ρ c_s v_s s.
struct AbsorbingSurface {
  std::uint32_t body;
  std::uint32_t surface_class;
};

struct Monitor {
  std::string name;
  std::uint32_t body;
  std::optional<Vec2> point;  ///< of the body at the start; its centre of mass if absent
  std::vector<std::string> quantities;
};

/// Global damping: a force per mass and velocity of given size; or of the size that is critical for the
/// slowest motion as it is found under way (adaptive); or none, but velocities are taken away at each peak
/// of the kinetic energy (kinetic).
struct Damping {
  enum class Kind { constant, adaptive, kinetic };
  Kind kind = Kind::constant;
  double constant = 0;  ///< 1/s
};

struct Settle {
  double duration;  ///< s, at most
  Damping damping;
  std::optional<double> until;  ///< unbalanced force over applied force at which it ends early
  bool hold_stick = true;       ///< friction is held stuck meanwhile
};

/// Everything a stage may change.
struct StageSettings {
  Vec2 gravity;
  VectorFunction base_acceleration;  ///< m/s² of the ground; bodies feel its opposite
  Damping damping;
  std::vector<std::vector<double>> interface_values;  ///< [row][parameter] as in Scene
  std::vector<Support> supports;                      ///< [body]; empty where no body has any
  std::vector<PointLoad> loads;
  std::vector<SurfaceLoad> surface_loads;
  std::vector<PrescribedSurface> prescribed;
  std::vector<AbsorbingSurface> absorbing;
};

/// Of a body, by StageSettings::supports.
inline const Support& support_of(std::span<const Support> supports, std::size_t body) {
  static constexpr Support none{};
  return supports.empty() ? none : supports[body];
}

/// From a time on the scene goes on with other settings.
struct Stage {
  std::string name;
  double from;  ///< s
  StageSettings settings;
};

struct TimeSettings {
  double end;                ///< s
  std::optional<double> dt;  ///< s; automatic if absent
  double safety;             ///< of the automatic step, see automatic_step()
};

/// When bodies that rest are no longer followed.
struct SleepSettings {
  double speed;         ///< m/s, that no corner reaches
  double acceleration;  ///< m/s², of a corner, at most
  double after;         ///< s
};

struct OutputSettings {
  double history;                ///< s
  std::optional<double> frames;  ///< s; no frames if absent
};

struct Limits {
  double energy_residual;  ///< share of the energy throughput at which a run stops
  double penetration;      ///< share of the smallest width of a body at which a run stops
};

/// Compare: how far a monitor may part from the baseline (the first run) or from the reference file.
struct Tolerance {
  std::string monitor, quantity;
  bool against_reference;
  std::optional<double> largest, rms, final;
};

struct SceneSource;

/// A scene that passed validation.
struct Scene {
  std::string file, title;
  std::shared_ptr<const SceneSource> source;  ///< nullptr where it came from no file
  SimdLevel simd = SimdLevel::scalar;         ///< of the registry it was read with
  Vec2 origin;  ///< m, world coordinates of the scene's (0, 0); added on output only
  Vec2 gravity;
  std::vector<SceneMaterial> materials;
  std::vector<SurfaceClass> surfaces;
  Choice contact;  ///< component is nullptr where no two bodies can meet
  bool roles_by_priority = false;
  /// Interface parameters of the contact law in declared order: row of each pair of surface classes
  /// [i * surfaces.size() + j], symmetric.
  std::vector<std::uint32_t> interface_row;
  /// Surfaces, the first not after the second, that meet only where discontinuities cut a body apart, and
  /// that no row covers.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> without_interface;
  std::vector<std::vector<double>> interface_values;
  std::vector<SceneBody> bodies;
  std::vector<PointLoad> loads;
  std::vector<SurfaceLoad> surface_loads;
  std::vector<PrescribedSurface> prescribed;
  std::vector<AbsorbingSurface> absorbing;
  VectorFunction base_acceleration;  ///< m/s² of the ground; bodies feel its opposite
  Damping damping;
  std::optional<Settle> settle;
  std::vector<Stage> stages;  ///< in the order of their times, all later than 0
  std::vector<Monitor> monitors;
  TimeSettings time;
  std::optional<SleepSettings> sleep;
  OutputSettings output;
  Limits limits;
  std::vector<Tolerance> tolerances;
  std::vector<std::string>
      warnings;  ///< what a reviewer would raise, e.g. cohesion given to a law that reads none
  std::map<std::string, std::string> files;  ///< what else was read, by path: XXH3-128
  std::string resolved;                      ///< the scene as JSON text with every default spelled out

  /// All that was read for it, itself first.
  std::vector<std::filesystem::path> files_read() const {
    std::vector<std::filesystem::path> read{file};
    for (const auto& [name, hash] : files) read.emplace_back(name);
    return read;
  }
};

/// Whether an interface may be bonded, from the start or in a stage. Bonds form where bodies are drawn, so
/// that no other geometry can be given to such a scene.
bool may_bond(const Scene& scene);

/// What a stage may change, as it is at the start.
StageSettings settings_of(const Scene& scene);

}  // namespace talus
