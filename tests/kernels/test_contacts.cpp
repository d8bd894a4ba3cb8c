#include "kernels/level.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

using namespace talus;
using namespace talus::kernels;

namespace {

constexpr double untouched = -7;

/// A batch of two chunks as a law leaves it: pairs that touch, have parted, are apart, or are short of slots.
struct SomePairs {
  std::vector<BodyPair> pairs;
  std::vector<PairReport> reports;
  std::vector<float> ask_again, approach;
  std::vector<FormerDashpots> dashpots;
  std::vector<double> history, found;
  std::vector<Drift> drift;  ///< [body]
  std::uint32_t doubles;
  static constexpr double rounding = 1e-3;
  static constexpr Way way{2, 0.25, 3.5};
  ContactTotals totals[2];
  ClosedChunk closed[2];

  explicit SomePairs(std::uint32_t history_doubles) : doubles(history_doubles) {
    std::mt19937 source(11);
    const auto random = [&] { return (static_cast<double>(source()) + 1) / 4294967296.0; };
    std::uint32_t slot = 1;  // one to either side is nobody's
    for (std::uint32_t i = 0; i < 2 * pair_chunk - 9; ++i) {
      BodyPair pair{};
      pair.a = i, pair.b = i + 1000;
      pair.contact_count = i % 5 == 0 ? 0 : 1;
      pair.slot_start = slot,
      pair.slot_capacity = i % 3 + pair.contact_count;  // without contact down to none
      slot += pair.slot_capacity;
      PairReport report{};
      if (i % 4 == 0) {
        report.gap = random();
        report.slip_loss = pair.contact_count == 0 ? 0 : random();  // let go as the pair parts
      } else {
        const std::uint32_t contacts =
            i % 17 == 1 ? pair.slot_capacity + 2 : 1 + i % std::max(pair.slot_capacity, 1U);
        report = {contacts, static_cast<float>(random()), random(), random(), random(), random(), 0};
        if (i % 6 == 5) report.damping_power = 0;  // nothing has moved yet
        if (i % 12 == 11) report.damping_force = 0;
      }
      pairs.push_back(pair);
      reports.push_back(report);
      ask_again.push_back(untouched);
      approach.push_back(untouched);
    }
    for (std::size_t body = 0; body < 1000 + pairs.size(); ++body)
      drift.push_back({at_most(random()), at_most(random()), at_least(random())});
    history.assign((slot + 1) * doubles, untouched);
    for (std::uint32_t i = 0; i <= slot; ++i)  // also of who is apart
      dashpots.push_back({static_cast<float>(random()), static_cast<float>(random())});
    for (std::size_t i = 0; i < history.size(); ++i) found.push_back(random());
  }

  /// Those of `asked`, rising.
  void close(SimdLevel level, const std::vector<std::uint32_t>& asked) {
    const PairBooks books{pairs.data(),    ask_again.data(),
                          approach.data(), dashpots.data(),
                          history.data(),  found.data(),
                          reports.data(),  doubles,
                          drift.data(),    way,
                          rounding,        true};
    for (std::uint32_t chunk = 0, at = 0; chunk < 2; ++chunk) {
      const std::uint32_t first = at;
      while (at < asked.size() && asked[at] / pair_chunk == chunk) ++at;
      contact_kernels(level).close(books, asked.data() + first, at - first, totals[chunk], closed[chunk]);
    }
  }

  /// The same, as it reads.
  void close_plainly() {
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      BodyPair& pair = pairs[i];
      const PairReport& report = reports[i];
      ContactTotals& sum = totals[i / pair_chunk];
      if (report.contact_count > pair.slot_capacity) continue;
      sum.stored += report.stored;
      sum.slip_loss += report.slip_loss;
      if (report.contact_count > 0) {
        FormerDashpots& former = dashpots[pair.slot_start];
        sum.damping_loss += report.damping_power / 2;
        if (report.damping_force == 0) {
          former = {0, 0};
        } else {
          if (pair.contact_count > 0)
            sum.damping_loss += former.force * (report.damping_power / report.damping_force) / 2;
          former = {static_cast<float>(report.damping_power), report.damping_force};
        }
        if (report.penetration > sum.penetration)
          sum.penetration = report.penetration, sum.deepest_a = pair.a, sum.deepest_b = pair.b;
        for (std::uint32_t at = 0; at < report.contact_count * doubles; ++at)
          history[pair.slot_start * doubles + at] = found[pair.slot_start * doubles + at];
      }
      if (report.contact_count == 0 && pair.contact_count > 0)
        sum.damping_loss += dashpots[pair.slot_start].power / 2.0;
      if (report.contact_count == 0) approach[i] = at_least(drift[pair.a].approach(drift[pair.b]));
      ask_again[i] = report.contact_count > 0
                         ? 0
                         : at_most(std::min(2.0 * approach[i] + 0.25, 3.5) + report.gap - rounding);
      pair.contact_count = report.contact_count;
    }
  }
};

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < count; ++i) all.push_back(i);
  return all;
}

bool same_dashpots(const std::vector<FormerDashpots>& p, const std::vector<FormerDashpots>& q) {
  return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof p[0]) == 0;
}

bool same_totals(const ContactTotals& p, const ContactTotals& q) {
  return std::memcmp(&p, &q, sizeof p) == 0;
}

}  // namespace

