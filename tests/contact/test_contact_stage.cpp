#include "contact/contact_stage.hpp"
#include "files/input_error.hpp"
#include "model/whole_motion.hpp"
#include "parallel/alone.hpp"
#include "simulation/simulation.hpp"
#include "simulation/working_scene.hpp"
#include "tally.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cstring>

using namespace talus;

namespace {

/// A stage with the model and motion it works on.
struct HeldStage {
  Scene scene;
  Model model;
  MotionState motion;
  ContactStage contacts;

  HeldStage(const WorkingScene& text, Registry& registry, bool skin = true, Workers& workers = alone())
      : scene(text.read(registry)),
        model(build_model(scene)),
        motion(model),
        contacts(scene, model, workers, skin) {}

  static constexpr MotionState::Speeds far{1e9, 2e9, 1e9};  ///< m/s

  ContactTotals evaluate(double dt = 1e-3) {
    for (BodyForce& force : motion.forces) force = {};
    move_boundary(model, motion);
    contacts.find_pairs(model, motion, 1, far);  // the candidates are sought anew every time
    return contacts.evaluate(model, motion, {dt, true, false});
  }

  /// A step among the candidates of the last search.
  ContactTotals evaluate_near() {
    for (BodyForce& force : motion.forces) force = {};
    move_boundary(model, motion);
    contacts.find_pairs(model, motion, 0, {});
    return contacts.evaluate(model, motion, {1e-3, true, false});
  }

  std::size_t number(std::uint32_t a, std::uint32_t b) const {
    for (std::size_t i = 0; i < contacts.pairs().size(); ++i) {
      if (contacts.pairs()[i].a == a && contacts.pairs()[i].b == b) return i;
    }
    throw std::logic_error("no such pair");
  }
  const BodyPair& pair(std::uint32_t a, std::uint32_t b) const { return contacts.pairs()[number(a, b)]; }

  std::vector<double> history(std::uint32_t a, std::uint32_t b) const {
    const auto found = contacts.history_of(number(a, b));
    return {found.begin(), found.end()};
  }
};

/// A comb of seven teeth 1 m wide; the first, third and fifth are 0.5 m high, the others 1 mm less.
std::string comb(double lowest, const std::string& name = "comb", double left = 0) {
  std::string polygon = fmt::format("[{}, {:.17g}], [{}, {:.17g}]", left + 7, lowest + 2, left, lowest + 2);
  for (int i = 0; i < 7; ++i) {
    const double tip = lowest + (i % 2 == 0 && i < 6 ? 0 : 1e-3);
    polygon += fmt::format(", [{}, {:.17g}], [{}, {:.17g}]", left + i, lowest + 0.5, left + i + 0.5, tip);
  }
  polygon += fmt::format(", [{}, {:.17g}]", left + 7, lowest + 0.5);
  return fmt::format(R"({{"name": "{}", "material": "rock", "polygon": [{}]}})", name, polygon);
}

WorkingScene combed() {
  WorkingScene scene;
  scene.bodies = box("base", -1, -1, 8, 0, R"("fixed": true)") + ", " + comb(0.5);
  scene.interface =
      R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
         "normal_damping": 0, "tangential_damping": 0)";
  return scene;
}

}  // namespace

TEST_CASE("room is made for as many contacts as a law finds, and none forgets its history",
          "[contact][stage]") {
  WorkingScene text;
  text.law = "tally";
  text.interface = R"("normal_stiffness": 1)";
  text.bodies = box("a", 0, 0, 1, 1) + ", " + box("b", 1, 0, 2, 1) + ", " + box("c", 2, 0, 3, 1);
  HeldStage stage(text, tally::registry());
  tally::contacts = 1;
  stage.evaluate();
  stage.evaluate();
  CHECK(stage.history(0, 1) == std::vector<double>{2});
  tally::contacts = 9;
  stage.evaluate();
  CHECK(stage.history(0, 1) == std::vector<double>{3, 1, 1, 1, 1, 1, 1, 1, 1});
  CHECK(stage.history(1, 2) == std::vector<double>{3, 1, 1, 1, 1, 1, 1, 1, 1});
  CHECK(stage.pair(0, 1).slot_capacity >= 9);
  tally::contacts = 2;
  stage.evaluate();
  CHECK(stage.history(0, 1) == std::vector<double>{4, 2});
  tally::contacts = 40;
  stage.evaluate();
  std::vector<double> ages(40, 1.0);
  ages[0] = 5, ages[1] = 3;
  CHECK(stage.history(0, 1) == ages);
  tally::contacts = 1;
}

