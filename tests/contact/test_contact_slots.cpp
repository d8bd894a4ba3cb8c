#include "contact/contact_slots.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <vector>

using namespace talus;

namespace {

constexpr std::uint32_t doubles = 3;

/// Pairs in batches. What is kept of the contacts of each tells its number, the contact and the place.
struct SomeSlots {
  ContactSlots slots;
  std::vector<BodyPair> pairs;
  std::vector<std::uint32_t> batch_begin{0};
  std::mt19937 source{5};

  SomeSlots() { slots.keep(doubles, true); }
  std::uint32_t random() { return static_cast<std::uint32_t>(source()); }

  /// Capacities up to `most`, and no contact in a third of the pairs.
  void fill(std::initializer_list<std::uint32_t> batches, std::uint32_t most) {
    for (const std::uint32_t count : batches) batch_begin.push_back(batch_begin.back() + count);
    pairs.resize(batch_begin.back());
    for (BodyPair& pair : pairs) pair.slot_capacity = random() % (most + 1);
    slots.lay_out(pairs, batch_begin);
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i].slot_capacity > 0 && random() % 3 > 0) touch(i, 1 + random() % pairs[i].slot_capacity);
    }
  }

  std::size_t batch_of(std::uint32_t pair) const {
    return static_cast<std::size_t>(std::upper_bound(batch_begin.begin(), batch_begin.end(), pair) -
                                    batch_begin.begin()) -
           1;
  }
  std::size_t slot_of(std::uint32_t pair) const {
    return slots.first_of(batch_of(pair)) + pairs[pair].slot_start;
  }

  static double value(std::uint32_t pair, std::uint32_t contact, std::uint32_t place) {
    return 100.0 * pair + 10 * contact + place;
  }
  void touch(std::uint32_t pair, std::uint32_t contacts) {
    REQUIRE(contacts <= pairs[pair].slot_capacity);
    pairs[pair].contact_count = contacts;
    for (std::uint32_t c = 0; c < contacts; ++c) {
      for (std::uint32_t k = 0; k < doubles; ++k) slots.history(slot_of(pair) + c)[k] = value(pair, c, k);
      slots.reports(slot_of(pair) + c)->px = value(pair, c, 7);
    }
    slots.dashpots(slot_of(pair))->force = static_cast<float>(value(pair, 0, 9));
  }

  /// Each contact is where its pair says, and no slot is given twice or lies beyond its batch.
  void check() {
    std::vector<char> taken;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      const std::size_t first = slot_of(i), end = first + pairs[i].slot_capacity;
      if (pairs[i].slot_capacity > 0) REQUIRE(end <= slots.first_of(batch_of(i) + 1));
      taken.resize(std::max(taken.size(), end));
      for (std::size_t slot = first; slot < end; ++slot) REQUIRE(taken[slot]++ == 0);
      check_contacts(i, first);
    }
  }
  void check_contacts(std::uint32_t pair, std::size_t first) {
    CAPTURE(pair, first);
    for (std::uint32_t c = 0; c < pairs[pair].contact_count; ++c) {
      for (std::uint32_t k = 0; k < doubles; ++k) REQUIRE(slots.history(first + c)[k] == value(pair, c, k));
      REQUIRE(slots.reports(first + c)->px == value(pair, c, 7));
    }
    if (pairs[pair].contact_count > 0)
      REQUIRE(slots.dashpots(first)->force == static_cast<float>(value(pair, 0, 9)));
  }
};

}  // namespace

TEST_CASE("contacts closed up lie one after the other, and find their slots again", "[contact][slots]") {
  SomeSlots some;
  some.fill({7, 100, 1, 64}, 3);
  some.check();
  some.slots.close_up(some.pairs, some.batch_begin);
  std::uint32_t contacts = 0;
  for (std::uint32_t i = 0; i < some.pairs.size(); ++i) {
    REQUIRE(some.pairs[i].slot_start == contacts);
    some.check_contacts(i, contacts);
    contacts += some.pairs[i].contact_count;
  }
  CHECK(some.slots.hold(contacts));
  CHECK_FALSE(some.slots.hold(contacts + 1));
  some.batch_begin = {0, 50, 51, 172};  // divided otherwise
  some.slots.lay_out(some.pairs, some.batch_begin);
  some.check();
}

TEST_CASE("pairs that meet get slots of their batch, and others keep theirs", "[contact][slots]") {
  SomeSlots some;
  some.fill({40, 3, 200, 90}, 2);
  for (int round = 0; round < 30; ++round) {
    CAPTURE(round);
    const std::vector<BodyPair> before = some.pairs;
    std::vector<std::uint32_t> wanted(some.batch_begin.size() - 1, 0), more;
    for (std::uint32_t i = 0; i < some.pairs.size(); ++i) {
      // Some for the first time, a few that had too few.
      if (some.random() % (some.pairs[i].slot_capacity == 0 ? 10 : 100) == 0) more.push_back(i);
    }
    const auto room = [&](std::uint32_t pair) { return 2 * some.pairs[pair].slot_capacity + 1; };
    for (const std::uint32_t pair : more) wanted[some.batch_of(pair)] += room(pair);
    some.slots.widen(wanted);
    some.check();
    for (const std::uint32_t pair : more) some.slots.give(some.pairs[pair], some.batch_of(pair), room(pair));
    some.check();
    for (std::uint32_t i = 0; i < some.pairs.size(); ++i) {
      if (std::find(more.begin(), more.end(), i) != more.end()) {
        some.touch(i, some.pairs[i].slot_capacity);
      } else {
        REQUIRE(some.pairs[i].slot_start == before[i].slot_start);
      }
    }
    some.check();
    if (round % 10 == 9) {  // slots that were left are used again
      some.slots.close_up(some.pairs, some.batch_begin);
      some.slots.lay_out(some.pairs, some.batch_begin);
      some.check();
    }
  }
}

TEST_CASE("a scene's pairs without contact have no slots", "[contact][slots]") {
  SomeSlots some;
  some.batch_begin = {0, 1024, 2048};
  some.pairs.resize(2048);
  some.slots.lay_out(some.pairs, some.batch_begin);
  CHECK(some.slots.first_of(2) < 2048 / 16);
  CHECK(some.slots.most() == some.slots.first_of(1));
}