TEST_CASE("pairs are closed as each alone would be", "[kernels][contacts]") {
  for (int level = 0; level <= static_cast<int>(best_simd_level()); ++level) {
    for (const std::uint32_t doubles : {0U, 1U, 2U, 3U, 4U, 5U, 7U, 8U, 9U, 12U, 13U}) {
      CAPTURE(level, doubles);
      SomePairs due(doubles), got(doubles);
      const std::vector<BodyPair> before = got.pairs;
      due.close_plainly();
      got.close(static_cast<SimdLevel>(level), numbers(got.pairs.size()));
      CHECK(got.ask_again == due.ask_again);
      CHECK(got.approach == due.approach);
      CHECK(same_dashpots(got.dashpots, due.dashpots));
      CHECK(got.history == due.history);
      for (std::size_t i = 0; i < got.pairs.size(); ++i)
        REQUIRE(got.pairs[i].contact_count == due.pairs[i].contact_count);
      std::vector<std::uint32_t> met, parted, short_of_room;
      for (std::uint32_t i = 0; i < before.size(); ++i) {
        const bool is_short = got.reports[i].contact_count > before[i].slot_capacity;
        if (is_short) short_of_room.push_back(i);
        if (!is_short && got.reports[i].contact_count > 0 && before[i].contact_count == 0) met.push_back(i);
        if (got.reports[i].contact_count == 0 && before[i].contact_count > 0) parted.push_back(i);
      }
      std::vector<std::uint32_t> said_met, said_parted, said_short;
      for (int chunk = 0; chunk < 2; ++chunk) {
        const ClosedChunk& closed = got.closed[chunk];
        said_met.insert(said_met.end(), closed.met.begin(), closed.met.end());
        said_parted.insert(said_parted.end(), closed.parted.begin(), closed.parted.end());
        said_short.insert(said_short.end(), closed.short_of_room.begin(), closed.short_of_room.end());
        CHECK(closed.finite);
        const ContactTotals &sum = got.totals[chunk], &wanted = due.totals[chunk];
        // Sums of less than a hundred numbers that are not negative.
        CHECK(sum.stored == Approx(wanted.stored).epsilon(1e-13));
        CHECK(sum.slip_loss == Approx(wanted.slip_loss).epsilon(1e-13));
        CHECK(sum.damping_loss == Approx(wanted.damping_loss).epsilon(1e-13));
        CHECK(sum.penetration == wanted.penetration);
        CHECK(sum.deepest_a == wanted.deepest_a);
        CHECK(sum.deepest_b == wanted.deepest_b);
      }
      CHECK(said_met == met);
      CHECK(said_parted == parted);
      CHECK(said_short == short_of_room);
    }
  }
}

TEST_CASE("what pairs add up to shows neither the instruction set nor pairs apart that were not asked about",
          "[kernels][contacts]") {
  SomePairs due(9);
  const std::vector<std::uint32_t> all = numbers(due.pairs.size());
  due.close(SimdLevel::scalar, all);
  std::vector<std::uint32_t> fewer;
  for (const std::uint32_t i : all) {
    if (due.reports[i].contact_count > 0 || due.reports[i].slip_loss > 0) fewer.push_back(i);
  }
  REQUIRE(fewer.size() < all.size());
  for (int level = 0; level <= static_cast<int>(best_simd_level()); ++level) {
    for (const auto& asked : {all, fewer}) {
      CAPTURE(level, asked.size());
      SomePairs got(9);
      got.close(static_cast<SimdLevel>(level), asked);
      for (int chunk = 0; chunk < 2; ++chunk) CHECK(same_totals(got.totals[chunk], due.totals[chunk]));
    }
  }
}

TEST_CASE("a report that is no number is told, of pairs that touch and of others", "[kernels][contacts]") {
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  for (int level = 0; level <= static_cast<int>(best_simd_level()); ++level) {
    for (const std::uint32_t pair : {4U, 5U}) {
      for (double PairReport::*value : {&PairReport::penetration, &PairReport::stored, &PairReport::slip_loss,
                                        &PairReport::damping_power}) {
        CAPTURE(level, pair);
        SomePairs got(9);
        REQUIRE((got.reports[pair].contact_count == 0) == (pair == 4));
        got.reports[pair].*value = no_number;
        got.close(static_cast<SimdLevel>(level), numbers(got.pairs.size()));
        CHECK_FALSE(got.closed[0].finite);
        CHECK(got.closed[1].finite);
      }
      if (pair == 4) continue;  // no dashpot
      SomePairs got(9);
      got.reports[pair].damping_force = static_cast<float>(no_number);
      got.close(static_cast<SimdLevel>(level), numbers(got.pairs.size()));
      CHECK_FALSE(got.closed[0].finite);
      CHECK(got.closed[1].finite);
    }
  }
}

TEST_CASE("the pairs that are due are chosen, and no more room is taken than for all",
          "[kernels][contacts]") {
  std::mt19937 source(3);
  for (int level = 0; level <= static_cast<int>(best_simd_level()); ++level) {
    for (std::uint32_t count = 0; count < 40; ++count) {
      for (const Way& way :
           {Way{0, -1, -1}, Way{0, 0, 9}, Way{1, 0, 9}, Way{0, 2, 9}, Way{1, 2, 9}, Way{0.5, 3.5, 2}}) {
        CAPTURE(level, count, way.time, way.strayed, way.travelled);
        std::vector<float> ask_again, approach;
        std::vector<std::uint32_t> due;
        for (std::uint32_t i = 0; i < count; ++i) {
          ask_again.push_back(static_cast<float>(source() % 6) - 1);
          approach.push_back(static_cast<float>(source() % 3));
          if (ask_again.back() <= std::min(approach.back() * way.time + way.strayed, way.travelled))
            due.push_back(i);
        }
        constexpr std::uint32_t guard = 12345;
        std::vector<std::uint32_t> chosen(count + 1, guard);
        const std::uint32_t found = contact_kernels(static_cast<SimdLevel>(level))
                                        .choose(ask_again.data(), approach.data(), count, way, chosen.data());
        CHECK(chosen.back() == guard);
        chosen.resize(found);
        CHECK(chosen == due);
      }
    }
  }
}
