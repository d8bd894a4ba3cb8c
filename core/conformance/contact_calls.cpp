#include "conformance/contact_calls.hpp"

#include "conformance/contact_setup.hpp"
#include "conformance/differences.hpp"
#include "conformance/guarded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>

namespace talus::conformance {
namespace {

void expect_same_bits(Trial& trial, const std::optional<std::string>& found) {
  trial.due(!found, found.value_or(""), "the same bits");
}

TakenLoads call(const ContactModel& law, const GivenBatch& batch, unsigned char before = 0xFF) {
  TakenLoads taken(batch, before);
  law.evaluate(batch.view(), taken.view());
  return taken;
}

GivenBatch only(GivenBatch batch, const std::vector<std::uint32_t>& active) {
  batch.active = Guarded(std::span<const std::uint32_t>(active));
  return batch;
}

/// Puts what a call on a part of the pairs gave in its place.
void merge(const GivenBatch& part, const TakenLoads& from, TakenLoads& to) {
  const PiecePairs all = part.all_piece_pairs();
  for (const std::uint32_t i : part.active) {
    const BodyPair& pair = part.pairs[i];
    to.pairs[i] = from.pairs[i];
    for (const PiecePair pieces : all.of(pair)) {
      for (std::uint32_t c = pieces.load_start; c < pieces.load_start + part.corners_of(pieces); ++c)
        to.corner[c] = from.corner[c];
    }
    for (std::uint32_t s = pair.slot_start; s < pair.slot_start + pair.slot_capacity; ++s) {
      to.reports[s] = from.reports[s];
      for (std::uint32_t k = 0; k < part.doubles_per_contact; ++k) {
        const std::size_t at = std::size_t{s} * part.doubles_per_contact + k;
        to.history[at] = from.history[at];
      }
    }
  }
}

/// Which bytes of `taken` a call on the active pairs of `batch` may not touch, and did; in words.
std::optional<std::string> trespass(const GivenBatch& batch, const TakenLoads& taken, unsigned char before) {
  if (!taken.corner.surrounded_by(before)) return "past the ends of the loads";
  if (!taken.history.surrounded_by(before)) return "past the ends of history";
  if (!taken.reports.surrounded_by(before)) return "past the ends of reports";
  if (!taken.pairs.surrounded_by(before)) return "past the ends of pairs";
  // As if the active pairs had not been written.
  const TakenLoads untouched(batch, before);
  TakenLoads rest = taken;
  merge(batch, untouched, rest);
  if (!rest.corner.same_bytes(untouched.corner)) return "the loads of a pair that is not active";
  if (!rest.history.same_bytes(untouched.history)) return "history slots that belong to no active pair";
  if (!rest.reports.same_bytes(untouched.reports)) return "reports that belong to no active pair";
  if (!rest.pairs.same_bytes(untouched.pairs)) return "the report of a pair that is not active";
  return std::nullopt;
}

std::vector<std::uint32_t> every_second(const GivenBatch& batch, std::uint32_t first) {
  std::vector<std::uint32_t> active;
  for (std::uint32_t i = first; i < batch.pairs.size(); i += 2) active.push_back(i);
  return active;
}

}  // namespace

void check_restore(const Subject& subject, Trial& trial) {
  for (const HeldPair& pair : pairs_without_ties(18)) {
    trial.feed(fed_pair(pair, 0.5) +
               ", two steps; then the same step once more from the same history, after other calls");
    DrivenLaw law(*subject.component), again(*subject.component);
    law.bodies = again.bodies = pair.bodies;
    law.step();
    again.step();
    law.step();
    again.step();
    const GivenBatch batch = law.given();
    const TakenLoads first = call(law.law(), batch);
    // Other bodies, 20 mm deep, with another time step, in between.
    DrivenLaw other(*subject.component);
    other.bodies = {box(-1, -1, 1, 0), box(-0.5, -0.02, 0.5, 1)};
    other.bodies[1].motion.velocity = {1, -2};
    call(law.law(), other.given(5e-4));
    expect_same_bits(trial, difference_of(batch, first, call(law.law(), batch)));
    trial.feed(fed_pair(pair, 0.5) + ", history saved after two steps and gone on with by another object");
    DrivenLaw restored(*subject.component);
    restored.bodies = law.bodies;
    restored.history = law.history;
    const TakenLoads next = call(restored.law(), restored.given());
    expect_same_bits(trial, difference_of(batch, first, next));
    expect_same_bits(trial, difference_of(batch, first, call(again.law(), again.given())));
  }
}

void check_reset(const Subject& subject, Trial& trial) {
  for (const HeldPair& pair : pairs_without_ties(18)) {
    DrivenLaw law(*subject.component);
    law.bodies = pair.bodies;
    law.step();
    law.step();
    GivenBatch fresh = law.given(), stale = fresh;
    fresh.pairs[0].contact_count = stale.pairs[0].contact_count = 0;
    for (double& value : fresh.history) value = 0;
    for (double& value : stale.history) value = std::isfinite(value) ? 3 * value + 1 : 1e3;
    trial.feed(fed_pair(pair, 0.5) +
               ", no contact a step ago, with zeros and with the remains of former contacts in the slots");
    expect_same_bits(trial, difference_of(fresh, call(law.law(), fresh), call(law.law(), stale)));
  }
  DrivenLaw law(*subject.component, undamped_interface());
  law.bodies = flat_on_flat();
  trial.feed("a block 1 mm deep in a base, sheared by 0.1 mm, lifted by 2 mm, put back");
  law.step();
  law.bodies[1].motion.velocity = {0.1, 0};
  law.step(1e-3);
  law.bodies[1].motion.velocity = {0, 2};
  law.step(1e-3);
  law.bodies[1].motion.velocity = {0, -2};
  const Vec2 back = law.step(1e-3).on(1);
  trial.at_most(std::abs(back.x), 1e-9 * std::abs(back.y), "force along the base [N/m]");
}

void check_split(const Subject& subject, Trial& trial) {
  DrivenLaw driven(*subject.component);
  fill_with_pairs(driven);
  const GivenBatch batch = driven.given();
  const ContactModel& law = driven.law();
  const TakenLoads whole = call(law, batch);
  const auto count = static_cast<std::uint32_t>(batch.pairs.size());

  trial.feed(fmt::format("{} pairs in one call, and one by one", count));
  for (std::uint32_t i = 0; i < count; ++i) {
    const GivenBatch one = only(batch, {i});
    expect_same_bits(trial, difference_of(one, whole, call(law, one)));
  }
  trial.feed(fmt::format("{} pairs in one call, and every second of them", count));
  for (const std::uint32_t first : {0U, 1U}) {
    const GivenBatch half = only(batch, every_second(batch, first));
    expect_same_bits(trial, difference_of(half, whole, call(law, half)));
  }
  trial.feed(fmt::format("{} pairs with and without a place for contact reports", count));
  TakenLoads unseen(batch, 0xFF);
  law.evaluate(batch.view(), unseen.view(false));
  expect_same_bits(trial, difference_of(batch, whole, unseen, {.reports = false}));

  trial.feed(
      fmt::format("{} pairs, and the same behind a body of two pieces that meets none of them", count));
  DrivenLaw behind(*subject.component);
  behind.bodies = {held({{-9, 0}, {-8, 0}, {-8, 0.5}, {-8.5, 0.5}, {-8.5, 1}, {-9, 1}})};
  fill_with_pairs(behind);
  expect_same_bits(trial,
                   difference_of(batch, whole, call(behind.law(), behind.given()), {.history = false}));

  trial.feed(fmt::format("{} pairs in one call, and in two threads at once, 10 times", count));
  const GivenBatch halves[] = {only(batch, every_second(batch, 0)), only(batch, every_second(batch, 1))};
  for (int round = 0; round < 10; ++round) {
    TakenLoads both(batch, 0xFF);
    std::thread other([&] { law.evaluate(halves[1].view(), both.view()); });
    law.evaluate(halves[0].view(), both.view());
    other.join();
    expect_same_bits(trial, difference_of(batch, whole, both));
  }
}

void check_plan(const Subject& subject, Trial& trial) {
  DrivenLaw driven(*subject.component);
  fill_with_pairs(driven);
  const std::unique_ptr<BatchPlan> plan(driven.law().make_plan());
  if (plan == nullptr) {
    trial.not_claimed("make_plan() gives none");
    return;
  }
  // Every second pair meets anew, without slots, while the others keep theirs.
  driven.first_capacity = 0;
  for (std::size_t i = 0; i < driven.met.size(); i += 2) driven.history.erase(driven.met[i]);
  for (int step = 0; step < 80; ++step) {
    if (step % 20 == 10) {  // pairs part, or meet again
      for (HeldBody& body : driven.bodies) body.motion.velocity = -2 * body.motion.velocity;
    }
    if (step == 50) {
      std::reverse(driven.met.begin(), driven.met.end());
      ++driven.layout;
    }
    if (step == 60) {  // all of them far into each other at once
      for (const auto& [a, b] : driven.met) {
        const Vec2 from = driven.bodies[a].centre, to = driven.bodies[b].centre;
        driven.bodies[b].motion.u.x += 0.4 * (from.x - to.x);
        driven.bodies[b].motion.u.y += 0.4 * (from.y - to.y);
      }
    }
    GivenBatch alone = driven.given(1e-4 * (1 + step % 3));
    if (step % 8 == 5) alone = only(alone, every_second(alone, 0));
    GivenBatch planned = alone;
    planned.plan = plan.get();
    planned.layout = driven.layout;
    trial.feed(fmt::format("step {}: {} pairs on a plan that is {} steps old, and without", step + 1,
                           alone.active.size(), step < 50 ? step : step - 50));
    // In a thread of its own, which has seen no other batch.
    TakenLoads taken(planned, 0xFF);
    std::thread([&] { driven.law().evaluate(planned.view(), taken.view()); }).join();
    expect_same_bits(trial, difference_of(alone, call(driven.law(), alone), taken));
    driven.step();
  }
}

void check_writes(const Subject& subject, Trial& trial) {
  DrivenLaw driven(*subject.component);
  fill_with_pairs(driven);
  constexpr unsigned char mark = 0xA5;
  const GivenBatch batch = driven.given();
  const auto expect_within = [&](const GivenBatch& before, const std::string& fed) {
    trial.feed(fed);
    GivenBatch asked = before;
    asked.surround(0);
    const TakenLoads taken = call(driven.law(), asked, mark);
    const auto found = trespass(asked, taken, mark);
    trial.due(!found, "written: " + found.value_or(""),
              "writes to the reports, loads and slots of the active pairs alone");
    const auto changed = asked.differs_from(before);
    trial.due(!changed, "changed: " + changed.value_or("") + ", which is read-only", "nothing changed");
  };
  expect_within(batch, "24 pairs, all active, between marked zones");
  expect_within(only(batch, every_second(batch, 0)), "24 pairs, every second active");
  expect_within(only(batch, every_second(batch, 1)), "24 pairs, every second active, from the second on");
  DrivenLaw roomless(*subject.component);
  fill_with_pairs(roomless);
  roomless.first_capacity = 0;
  roomless.history.clear();
  expect_within(roomless.given(), "24 pairs, none with room for contacts");
  trial.feed("24 pairs, asked again with room for the contacts they count, and with room at once");
  driven.history.clear();
  for (int step = 0; step < 3; ++step) expect_same_bits(trial, difference_of(driven.step(), roomless.step()));
  DrivenLaw rows(*subject.component);
  rows.bodies = saw_teeth(1e-3).bodies;
  expect_within(rows.given(), "two rows of teeth with room for one contact only");
  const Component& component = *subject.component->component;
  Guarded<double> values(
      in_order({component.interface_parameters, component.interface_parameter_count}, lively_interface()));
  values.surround(mark);
  trial.feed("the values of an interface between marked zones, to prepare_interface()");
  driven.law().prepare_interface(values.data());
  trial.due(values.surrounded_by(mark), "written: past the ends of the values",
            "writes to the values that the law declares");
}

void check_reads(const Subject& subject, Trial& trial) {
  DrivenLaw driven(*subject.component);
  fill_with_pairs(driven);
  const GivenBatch clean = driven.given();
  const TakenLoads due = call(driven.law(), clean);
  for (const unsigned char around : {static_cast<unsigned char>(0xFF), static_cast<unsigned char>(0x40)}) {
    trial.feed(
        fmt::format("24 pairs; around every array bytes of 0x{:02X}{}, beside the same with zeros there",
                    around, around == 0xFF ? " (NaN)" : ""));
    GivenBatch poisoned = clean;
    poisoned.surround(around);
    expect_same_bits(trial, difference_of(clean, due, call(driven.law(), poisoned)));
    trial.feed(fmt::format("24 pairs; bytes of 0x{:02X} in what the law is to fill in", around));
    expect_same_bits(trial, difference_of(clean, due, call(driven.law(), clean, around)));
  }
}

void check_degenerate(const Subject& subject, Trial& trial) {
  for (const HeldPair& pair : pairs_without_ties(18)) {
    trial.feed(fed_pair(pair, 0.5) + ", the first call of a run, no time after the one before: dt = 0");
    DrivenLaw law(*subject.component);
    law.bodies = pair.bodies;
    for (const double dt : {0.0, 1e-4}) {
      const Evaluation e = law.step(dt);
      const PairReport& report = e.pairs[0];
      trial.due(std::isfinite(e.size() + report.stored + report.slip_loss + report.damping_power),
                "a load or an energy that is no finite number", "finite ones");
    }
  }
  const auto evaluate = [&](const std::string& fed, const std::vector<HeldBody>& bodies, bool finite) {
    for (const bool swapped : {false, true}) {
      for (const bool plain : {true, false}) {
        trial.feed(fed + (swapped ? ", the other way round" : ""));
        DrivenLaw law(*subject.component);
        law.bodies = bodies;
        law.plain = plain;
        if (swapped) std::swap(law.bodies[0], law.bodies[1]);
        for (int step = 0; step < 2; ++step) {
          const Evaluation e = law.step();
          if (!finite) continue;
          const double size = e.size();
          trial.due(std::isfinite(size), "a load that is no finite number", "finite loads");
          const Vec2 net = e.net_force();
          trial.at_most(std::hypot(net.x, net.y), 1e-9 * size, "resultant of all loads [N/m]");
        }
      }
    }
  };
  const HeldBody base = box(-1, -1, 1, 0), block = box(-0.5, -1e-3, 0.5, 1);
  const std::vector<Vec2> ring{{-0.5, -1e-3}, {0.5, -1e-3}, {0.5, 1}, {-0.5, 1}};
  const auto doubled = [&](std::size_t corner) {
    std::vector<Vec2> result = ring;
    result.insert(result.begin() + static_cast<std::ptrdiff_t>(corner), ring[corner]);
    return held_as_it_is(result);
  };
  for (const std::size_t corner : {0U, 1U, 2U})
    evaluate(fmt::format("a side without length at corner {}", corner), {base, doubled(corner)}, true);
  evaluate("a joint in a side, twice at the same place",
           {held_as_it_is({{-1, -1}, {1, -1}, {1, 0}, {0.2, 0}, {0.2, 0}, {-1, 0}}), block}, true);
  evaluate("a side of 1e-300 m",
           {base, held_as_it_is({{-0.5, 0}, {0.5, 0}, {0.5, 1e-300}, {0.5, 1}, {-0.5, 1}})}, true);
  evaluate("all corners of a body at one place",
           {base, held_as_it_is({{0, -1e-3}, {0, -1e-3}, {0, -1e-3}, {0, -1e-3}})}, true);
  evaluate("a body without area", {base, held_as_it_is({{-0.5, -1e-3}, {0.5, -1e-3}, {0, -1e-3}})}, true);
  evaluate("two bodies at the same place", {block, block}, true);
  evaluate("a body within another", {box(-2, -2, 2, 2), box(-0.1, -0.2, 0.3, 0.1)}, true);
  evaluate("sides that coincide, without overlap", {base, box(-0.5, 0, 0.5, 1)}, true);

  constexpr double broken[] = {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), 1e200};
  for (const double value : broken) {
    HeldBody coordinate = block, velocity = block, all = block;
    coordinate.pieces[0][0].at.x = value;
    velocity.motion.velocity.x = value;
    all.motion.u = {value, value};
    evaluate(fmt::format("a corner at x = {} m", value), {base, coordinate}, false);
    evaluate(fmt::format("a velocity of {} m/s", value), {base, velocity}, false);
    evaluate(fmt::format("a body at ({0}, {0}) m", value), {base, all}, false);
  }
}

}  // namespace talus::conformance