TEST_CASE("a pair keeps its history when other pairs come and go", "[contact][stage]") {
  WorkingScene text;
  text.law = "tally";
  text.interface = R"("normal_stiffness": 1)";
  text.bodies = box("far", -50, 0, -49, 1) + ", " + box("left", 0, 0, 1, 1) + ", " +
                box("right", 1, 0, 2, 1) + ", " + box("other", 60, 0, 61, 1);
  HeldStage stage(text, tally::registry());
  tally::contacts = 2;
  for (int i = 0; i < 3; ++i) stage.evaluate();
  REQUIRE(stage.contacts.pairs().size() == 1);
  CHECK(stage.history(1, 2) == std::vector<double>{3, 3});

  stage.motion.bodies[0].u.x = 49;   // beside 'left': a pair before the old one
  stage.motion.bodies[3].u.x = -58;  // beside 'right': a pair behind it
  stage.evaluate();
  REQUIRE(stage.contacts.pairs().size() == 3);
  CHECK(stage.history(0, 1) == std::vector<double>{1, 1});
  CHECK(stage.history(1, 2) == std::vector<double>{4, 4});
  CHECK(stage.history(2, 3) == std::vector<double>{1, 1});

  stage.motion.bodies[0].u.x = 0;  // as far as it may be, the law says that it is in contact: held by a bond
  stage.evaluate();
  REQUIRE(stage.contacts.pairs().size() == 3);
  CHECK(stage.history(0, 1) == std::vector<double>{2, 2});
  CHECK(stage.history(1, 2) == std::vector<double>{5, 5});
  CHECK(stage.history(2, 3) == std::vector<double>{2, 2});

  tally::contacts = 0;
  stage.evaluate();  // the bond breaks
  tally::contacts = 2;
  stage.motion.bodies[0].u.x = 0.1;
  stage.evaluate();
  CHECK(stage.contacts.pairs().size() == 2);
  stage.motion.bodies[0].u.x = 49;  // back again, as a stranger
  stage.evaluate();
  CHECK(stage.history(0, 1) == std::vector<double>{1, 1});
  CHECK(stage.history(1, 2) == std::vector<double>{2, 2});
  tally::contacts = 1;
}

TEST_CASE("a comb stands on as many overlaps as teeth reach the base", "[contact][stage]") {
  HeldStage stage(combed(), shipped_registry());
  const double stiffness = 1e9, stand_off = 0.5, flat = 0.5 / 0.499;

  // 0.4 mm into the base: three teeth; 3 mm: all seven. A tip of depth d covers d² 0.5 m/(height of the
  // tooth).
  stage.motion.bodies[1].u.y = -stand_off - 0.4e-3;
  ContactTotals totals = stage.evaluate();
  CHECK(stage.pair(0, 1).contact_count == 3);
  CHECK(stage.motion.forces[1].force.y == Approx(stiffness * 3 * 0.16e-6).epsilon(1e-9));
  CHECK(totals.penetration == Approx(0.4e-3).epsilon(1e-9));

  stage.motion.bodies[1].u.y = -stand_off - 3e-3;
  totals = stage.evaluate();
  CHECK(stage.pair(0, 1).contact_count == 7);
  CHECK(stage.motion.forces[1].force.y == Approx(stiffness * (3 * 9e-6 + 4 * 4e-6 * flat)).epsilon(1e-9));
  CHECK(stage.motion.forces[1].force.x == Approx(0).margin(1e-6));
  CHECK(stage.motion.forces[0].force.y == 0);  // nobody asks for the load on a fixed body
  CHECK(totals.penetration == Approx(3e-3).epsilon(1e-9));
  // Π = α ∫ g dA of a triangle: α d/3 times its area.
  CHECK(totals.stored == Approx(stiffness * (3 * 27e-9 + 4 * 8e-9 * flat) / 3).epsilon(1e-9));
}

TEST_CASE("teeth that join later leave the springs of the first ones as they are", "[contact][stage]") {
  HeldStage stage(combed(), shipped_registry());
  stage.motion.bodies[1].u.y = -0.5 - 0.4e-3;
  stage.evaluate();
  stage.motion.bodies[1].velocity = {1e-3, 0};
  stage.evaluate(1e-3);  // a slip of 1e-6 m in stick
  const double sheared = stage.motion.forces[1].force.x;
  // Every tip touches along 0.8 mm.
  CHECK(sheared == Approx(-3 * 1e9 * 0.8e-3 * 1e-6).epsilon(1e-6));

  stage.motion.bodies[1].velocity = {0, 0};
  stage.motion.bodies[1].u.y = -0.5 - 3e-3;
  stage.evaluate();
  REQUIRE(stage.pair(0, 1).contact_count == 7);
  CHECK(stage.motion.forces[1].force.x == Approx(sheared).epsilon(1e-9));
}

