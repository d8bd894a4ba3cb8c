#include "scene/function.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

using namespace talus;

namespace {

/// Rises from 1 at -2 to 5 at 0, falls to -1 at 3.
Table sample_table() {
  return {{-2, 0, 3}, {1, 5, -1}};
}

Function of_time(Table table, double scale = 1) {
  return {{{scale, std::move(table), {}, {}}}};
}

/// ∫ from 0 by the trapezoidal rule on a grid on which all points of the table lie.
double summed(const Table& table, double until) {
  const int steps = 20000;
  const double h = until / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += h * (table(i * h) + table((i + 1) * h)) / 2;
  return sum;
}

}  // namespace

TEST_CASE("a table is linear between its points, exact at them and constant beyond", "[scene]") {
  const Table table = sample_table();
  CHECK(table(-2) == 1);
  CHECK(table(0) == 5);
  CHECK(table(3) == -1);
  CHECK(table(-1) == 3);
  CHECK(table(1.5) == 2);
  CHECK(table(-1e300) == 1);
  CHECK(table(1e300) == -1);
  CHECK(Table({7}, {3})(-1) == 3);
  CHECK(Table({7}, {3})(8) == 3);
}

TEST_CASE("a table of the largest numbers does not overflow between its points", "[scene]") {
  const double most = std::numeric_limits<double>::max();
  CHECK(Table({0, 1}, {most, -most})(0.5) == 0);
  CHECK(Table({0, 1}, {most, most}).integral(1) == most);
}

TEST_CASE("the integral of a table starts at zero and goes both ways", "[scene]") {
  const Table table = sample_table();
  CHECK(table.integral(0) == 0);
  CHECK(table.integral(1.5) == Approx(1.5 * (5 + 2) / 2));
  CHECK(table.integral(3) == Approx(6));
  CHECK(table.integral(10) == Approx(6 - 7));
  CHECK(table.integral(-1) == Approx(-4));
  CHECK(table.integral(-2) == Approx(-6));
  CHECK(table.integral(-5) == Approx(-6 - 3));
}

TEST_CASE("the integral of a table is that of its values, wherever its points lie about zero", "[scene]") {
  for (const double shift : {-40.0, -3.0, -1.0, 0.0, 1.0, 2.0, 40.0}) {
    const Table table({-2 + shift, shift, 3 + shift}, {1, 5, -1});
    CHECK(table.integral(0) == 0);
    for (const double until : {-50.0, -2.0, 1.0, 5.0, 50.0}) {
      CAPTURE(shift, until);
      CHECK(table.integral(until) == Approx(summed(table, until)).margin(1e-4));
    }
  }
}

TEST_CASE("a function is the sum of products of scale, time and place", "[scene]") {
  const Table ramp({0, 2}, {0, 1}), across({0, 10}, {1, 3}), up({-1, 1}, {0, 4});
  const Function function{{{6, ramp, across, {}}, {0.5, {}, {}, up}, {7, {}, {}, {}}}};
  CHECK(function(1, {5, 0}) == 6 * 0.5 * 2 + 0.5 * 2 + 7);
  CHECK(function(9, {99, 99}) == 6 * 1 * 3 + 0.5 * 4 + 7);
  CHECK(function(-1, {-9, -9}) == 7);
}

TEST_CASE("the integral of a function is over time, terms without time growing with it", "[scene]") {
  const Function function{{{6, Table({0, 2}, {0, 1}), Table({0, 10}, {1, 3}), {}}, {7, {}, {}, {}}}};
  CHECK(function.integral(0, {5, 0}) == 0);
  CHECK(function.integral(2, {5, 0}) == Approx(6 * 1 * 2 + 7 * 2));
  CHECK(function.integral(3, {5, 0}) == Approx(6 * 2 * 2 + 7 * 3));
  CHECK(function.integral(-3, {5, 0}) == Approx(-21));
  CHECK(of_time(sample_table(), -2).integral(3, {}) == Approx(-12));
}

TEST_CASE("a function without terms is zero", "[scene]") {
  CHECK(Function{}.zero());
  CHECK(Function{}(3, {1, 2}) == 0);
  CHECK(Function{}.integral(3, {1, 2}) == 0);
  CHECK_FALSE(of_time(sample_table()).zero());
}

TEST_CASE("what is shorter than a step acts with its mean over the step", "[scene][function]") {
  const Table pulse{{1, 1.001, 1.002}, {0, 500, 0}};  // area 0.5
  double sum = 0;
  for (int n = 0; n <= 20; ++n) {
    const StepSpan span(n * 0.1, n > 0 ? 0.1 : 0, 0.1);
    sum += pulse.over(span) * (span.end - span.begin);
  }
  CHECK(sum == Approx(0.5).epsilon(1e-12));

  // Steps of two lengths, of which some hold several points and some none.
  const Table table = sample_table();
  double time = -3, behind = 0;
  for (int n = 0; time < 4; ++n) {
    const double ahead = n % 3 == 0 ? 4.1 : 0.07;
    const StepSpan span(time, behind, ahead);
    const double share = table.over(span);
    double exact = 0;
    const int parts = 4000;
    for (int i = 0; i < parts; ++i) {
      const double at = span.begin + (span.end - span.begin) * (i + 0.5) / parts;
      exact += table(at) / parts;
    }
    CHECK(share == Approx(exact).epsilon(1e-4).margin(1e-6));
    time += ahead, behind = ahead;
  }
  CHECK(table.over({-1, 0.5, 0.5}) == table(-1));  // linear over the span: the value to the bit
  CHECK(table.over({5, 1, 1}) == table(5));
  CHECK(table.over({5, 0, 1}) == Approx(table(5.25)).epsilon(1e-15));  // the half step at the start
  CHECK(table.over({5, 1, 0}) == Approx(table(4.75)).epsilon(1e-15));  // and the one before a stage
  CHECK(of_time(table, 2).over({0, 1, 1}, {}) == Approx(2 * (4.5 * 0.5 + (5 - 0.5) * 0.5)).epsilon(1e-12));
}

TEST_CASE("a function that is held keeps from a time on what it is then", "[scene]") {
  const Function function = of_time(sample_table(), 2) + of_time({{1}, {4}});
  CHECK(function.last_change() == 3);
  CHECK(Function{}.last_change() == -std::numeric_limits<double>::infinity());
  for (const double from : {-3.0, 0.0, 1.5, 7.0}) {
    const Function held = function.held_from(from);
    for (const double time : {-2.5, -1.0, 0.0, 1.0, 1.5, 2.0, 9.0})
      CHECK(held(time, {}) == function(std::min(time, from), {}));
    CHECK(held.last_change() ==
          (from == -3 ? -std::numeric_limits<double>::infinity() : std::min(from, 3.0)));
  }
  CHECK(Table({0, 1, 2, 5}, {0, 3, 3, 3}).last_change() == 1);
}
