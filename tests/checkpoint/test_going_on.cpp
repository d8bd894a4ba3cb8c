#include "archive/archive.hpp"
#include "figures/runs.hpp"
#include "files/input_error.hpp"

#include <catch2/catch.hpp>

#include <memory>

using namespace talus;
using namespace talus::figures;

namespace {

/// All that is left of a run: hashes of its state, energies and what is read off its bodies.
struct End {
  std::string hash;
  std::vector<double> values;
};

End end_of(const Simulation& simulation) {
  End end{simulation.state_hash(), {}};
  for (std::size_t body = 0; body < simulation.body_count(); ++body) {
    const Motion m = simulation.body_motion(body);
    end.values.insert(end.values.end(), {m.displacement.x, m.displacement.y, m.velocity.x, m.velocity.y,
                                         m.rotation, m.stress_xx, m.stress_yy, m.stress_xy});
  }
  const EnergyLedger& l = simulation.ledger();
  end.values.insert(end.values.end(), {l.kinetic, l.strain, l.contact, l.friction_loss,
                                       l.contact_damping_loss, l.global_damping_loss, l.material_loss,
                                       l.sleep_loss, l.external_work, l.residual, l.throughput});
  const RunSummary summary = simulation.summary();
  end.values.insert(end.values.end(),
                    {static_cast<double>(summary.steps), static_cast<double>(summary.settle_steps),
                     static_cast<double>(summary.pair_searches), summary.dt, summary.largest_penetration,
                     summary.largest_residual_share});
  return end;
}

/// Runs a scene, leaving off after every `pieces` steps and going on with another simulation.
End in_pieces(const Scene& scene, std::uint64_t piece, const RunSettings& settings) {
  auto simulation = std::make_unique<Simulation>(scene, settings);
  std::uint64_t steps = 0;
  const Pause pause = [&] { return ++steps % piece == 0; };
  const auto go_on = [&] {
    Archive kept;
    simulation->exchange(kept);
    simulation = std::make_unique<Simulation>(scene, settings);
    Archive taken(kept.bytes());
    simulation->exchange(taken);
  };
  while (!simulation->settle(pause)) go_on();
  while (simulation->advance(pause)) go_on();
  REQUIRE(steps > 3 * piece);
  return end_of(*simulation);
}

void check_goes_on(const Scene& scene, std::uint64_t piece) {
  Simulation whole(scene, {});
  whole.settle();
  while (whole.advance()) {
  }
  const End due = end_of(whole);
  for (const RunSettings& settings : {RunSettings{1, true}, RunSettings{2, true}, RunSettings{1, false}}) {
    CAPTURE(settings.threads, settings.neighbour_skin);
    const End got = in_pieces(scene, piece, settings);
    CHECK(got.hash == due.hash);
    // Searches are counted, and without the skin there are more.
    if (settings.neighbour_skin) CHECK(got.values == due.values);
  }
}

constexpr const char* lattice_with_memory = R"({"talus": 1, "gravity": [0, -10],
  "materials": {
    "soil": {"density": 2000, "model": "mohr_coulomb", "young_modulus": 1e7, "poisson_ratio": 0.3,
             "cohesion": 1e3, "friction_angle": 20},
    "clay": {"density": 2000, "model": "hypoelastic", "young_modulus": 1e7, "poisson_ratio": 0.3}},
  "cover": {"model": "hexagonal", "size": 0.4},
  "contact": {"model": "overlap_area"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 20,
                  "normal_damping": 0.2, "tangential_damping": 0.2}],
  "bodies": [
    {"name": "base", "polygon": [[-3, -1], [3, -1], [3, 0], [-3, 0]], "material": "soil", "fixed": true},
    {"name": "a", "polygon": [[-1, 0.001], [1, 0.001], [1, 2], [-1, 2]], "material": "soil",
     "velocity": [2, -3]},
    {"name": "b", "polygon": [[-1, 2.001], [1, 2.001], [1, 3], [-1, 3]], "material": "clay", "cover": {"model": "block"}}],
  "monitors": [{"name": "a", "body": "a"}],
  "time": {"end": 0.05},
  "output": {"history": 0.01}})";