namespace {

constexpr int rows = 48, apart = 40;

/// A raft of blocks, combs on bases before and behind it, and blocks that are candidates by the skin alone.
WorkingScene raft() {
  WorkingScene text;
  text.interface = combed().interface;
  const auto combed_base = [](const std::string& name, double left) {
    return box(name, left - 1, -1, left + 8, 0) + ", " + comb(0, "comb " + name, left);
  };
  text.bodies = combed_base("first", -100);
  for (int i = 0; i < apart; ++i)
    text.bodies += ", " + box(fmt::format("a{}", i), 1.05 * i, -50, 1.05 * i + 1, -49);
  for (int i = 0; i < rows * rows; ++i) {
    const int x = i % rows, y = i / rows;
    text.bodies += ", " + box(fmt::format("b{}", i), x, y, x + 1, y + 1);
  }
  text.bodies += ", " + combed_base("last", 100);
  return text;
}

/// Blocks then overlap those beside them by 1 mm and those below by 2 mm, and combs need more room than a
/// pair begins with.
void push_together(MotionState& motion) {
  motion.bodies[1].u.y = motion.bodies.back().u.y = -3e-3;
  for (int i = 0; i < rows * rows; ++i)
    motion.bodies[2 + apart + static_cast<std::size_t>(i)].u = {-1e-3 * (i % rows), -2e-3 * (i / rows)};
}

}  // namespace

TEST_CASE("bodies gather what all pairs report, wave after wave of them", "[contact][stage]") {
  HeldStage stage(raft(), shipped_registry()), without_skin(raft(), shipped_registry(), false);
  push_together(stage.motion);
  push_together(without_skin.motion);
  for (int step = 0; step < 2; ++step) {
    stage.evaluate();
    const auto pairs = stage.contacts.pairs();
    REQUIRE(pairs.size() > 2 * pairs_of_wave(1));
    CHECK(stage.pair(0, 1).contact_count == 7);
    CHECK(pairs.back().contact_count == 7);
    std::vector<Vec2> reported(stage.model.bodies.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (const ContactReport& report : stage.contacts.reports_of(i)) {
        const double x = report.px + report.tx, y = report.py + report.ty;
        reported[pairs[i].b].x += x, reported[pairs[i].b].y += y;
        reported[pairs[i].a].x -= x, reported[pairs[i].a].y -= y;
      }
    }
    double worst = 0, largest = 0;
    for (std::size_t body = 0; body < reported.size(); ++body) {
      const Vec2 force = stage.motion.forces[body].force;
      worst = std::max({worst, std::abs(force.x - reported[body].x), std::abs(force.y - reported[body].y)});
      largest = std::max({largest, std::abs(force.x), std::abs(force.y)});
    }
    CHECK(largest > 1e5);
    CHECK(worst < 1e-9 * largest);

    // Fewer pairs, so that other waves end with other pairs: no sum may show it.
    without_skin.evaluate();
    REQUIRE(without_skin.contacts.pairs().size() + apart - 1 == pairs.size());
    for (std::size_t body = 0; body < reported.size(); ++body) {
      const BodyForce &with = stage.motion.forces[body], &without = without_skin.motion.forces[body];
      REQUIRE(std::memcmp(&with, &without, sizeof with) == 0);
    }
  }
}

TEST_CASE("loads of a wave reach bodies whose later waves have nothing to ask about", "[contact][stage]") {
  HeldStage stage(raft(), shipped_registry());
  constexpr int last_row = 21;  // that touches the row below, and no block beside it
  for (int i = 0; i < rows * rows; ++i) {
    const int x = i % rows, y = i / rows;
    stage.motion.bodies[2 + apart + static_cast<std::size_t>(i)].u = {
        (y < last_row - 1 ? -1e-3 : 2e-2) * x,
        -2e-3 * std::min(y, last_row) + 2e-2 * std::max(y - last_row, 0)};
  }
  stage.evaluate();
  const std::vector<BodyForce> asked = stage.motion.forces;
  const auto pairs = stage.contacts.pairs();
  const auto later = pairs.subspan(pairs_of_wave(1));
  REQUIRE(std::all_of(later.begin(), later.end(), [](const auto& pair) { return pair.contact_count == 0; }));
  const auto straddles = [&](const BodyPair& pair) {
    return pair.contact_count != 0 && std::any_of(later.begin(), later.end(), [&](const BodyPair& other) {
             return other.a == pair.b || other.b == pair.b;
           });
  };
  REQUIRE(std::any_of(pairs.begin(), pairs.end(), straddles));

  for (BodyForce& force : stage.motion.forces) force = {};
  stage.contacts.evaluate(stage.model, stage.motion, {1e-3, true, false});
  for (std::size_t body = 0; body < asked.size(); ++body)
    REQUIRE(std::memcmp(&asked[body], &stage.motion.forces[body], sizeof asked[body]) == 0);
}

