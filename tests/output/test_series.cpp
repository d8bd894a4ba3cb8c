#include "files/input_error.hpp"
#include "output/series.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("a CSV file is read by columns", "[output][series]") {
  const Series series =
      read_series_text("# analytic\nt [s],a.ux [m],b.speed [m/s]\r\n0,1,2\n\n0.5,,+3e1\n", "f.csv");
  CHECK(series.time == std::vector<double>{0, 0.5});
  CHECK(series.column("b.speed [m/s]") == 1u);
  CHECK_FALSE(series.column("c.ux [m]"));
  CHECK(series.values[1] == std::vector<double>{2, 30});
  CHECK(std::isnan(series.values[0][1]));
}

TEST_CASE("a name with a comma or a quotation mark survives", "[output][series]") {
  const std::vector<std::string> fields{"t [s]", "a,\"b\".ux [m]"};
  CHECK(csv_line(fields) == "t [s],\"a,\"\"b\"\".ux [m]\"");
  CHECK(read_series_text(csv_line(fields) + "\n", "f.csv").names[0] == fields[1]);
}

TEST_CASE("a bad CSV file is refused with its line", "[output][series]") {
  CHECK_THROWS_WITH(read_series_text("", "f.csv"), Contains("no header line"));
  CHECK_THROWS_WITH(read_series_text("time,a\n", "f.csv"), Contains("f.csv:1") && Contains("'t [s]'"));
  CHECK_THROWS_WITH(read_series_text("t [s],a,a\n", "f.csv"), Contains("twice"));
  CHECK_THROWS_WITH(read_series_text("t [s],a\n0,1\n1,x\n", "f.csv"), Contains("f.csv:3") && Contains("'x'"));
  CHECK_THROWS_WITH(read_series_text("t [s],a\n0,1,2\n", "f.csv"), Contains("3 fields"));
  CHECK_THROWS_WITH(read_series_text("t [s],a\n0,+-1\n", "f.csv"), Contains("'+-1' is no number"));
  CHECK_THROWS_WITH(read_series_text("t [s],a\ninf,1\n", "f.csv"), Contains("'inf' is no time"));
  CHECK_THROWS_WITH(read_series_text("t [s],a\n1,1\n1,2\n", "f.csv"), Contains("increase"));
  CHECK_THROWS_AS(read_series_text("t [s],\"a\n", "f.csv"), InputError);
}

TEST_CASE("interpolation is linear and stays within the rows", "[output][series]") {
  const std::vector<double> times{0, 1, 3}, values{0, 2, -2};
  CHECK(interpolate(times, values, 0) == 0.0);
  CHECK(interpolate(times, values, 0.25) == 0.5);
  CHECK(interpolate(times, values, 1) == 2.0);
  CHECK(interpolate(times, values, 2) == 0.0);
  CHECK(interpolate(times, values, 3) == -2.0);
  CHECK_FALSE(interpolate(times, values, 3.1));
  CHECK_FALSE(interpolate(times, values, -1e-4));
  // A time of six digits may lie a little beyond the row that it means.
  CHECK(interpolate(times, values, -1e-12) == 0.0);
  CHECK(interpolate(times, values, 3.00001) == -2.0);
  CHECK_FALSE(interpolate({}, {}, 0));
}

TEST_CASE("a row is found by its time, as far as rounding goes", "[output][series]") {
  const std::vector<double> times{0, 0.1, 0.1 + 0.2, 0.7};
  CHECK(row_at(times, 0) == 0u);
  CHECK(row_at(times, 0.3) == 2u);
  CHECK(row_at(times, 0.7) == 3u);
  CHECK_FALSE(row_at(times, 0.2));
  CHECK_FALSE(row_at(times, 0.8));
  CHECK_FALSE(row_at({}, 0));
}

TEST_CASE("a curve to hold runs against has a number in every row", "[output][series]") {
  const std::vector<std::string> a{"a [m]"};
  CHECK_NOTHROW(read_reference_text("t [s],a [m],b [m]\n0,1,\n", "other.csv", a));
  CHECK(read_reference_text("\xEF\xBB\xBFt [s],a [m]\n0,1\n1,2\n", "excel.csv", a).time.size() == 2);
  CHECK_THROWS_WITH(read_reference_text("t [s],a [m]\n0,1\n1,\n", "gap.csv", a),
                    Catch::Contains("gap.csv: 'a [m]' has no finite number at t = 1 s"));
  CHECK_THROWS_WITH(read_reference_text("t [s],a [m]\n0,nan\n", "nan.csv", a), Catch::Contains("at t = 0 s"));
  CHECK_THROWS_WITH(read_reference_text("t [s],a [m]\n", "head.csv", a), Catch::Contains("no rows"));
}
