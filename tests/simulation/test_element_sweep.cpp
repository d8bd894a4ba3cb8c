#include "figures/runs.hpp"
#include "model/whole_motion.hpp"
#include "output/scratch.hpp"
#include "parallel/alone.hpp"
#include "simulation/blocks.hpp"
#include "simulation/deformation.hpp"
#include "simulation/patch_mass.hpp"
#include "simulation/working_scene.hpp"
#include "verification/rectangle_mesh.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace talus;

namespace {

/// A lattice of several subdomains with cut cells, a crack and slivers; the mesh of `file` otherwise.
Scene scene_of(const std::string& cover, const std::string& material, const std::string& shape) {
  WorkingScene text;
  text.material = fmt::format(
      R"("density": 2300, "model": "{}", "young_modulus": 1e10, "poisson_ratio": 0.25, "damping_time": {})",
      material, material == "linear_elastic" ? "0" : "1e-6");
  text.bodies = fmt::format(R"({{"name": "a", "material": "rock", {}, "cover": {}}})", shape, cover);
  return text.read();
}

const char* const plate = R"("polygon": [[0, 0], [10, 0], [10, 4], [0, 5]],
    "discontinuities": [{"points": [[2, 1], [5, 2.2]]}])";

Scene lattice(const std::string& material, const std::string& slivers = "merge") {
  return scene_of(
      fmt::format(R"({{"model": "hexagonal", "size": 0.06, "angle": 11, "slivers": "{}"}})", slivers),
      material, plate);
}

Scene mesh(const std::string& material) {
  const Scratch scratch;
  const std::string file =
      scratch.write("plate.msh", verification::RectangleMesh{{0, 0}, {6, 3}, 80, 50}.text()).string();
  return scene_of(R"({"model": "mesh"})", material, fmt::format(R"("mesh": "{}")", file));
}

/// Displacements and velocities of all patches, strains of about 1e-3 under a turn.
void disturb(const Model& model, MotionState& motion) {
  std::mt19937 source(5);
  const auto random = [&] { return static_cast<double>(source()) / 2147483648.0 - 1; };
  for (std::size_t p = 0; p < motion.patch_displacement.size(); ++p) {
    const Vec2 at = model.patch_star[p];
    motion.patch_displacement[p] = {-0.1 * at.y + 6e-5 * random(), 0.1 * at.x + 6e-5 * random()};
    motion.patch_velocity[p] = {random(), random()};
  }
}

/// What a material without a past says of an element, F and P as xx, xy, yx, yy.
struct PlainResponse {
  double f[4], p[4], energy;
};

PlainResponse plain_response(const Material& material, const Matrix2& h) {
  PlainResponse r{{1 + h.xx, h.xy, h.yx, 1 + h.yy}, {}, 0};
  const double before[4] = {1, 0, 0, 1};
  double viscous[4], dissipated = 0;
  std::vector<double> state(material.doubles_per_element()), next(state);
  MaterialBatch batch{
      {r.f, r.f + 1, r.f + 2, r.f + 3}, {before, before + 1, before + 2, before + 3}, state.data(), 1e-6, 1};
  material.evaluate(batch, {{r.p, r.p + 1, r.p + 2, r.p + 3},
                            {viscous, viscous + 1, viscous + 2, viscous + 3},
                            &r.energy,
                            &dissipated,
                            next.data()});
  return r;
}

/// Element by element from Eq. 18 as it is written, with a material evaluated one by one.
std::vector<Vec2> plain_forces(const Scene& scene, const Model& model, const MotionState& motion,
                               double& stored) {
  const Choice& choice = scene.materials[0].model;
  const auto material = make<Material>(*choice.component, choice.values);
  std::vector<Vec2> forces(motion.patch_force.size());
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const Element& element = model.elements[e];
    const double area = model.element_area[e];
    const Matrix2 h = gradient(element, motion.patch_displacement);
    const auto& [f, p, energy] = plain_response(*material, h);
    stored += area * energy;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 g = element.gradient[i];
      forces[element.patch[i]].x -= area * (p[0] * g.x + p[1] * g.y);
      forces[element.patch[i]].y -= area * (p[2] * g.x + p[3] * g.y);
    }
  }
  return forces;
}

/// Two bodies, of which the second alone has slivers that are tied; what is its own begins behind the
/// other's.
Scene two_lattices() {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 3, 2, R"("cover": {"model": "hexagonal", "size": 0.06, "slivers": "keep"})") +
                "," + box("b", 10, 0, 13, 2, R"("cover": {"model": "hexagonal", "size": 0.06, "angle": 7})");
  return text.read();
}

std::vector<Scene> all_scenes() {
  return {lattice("linear_elastic"), lattice("hypoelastic"), mesh("linear_elastic"), mesh("hypoelastic")};
}

bool same_bits(const std::vector<Vec2>& p, const std::vector<Vec2>& q) {
  return p.size() == q.size() &&
         std::equal(p.begin(), p.end(), q.begin(), [](Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; });
}

}  // namespace