TEST_CASE("threads that share pairs anew between searches find the same, and histories go along",
          "[contact][stage]") {
  Workers three(3);
  HeldStage stage(raft(), shipped_registry()), shared(raft(), shipped_registry(), true, three);
  for (HeldStage* each : {&stage, &shared}) {
    push_together(each->motion);
    each->motion.bodies[1].velocity = {1e-3, 0};  // shears its teeth, so that history tells them apart
    for (int i = 0; i < rows * rows; ++i)
      each->motion.bodies[2 + apart + static_cast<std::size_t>(i)].velocity = {1e-4 * (i / rows), 0};
    each->evaluate();
  }
  const auto pairs = stage.contacts.pairs();
  REQUIRE(shared.contacts.pairs().size() == pairs.size());
  for (int step = 0; step < 5; ++step) {
    const ContactTotals alone_found = stage.evaluate_near(), found = shared.evaluate_near();
    REQUIRE(stage.contacts.searches() == 1);
    REQUIRE(shared.contacts.searches() == 1);
    CHECK(found.stored == alone_found.stored);
    CHECK(found.slip_loss == alone_found.slip_loss);
    for (std::size_t body = 0; body < stage.model.bodies.size(); ++body)
      REQUIRE(std::memcmp(&stage.motion.forces[body], &shared.motion.forces[body], sizeof(BodyForce)) == 0);
    bool remembers = false;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto history = stage.contacts.history_of(i), other = shared.contacts.history_of(i);
      REQUIRE(std::equal(history.begin(), history.end(), other.begin(), other.end()));
      remembers = remembers || (!history.empty() && history[0] != 0);
    }
    CHECK(remembers);
  }
}

TEST_CASE("a state whose pairs are none that a search could have made is refused", "[contact][stage]") {
  HeldStage stage(raft(), shipped_registry());
  push_together(stage.motion);
  stage.evaluate();
  Archive kept;
  stage.contacts.exchange(kept, stage.model);
  const auto take = [&](const BodyPair& instead) {
    std::string bytes = kept.bytes();
    const BodyPair& first = stage.contacts.pairs()[0];
    const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&first), sizeof first));
    REQUIRE(at != std::string::npos);
    std::memcpy(bytes.data() + at, &instead, sizeof instead);
    HeldStage again(raft(), shipped_registry());
    Archive taken{std::string_view(bytes)};
    again.contacts.exchange(taken, again.model);
  };
  const BodyPair pair = stage.contacts.pairs()[0];
  REQUIRE(pair.contact_count > 0);
  REQUIRE(stage.contacts.pairs().size() > 1);
  CHECK_NOTHROW(take(pair));
  const auto spoilt = [&](auto BodyPair::*member, std::uint32_t value) {
    BodyPair other = pair;
    other.*member = value;
    return other;
  };
  const auto bodies = static_cast<std::uint32_t>(stage.model.bodies.size());
  CHECK_THROWS_AS(take(spoilt(&BodyPair::b, bodies)), InputError);
  CHECK_THROWS_AS(take(spoilt(&BodyPair::b, bodies - 1)), InputError);
  CHECK_THROWS_AS(take(spoilt(&BodyPair::a, pair.b)), InputError);
  REQUIRE(!pair.plain());
  BodyPair without_pieces = pair;
  without_pieces.piece_pair_range[1] = pair.piece_pair_range[0];
  CHECK_THROWS_AS(take(without_pieces), InputError);
  CHECK_THROWS_AS(take(spoilt(&BodyPair::slot_start, 1)), InputError);
  CHECK_THROWS_AS(take(spoilt(&BodyPair::contact_count, 0)), InputError);
  BodyPair swollen = pair;  // what is only room is not believed
  swollen.slot_capacity = 0xFFFFFFFFu;
  CHECK_NOTHROW(take(swollen));
}

