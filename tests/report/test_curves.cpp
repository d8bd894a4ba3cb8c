#include "report/curves.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using namespace talus;

TEST_CASE("Curves far from zero keep their shape, and thinned ones their largest value", "[report]") {
  Series series;
  series.names = {"far", "pulse", "still"};
  series.values.resize(3);
  for (int i = 0; i <= 3000; ++i) {
    series.time.push_back(0.001 * i);
    series.values[0].push_back(4e6 + 1e-3 * std::sin(0.01 * i));
    series.values[1].push_back(i == 1501 ? -7.5 : 0);
    series.values[2].push_back(500000.25);
  }
  const auto json = curves_of(series);
  CHECK(json["thinned"] == true);
  for (std::size_t column = 0; column < 3; ++column) {
    const auto& times = json["times"][column];
    CHECK(times.size() <= 1502);
    CHECK(times.front() == 0);
    CHECK(times.back() == 3);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto row = static_cast<std::size_t>(std::lround(times[i].get<double>() / 0.001));
      CHECK(json["values"][column][i].get<double>() ==
            Approx(series.values[column][row]).epsilon(0).margin(1e-8));
    }
  }
  CHECK(json["largest"][1] == 7.5);
  CHECK(std::find(json["values"][1].begin(), json["values"][1].end(), -7.5) != json["values"][1].end());
}

TEST_CASE("Of a difference only what both have is told", "[report]") {
  const Series base{{0, 1, 2}, {"a", "b"}, {{1e6, 1e6, 1e6}, {0, 2, 4}}};
  const Series run{
      {0, 0.5, 1.5, 3}, {"b", "c", "a"}, {{0, 1, 3.5, 9}, {1, 1, 1, 1}, {1e6, 1e6 + 1e-9, 1e6, 0}}};
  const Series found = difference(run, base, Between::line);
  CHECK(found.time == std::vector<double>{0, 0.5, 1.5});
  CHECK(found.names == std::vector<std::string>{"b", "a"});
  CHECK(found.values[0] == std::vector<double>{0, 0, 0.5});
  CHECK(curves_of(found)["values"][1][1].get<double>() == Approx(1e-9).epsilon(0.2));
}

TEST_CASE("Two runs that write at other times part by what their common rows tell", "[report]") {
  Series coarse{{0, 1, 2}, {"a"}, {{0, 1, 4}}}, fine{{}, {"a"}, {{}}};
  for (int i = 0; i <= 20; ++i) {
    fine.time.push_back(0.1 * i);
    fine.values[0].push_back(0.01 * i * i);
  }
  const Series found = difference(fine, coarse, Between::unknown);
  CHECK(found.time == coarse.time);
  for (const double value : found.values[0]) CHECK(std::abs(value) < 1e-12);
}