TEST_CASE("swept forces and energy are those of the elements one by one", "[continuum][sweep]") {
  for (const Scene& scene : all_scenes()) {
    const Model model = build_model(scene);
    MotionState motion(model);
    disturb(model, motion);
    Deformation deformation(scene, model, alone());
    double stored = 0;
    const std::vector<Vec2> plain = plain_forces(scene, model, motion, stored);
    clear_forces(model, motion);
    const Deformation::Energy energy = deformation.apply(model, motion, 1e-6);
    double largest = 0, error = 0;
    for (std::size_t p = 0; p < plain.size(); ++p) {
      largest = std::max(largest, size_of(plain[p]));
      error = std::max(error,
                       size_of({motion.patch_force[p].x - plain[p].x, motion.patch_force[p].y - plain[p].y}));
    }
    // Displacements of 0.5 m give strains rounding errors of 0.5 m × 2e-16 / 0.06 m, 1e-12 of their size.
    CHECK(error <= 1e-11 * largest);
    CHECK(energy.stored == Approx(stored).epsilon(1e-11));
  }
}

TEST_CASE("keeping stress for output changes no bits", "[continuum][sweep]") {
  for (const Scene& scene : all_scenes()) {
    const Model model = build_model(scene);
    MotionState kept(model), not_kept(model);
    disturb(model, kept);
    disturb(model, not_kept);
    clear_forces(model, kept);
    clear_forces(model, not_kept);
    Deformation first(scene, model, alone()), second(scene, model, alone());
    const Deformation::Energy one = first.apply(model, kept, 1e-6, true),
                              two = second.apply(model, not_kept, 1e-6, false);
    CHECK(same_bits(kept.patch_force, not_kept.patch_force));
    CHECK(one.stored == two.stored);
    CHECK(one.dissipated == two.dissipated);
  }
}

TEST_CASE("stress for output is that of the elements one by one, kept or not", "[continuum][sweep]") {
  std::vector<Scene> scenes = all_scenes();
  scenes.push_back(two_lattices());
  for (const Scene& scene : scenes) {
    const Model model = build_model(scene);
    MotionState motion(model);
    disturb(model, motion);
    Deformation deformation(scene, model, alone());
    clear_forces(model, motion);
    deformation.apply(model, motion, 1e-6, true);
    const Choice& choice = scene.materials[0].model;
    const auto material = make<Material>(*choice.component, choice.values);
    for (const std::uint32_t body : model.covered_bodies) {
      const Body& b = model.bodies[body];
      std::array<double, 3> mean{};
      for (std::uint32_t i = b.element_begin; i < b.element_end; ++i) {
        const std::uint32_t e = model.body_element[i];
        const Matrix2 h = gradient(model.elements[e], motion.patch_displacement);
        const auto& [f, p, energy] = plain_response(*material, h);
        const double volume = f[0] * f[3] - f[1] * f[2];
        const std::array<double, 3> due{(p[0] * f[0] + p[1] * f[1]) / volume,
                                        (p[2] * f[2] + p[3] * f[3]) / volume,
                                        (p[0] * f[2] + p[1] * f[3] + p[2] * f[0] + p[3] * f[1]) / 2 / volume};
        const std::array<double, 3> found = deformation.cauchy_of_element(model, motion, e);
        for (std::size_t k = 0; k < 3; ++k) {
          mean[k] += model.element_area[e] / b.moments.area * due[k];
          // Strains of 1e-3 and more from displacements with rounding errors of 1e-15.
          REQUIRE(found[k] == Approx(due[k]).epsilon(1e-9).margin(1e-2));
        }
      }
      const std::array<double, 3> found = deformation.cauchy(model, motion, body);
      for (std::size_t k = 0; k < 3; ++k) CHECK(found[k] == Approx(mean[k]).epsilon(1e-9).margin(1e-2));
    }
  }
}

TEST_CASE("an element that is inside out is seen where stress is kept", "[continuum][sweep]") {
  for (const Scene& scene : all_scenes()) {
    const Model model = build_model(scene);
    MotionState motion(model);
    Deformation deformation(scene, model, alone());
    clear_forces(model, motion);
    CHECK_FALSE(deformation.apply(model, motion, 1e-6, true).inside_out);
    motion.patch_displacement[model.elements[model.elements.size() / 2].patch[0]] = {0.3, -0.4};
    clear_forces(model, motion);
    CHECK(deformation.apply(model, motion, 1e-6, true).inside_out);
    CHECK_FALSE(deformation.apply(model, motion, 1e-6, false).inside_out);
  }
}