constexpr const char* driven_stages = R"({"talus": 1, "gravity": [0, -10],
  "materials": {"rock": {"density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2}},
  "cover": {"model": "hexagonal", "size": 0.5},
  "contact": {"model": "vertex_edge"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                  "normal_damping": 0.3, "tangential_damping": 0.3}],
  "bodies": [
    {"name": "base", "polygon": [[-3, -1], [3, -1], [3, 0], [-3, 0]], "material": "rock", "fixed": true},
    {"name": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "material": "rock", "surfaces": {"top": [2]}}],
  "settle": {"duration": 0.02, "damping": "adaptive"},
  "stages": [{"name": "pull", "from": 0.013, "set": {"/gravity": [3, -10]}},
             {"name": "slip", "from": 0.031, "set": {"/interfaces/0/friction_angle": 5}}],
  "loads": [{"body": "a", "point": [1, 1], "force": [{"time": [[0, 0], [0.05, 1e4]]}, 0]}],
  "time": {"end": 0.05},
  "output": {"history": 0.01}})";

/// What is fixed lies between what moves, so that sums over bodies are taken in several parts.
constexpr const char* fixed_between = R"({"talus": 1, "gravity": [1, -10],
  "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2}},
  "cover": {"model": "block"},
  "contact": {"model": "overlap_area"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                  "normal_damping": 0.3, "tangential_damping": 0.3}],
  "bodies": [
    {"name": "a", "polygon": [[-4, 0.1], [-3.1, 0], [-3, 1], [-4, 1.2]], "material": "rock", "velocity": [0.3, -1]},
    {"name": "shelf", "polygon": [[-1, -1], [1, -1], [1, 0], [-1, 0]], "material": "rock", "fixed": true},
    {"name": "b", "polygon": [[-0.7, 0.001], [0.2, 0], [0.3, 1.1], [-0.6, 1]], "material": "rock"},
    {"name": "c", "polygon": [[3, 0], [4.3, 0.2], [3.7, 1.3]], "material": "rock", "velocity": [-0.7, 0.1]},
    {"name": "ledge", "polygon": [[5, -1], [6, -1], [6, 0], [5, 0]], "material": "rock", "fixed": true},
    {"name": "d", "polygon": [[7, 0], [8.1, 0], [8, 0.7], [7, 0.9]], "material": "rock", "cover": {"model": "rigid"},
     "velocity": [0.11, 0.7]}],
  "time": {"end": 0.05, "dt": 1e-4},
  "output": {"history": 0.01}})";

}  // namespace

TEST_CASE("A run goes on from any step with the same bits", "[checkpoint]") {
  check_goes_on(shipped("incline", {{"/time/end", "0.05"}}), 101);
  check_goes_on(shipped("brick_wall", {{"/time/end", "0.004"}}), 13);
  check_goes_on(shipped("brick_wall", {{"/time/end", "0.002"}, {"/cover/strain_mass_scale", "9"}}), 7);
  check_goes_on(shipped("vaiont", {{"/time/end", "0.02"}, {"/settle/duration", "0.01"}}), 23);
}

TEST_CASE("Materials, stages, settling and loads go on with the same bits", "[checkpoint]") {
  check_goes_on(from_text(lattice_with_memory), 23);
  check_goes_on(from_text(driven_stages), 31);
  check_goes_on(from_text(fixed_between), 7);
}

TEST_CASE("A state kept when the settle stage has just ended does not settle again", "[checkpoint]") {
  const Scene scene = from_text(driven_stages);
  Simulation whole(scene, {});
  whole.settle();
  Archive kept;
  whole.exchange(kept);
  while (whole.advance()) {
  }
  Simulation again(scene, {});
  Archive restored(kept.bytes());
  again.exchange(restored);
  const std::uint64_t settled = again.summary().settle_steps;
  CHECK(again.settle());
  CHECK(again.summary().settle_steps == settled);
  while (again.advance()) {
  }
  CHECK(again.state_hash() == whole.state_hash());
}

TEST_CASE("Islands asleep go on with the same bits", "[checkpoint]") {
  const Scene scene = shipped(
      "column", {{"/time/end", "1.2"}, {"/sleep", R"({"after": 0.2, "speed": 1e-3, "acceleration": 1e-2})"}});
  Simulation whole(scene, {});
  while (whole.advance()) {
  }
  REQUIRE(whole.summary().sleep->bodies_asleep > 0);
  check_goes_on(scene, 4999);
}

TEST_CASE("A state of another scene is refused, and so is one that lost bytes", "[checkpoint]") {
  const Scene scene = shipped("incline");
  Simulation one(scene, {});
  one.advance();
  Archive kept;
  one.exchange(kept);
  Simulation other(shipped("column"), {});
  Archive taken(kept.bytes());
  CHECK_THROWS_AS(other.exchange(taken), InputError);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{9}, kept.bytes().size() / 2, kept.bytes().size() - 1}) {
    Simulation again(scene, {});
    Archive cut(std::string_view(kept.bytes()).substr(0, size));
    CHECK_THROWS_AS(again.exchange(cut), InputError);
  }
}