TEST_CASE("a state keeps the slots that pairs have", "[contact][stage]") {
  WorkingScene text;
  text.law = "tally";
  text.interface = R"("normal_stiffness": 1)";
  text.bodies = box("a", 0, 0, 1, 1) + ", " + box("b", 1, 0, 2, 1);
  HeldStage stage(text, tally::registry());
  tally::contacts = 9;
  stage.evaluate();
  tally::contacts = 2;
  stage.evaluate();
  REQUIRE(stage.pair(0, 1).slot_capacity >= 9);
  Archive kept;
  stage.contacts.exchange(kept, stage.model);
  HeldStage again(text, tally::registry());
  Archive taken(kept.bytes());
  again.contacts.exchange(taken, again.model);
  CHECK(again.pair(0, 1).slot_capacity == stage.pair(0, 1).slot_capacity);
  CHECK(again.history(0, 1) == stage.history(0, 1));
  tally::contacts = 1;
}

TEST_CASE("a fixed body is master, and between moving bodies both are or the priority decides",
          "[contact][stage]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1) + ", " + box("base", 0, -1, 9, 0, R"("fixed": true)") + ", " +
                box("b", 1, 0, 3, 1) + ", " + box("c", 3, 0, 4, 1, R"("priority": 2)");
  HeldStage both(text, shipped_registry());
  both.evaluate();
  CHECK(both.pair(0, 1).master_share() == 0);  // the base is the second of its pair
  CHECK(both.pair(1, 2).master_share() == 1);
  CHECK(both.pair(0, 2).master_share() == 0.5);
  CHECK(both.pair(2, 3).master_share() == 0.5);
  CHECK(both.pair(0, 1).reduced_mass == Approx(2300));
  CHECK(both.pair(0, 2).reduced_mass == Approx(2300 * 2 / 3.0));
  CHECK(both.pair(0, 2).offset_x == Approx(1.5));
  CHECK(both.pair(0, 2).offset_y == Approx(0).margin(1e-15));

  Scene scene = text.read();
  scene.roles_by_priority = true;
  ContactStage contacts(scene, both.model, alone(), true);
  contacts.find_pairs(both.model, both.motion, 0, {});
  for (const BodyPair& pair : contacts.pairs()) {
    if (pair.a == 0 && pair.b == 2) CHECK(pair.master_share() == 0.5);  // equal priorities
    if (pair.a == 2 && pair.b == 3) CHECK(pair.master_share() == 0);
  }
}

TEST_CASE("seeking the candidates anew every step changes no bit", "[contact][stage]") {
  WorkingScene text;
  text.gravity = "[3, -10]";
  text.cover = "block";
  text.bodies = box("base", -5, -1, 20, 0, R"("fixed": true)");
  for (int i = 0; i < 6; ++i) {
    text.bodies += ", " + box(fmt::format("b{}", i), 1.5 * i, 0.05 * i, 1.5 * i + 1, 0.05 * i + 1,
                              fmt::format(R"("velocity": [{}, 0])", 3 - i));
  }
  text.time = R"({"end": 0.3})";
  text.interface =
      R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 20,
         "normal_damping": 0.1, "tangential_damping": 0.1)";
  const auto run = [&](bool skin) {
    Simulation simulation(text.read(), {.neighbour_skin = skin});
    while (simulation.advance()) {
    }
    return std::pair{simulation.state_hash(), simulation.summary().pair_searches};
  };
  const auto [with, searches] = run(true);
  const auto [without, all_searches] = run(false);
  CHECK(with == without);
  CHECK(searches * 10 < all_searches);
}

TEST_CASE("edges that are named, but meet all others alike, change no bits", "[contact]") {
  const auto run = [](const std::string& names) {
    WorkingScene text;
    text.cover = "block";
    text.gravity = "[1, -10]";
    text.bodies = box("base", -1, -1, 4, 0, R"("fixed": true)") + ", " + box("a", 0, 0, 1, 1, names) + ", " +
                  box("b", 1, 0, 2, 1.5, names) + ", " + box("c", 0.3, 1.6, 1.2, 2.2, names);
    text.time = R"({"end": 0.2})";
    return run_to_end(text).state_hash();
  };
  const std::string plain = run("");
  CHECK(run(R"("surfaces": {"beds": [0, 2]})") == plain);
  CHECK(run(R"("surfaces": {"beds": [0, 2], "heads": [1, 3]})") == plain);
}