TEST_CASE("one pass gives the bits of forces first and velocities afterwards", "[continuum][sweep]") {
  std::vector<Scene> scenes = all_scenes();
  scenes.push_back(lattice("linear_elastic", "mass_scale"));
  scenes.push_back(two_lattices());
  for (const Scene& scene : scenes) {
    const Model model = build_model(scene);
    const PatchMass mass(model);
    const std::vector<Support> supports(model.bodies.size());
    Blocks blocks(model, best_simd_level(), alone(), true);
    for (const double ahead : {1e-6, 1.5e-6}) {
      const StepConditions conditions{{0, -9.81}, {0, -9.81}, 20, 1e-6, ahead, true};
      MotionState one(model), two(model);
      disturb(model, one);
      disturb(model, two);
      Deformation first(scene, model, alone()), second(scene, model, alone());
      std::vector<Vec2> at_one(model.patch_star.size()), at_two = at_one;
      one.own_behind = two.own_behind = 1e-6;
      clear_forces(model, one);
      clear_forces(model, two);
      const Deformation::Energy now =
          first.apply_and_update(model, mass, supports, conditions, conditions.dt_behind, true, one, at_one);
      for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const Body& body = model.bodies[b];
        const CoverRanges& ranges = model.ranges(body);
        REQUIRE(ranges.free_end > ranges.own_end);
        REQUIRE((ranges.free_end == ranges.patch_end) == (ranges.steady_begin == ranges.steady_end));
        REQUIRE(first.updated()[b].end == ranges.free_end);
      }
      const AccelerationWork work =
          accelerate(model, mass, supports, conditions, true, blocks, one, at_one, first.updated());
      const Deformation::Energy same = second.apply(model, two, 1e-6);
      const AccelerationWork other = accelerate(model, mass, supports, conditions, true, blocks, two, at_two);

      CHECK(same_bits(one.patch_velocity, two.patch_velocity));
      CHECK(same_bits(one.patch_displacement, two.patch_displacement));
      CHECK(same_bits(at_one, at_two));
      CHECK(now.stored == same.stored);
      CHECK(now.dissipated == same.dissipated);
      CHECK(work.kinetic == Approx(other.kinetic).epsilon(1e-12));
      CHECK(work.damping_loss == Approx(other.damping_loss).epsilon(1e-12));
      CHECK(work.external_work ==
            Approx(other.external_work).epsilon(1e-9).margin(1e-12 * std::abs(work.kinetic)));
      for (std::uint32_t e = 0; e < model.elements.size(); e += 97)
        CHECK(first.cauchy_of_element(model, one, e) == second.cauchy_of_element(model, two, e));
    }
  }
}

TEST_CASE("how subdomains are shared out cannot be seen in the bits", "[continuum][sweep]") {
  for (const Scene& scene : {lattice("hypoelastic"), mesh("linear_elastic")}) {
    const Model model = build_model(scene);
    const Body& body = model.bodies[0];
    const CoverRanges& ranges = model.ranges(body);
    const std::uint32_t begin = ranges.subdomain_begin, end = ranges.subdomain_end;
    REQUIRE(end - begin >= 2);
    const PatchMass mass(model);
    struct Outcome {
      std::vector<Vec2> velocity, force;
      std::vector<double> sums;
    };
    const auto outcome = [&](const std::vector<std::pair<std::uint32_t, std::uint32_t>>& divided) {
      MotionState motion(model);
      disturb(model, motion);
      motion.own_behind = 1e-6;
      MaterialBatches materials(scene, model);
      ElementSweep sweep(model, best_simd_level());
      std::vector<Vec2> middle(model.patch_star.size());
      const SweepStep step{1e-6, true,         true, {1, 1e-6, {0, -9.81}, true}, mass.inverse().data(),
                           0.5,  middle.data()};
      std::vector<SweepSums> sums(model.partition.subdomains.size());
      for (const auto& [from, to] : divided) {
        ElementSweep::Workspace workspace = sweep.workspace();
        sweep.run(model, body, from, to, step, materials, motion, workspace, sums);
      }
      const std::uint32_t common = ranges.patch_end - ranges.own_end;
      sweep.gather(model, body, common / 2, common, motion);
      sweep.gather(model, body, 0, common / 2, motion);
      Outcome result{motion.patch_velocity, motion.patch_force, {}};
      for (const SweepSums& sum : sums)
        result.sums.insert(result.sums.end(), {sum.stored, sum.dissipated, sum.own.across, sum.own.before});
      return result;
    };
    const Outcome whole = outcome({{begin, end}});
    std::vector<std::pair<std::uint32_t, std::uint32_t>> backwards;
    for (std::uint32_t s = end; s-- > begin;) backwards.emplace_back(s, s + 1);
    const Outcome single = outcome(backwards);
    CHECK(same_bits(whole.velocity, single.velocity));
    CHECK(same_bits(whole.force, single.force));
    CHECK(whole.sums == single.sums);
  }
}

TEST_CASE("a material that needs no former deformation is not asked with one", "[continuum][sweep]") {
  const Scene elastic = lattice("linear_elastic"), rate = lattice("hypoelastic");
  CHECK(Deformation(elastic, build_model(elastic), alone()).memory().empty());
  const Model model = build_model(rate);
  CHECK(Deformation(rate, model, alone()).memory().size() == (4 + 4) * model.elements.size());
}
