#include "compare/deviation.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace talus;

namespace {

Series straight(std::vector<double> times, double offset, double slope) {
  Series series{times, {"block.speed [m/s]"}, {{}}};
  for (const double time : times) series.values[0].push_back(offset + slope * time);
  return series;
}

}  // namespace

TEST_CASE("the deviation of two curves is their largest, root mean square and last difference",
          "[compare][deviation]") {
  const Series baseline = straight({0, 1, 2, 3}, 0, 1);
  Series run = baseline;
  run.values[0] = {0, 1.5, -1, 3.25};
  const auto found = deviation(run, 0, baseline, 0, Between::unknown);
  REQUIRE(found);
  CHECK(found->largest == -3);
  CHECK(found->largest_time == 2);
  CHECK(found->rms == Approx(std::sqrt((0.25 + 9 + 0.0625) / 4)).epsilon(1e-15));
  CHECK(found->final == 0.25);
  CHECK(found->final_time == 3);
  CHECK(found->times == 4);
}

TEST_CASE("a reference is interpolated, and used only as far as it reaches", "[compare][deviation]") {
  const Series reference = straight({0.5, 2.5}, 1, 2);
  const Series run = straight({0, 0.5, 1, 2, 2.5, 3}, 1.125, 2);
  const auto found = deviation(run, 0, reference, 0, Between::line);
  REQUIRE(found);
  CHECK(found->times == 4);
  CHECK(found->largest == Approx(0.125));
  CHECK(found->rms == Approx(0.125));
  CHECK(found->final_time == 2.5);
  CHECK_FALSE(deviation(straight({7, 8}, 0, 0), 0, reference, 0, Between::line));
  CHECK(deviation_at(run, 0, reference, 0, Between::line, 1.75).value() == Approx(0.125));
  CHECK_FALSE(deviation_at(run, 0, reference, 0, Between::line, 2.75));
}

TEST_CASE("runs are compared at the times that both have written down", "[compare][deviation]") {
  Series coarse{{0, 1, 2}, {"block.speed [m/s]"}, {{0, 1, 4}}}, fine{{}, coarse.names, {{}}};
  for (int i = 0; i <= 20; ++i) {
    fine.time.push_back(0.1 * i);
    fine.values[0].push_back(0.01 * i * i);
  }
  // A line between the rows of the coarse one is off by 0.25.
  for (const auto* run : {&fine, &coarse}) {
    const auto found = deviation(*run, 0, run == &fine ? coarse : fine, 0, Between::unknown);
    REQUIRE(found);
    CHECK(found->times == 3);
    CHECK(std::abs(found->largest) < 1e-12);
    const auto between = deviation_at(*run, 0, run == &fine ? coarse : fine, 0, Between::unknown, 1.5);
    REQUIRE(between);
    CHECK(std::abs(*between) < 1e-12);
  }
  CHECK(std::abs(deviation(fine, 0, coarse, 0, Between::line)->largest) == Approx(0.25));
}

TEST_CASE("runs whose rows fall together now and then are compared there alone", "[compare][deviation]") {
  const auto bent = [](double step) {
    Series series{{}, {"block.speed [m/s]"}, {{}}};
    for (int i = 0; i * step <= 1 + 1e-12; ++i) {
      series.time.push_back(i * step);
      series.values[0].push_back(std::abs(i * step - 0.5));  // it turns at a row of neither
    }
    return series;
  };
  const Series some = bent(0.06), others = bent(0.04);
  const auto found = deviation(some, 0, others, 0, Between::unknown);
  REQUIRE(found);
  CHECK(found->times == 9);
  CHECK(std::abs(found->largest) < 1e-12);
  CHECK_FALSE(found->between_rows);
  // Where only the start falls together there is nothing but the line between rows.
  Series aside = others;
  for (std::size_t i = 1; i < aside.time.size(); ++i) aside.time[i] += 0.001;
  const auto guessed = deviation(some, 0, aside, 0, Between::unknown);
  REQUIRE(guessed);
  CHECK(guessed->times > 9);
  CHECK(guessed->between_rows);
}

TEST_CASE("a curve written with six digits goes on for as long as the run that it was",
          "[compare][deviation]") {
  const Series run = straight({0, 1 / 3.0, 2 / 3.0}, 0, 1),
               reference = straight({0, 0.333333, 0.666666}, 0, 1);
  const auto found = deviation(run, 0, reference, 0, Between::line);
  REQUIRE(found);
  CHECK(found->times == 3);
  CHECK(found->final_time == run.time.back());
}

TEST_CASE("the moment at which a run was stopped is compared, too", "[compare][deviation]") {
  const Series baseline{{0, 1, 2, 3}, {"block.speed [m/s]"}, {{0, 0, 0, 0}}};
  Series stopped{{0, 1, 1.5}, {"block.speed [m/s]"}, {{0, 0, 7}}};
  CHECK(deviation(stopped, 0, baseline, 0, Between::unknown)->final_time == 1);  // as a run of 1.5 s
  stopped.stopped = true;
  const auto found = deviation(stopped, 0, baseline, 0, Between::unknown);
  REQUIRE(found);
  CHECK(found->largest == 7);
  CHECK(found->final_time == 1.5);
}

TEST_CASE("a value that is no number is the largest deviation", "[compare][deviation]") {
  const Series baseline = straight({0, 1, 2}, 0, 0);
  Series run = baseline;
  run.values[0] = {5, std::numeric_limits<double>::quiet_NaN(), 9};
  const auto found = deviation(run, 0, baseline, 0, Between::unknown);
  REQUIRE(found);
  CHECK(std::isnan(found->largest));
  CHECK(found->largest_time == 1);
  const Tolerance tolerance{"block", "speed", false, 100, {}, {}};
  CHECK(check(tolerance, *found)[0].verdict == ToleranceVerdict::broken);
}

TEST_CASE("each limit of a tolerance is judged by magnitude", "[compare][deviation]") {
  const Deviation found{-0.3, 1, 0.1, 0.05, 2, 10};
  const auto checks = check({"block", "speed", false, 0.2, 0.1, 0.06}, found);
  REQUIRE(checks.size() == 3);
  CHECK(checks[0].measure == "largest");
  CHECK(checks[0].verdict == ToleranceVerdict::broken);
  CHECK(checks[1].verdict == ToleranceVerdict::held);
  CHECK(checks[2].verdict == ToleranceVerdict::held);
  CHECK(check({"block", "speed", false, {}, {}, 0.01}, found).size() == 1);
  // Of a part of the time, only the largest can be known to be too large.
  const auto part = check({"block", "speed", false, 0.2, 0.09, 0.06}, found, true);
  CHECK(part[0].verdict == ToleranceVerdict::broken);
  CHECK(part[1].verdict == ToleranceVerdict::cut_short);
  CHECK(part[2].verdict == ToleranceVerdict::cut_short);
}
