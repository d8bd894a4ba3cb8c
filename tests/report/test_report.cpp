#include "report/report.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/frame.hpp"
#include "output/recorded_run.hpp"
#include "output/scratch.hpp"
#include "report/film.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// What the page does with the sixteen-bit columns of a film, one after the other.
std::vector<std::vector<int>> columns_of(const Film& film) {
  std::size_t count = 0;
  for (std::size_t part = 0; part < film.rigid.size(); ++part)
    count += film.rigid[part] != 0 ? 3 : 2 * (film.part_start[part + 1] - film.part_start[part]);
  const std::size_t frames = film.time.size(), bytes = count * frames;
  std::vector<std::vector<int>> columns;
  for (std::size_t column = 0; column < count; ++column) {
    std::vector<int>& values = columns.emplace_back();
    std::uint16_t value = 0, step = 0;
    for (std::size_t f = 0; f < frames; ++f) {
      const auto at = [&](std::size_t plane) {
        return static_cast<unsigned char>(film.motion[plane * bytes + column * frames + f]);
      };
      step = static_cast<std::uint16_t>(step + (at(0) | at(1) << 8));
      value = static_cast<std::uint16_t>(value + step);
      values.push_back(static_cast<std::int16_t>(value));
    }
  }
  return columns;
}

RunResult record(const WorkingScene& text, const Scratch& scratch) {
  RunOrder order;
  order.folder = scratch.folder();
  Scene scene = text.read();
  scene.monitors.push_back({"m", 0, std::nullopt, {"ux"}});
  Simulation simulation(std::move(scene), {});
  return record_run(simulation, order);
}

/// Flies and turns without any force.
WorkingScene spinning(const std::string& cover) {
  WorkingScene text;
  text.cover = cover;
  text.bodies = box("a", 1, 2, 3, 4, R"("velocity": [3, -1], "angular_velocity": 90)") + "," +
                box("b", 100, 100, 101, 101, R"("fixed": true)");
  text.time = R"({"end": 2, "dt": 0.001})";
  text.output = R"({"history": 0.1, "frames": 0.5})";
  return text;
}

nlohmann::json data_of(const std::string& page) {
  const std::string begin = R"(<script type="application/json" id="data">)";
  const std::size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

}  // namespace

TEST_CASE("A film has the frames of a run in steps that cannot be seen", "[report]") {
  const Scratch scratch;
  record(spinning("rigid"), scratch);
  const Film film = read_film(scratch.folder());
  REQUIRE(film.time == std::vector<double>{0, 0.5, 1, 1.5, 2});
  CHECK(film.frames == 5);
  CHECK(film.every == 1);
  CHECK(film.part_body == std::vector<std::uint32_t>{0, 1});
  CHECK(film.part_start == std::vector<std::uint32_t>{0, 4, 8});
  CHECK(film.origin_x == 1);
  CHECK(film.x[2] == Approx(2));
  CHECK(film.rigid == std::vector<std::uint8_t>{1, 1});
  CHECK(film.largest_speed == Approx(std::hypot(3, 1)));
  const auto columns = columns_of(film);
  REQUIRE(columns.size() == 6);
  for (std::size_t f = 0; f < 5; ++f) {
    const double time = film.time[f];
    CHECK(columns[0][f] * film.quantum == Approx(3 * time).margin(film.quantum));
    CHECK(columns[1][f] * film.quantum == Approx(-time).margin(film.quantum));
    const double turned = (columns[2][f] / 32768.0 - time / 2) * std::numbers::pi;
    CHECK(std::remainder(turned, 2 * std::numbers::pi) == Approx(0).margin(1e-4));
    CHECK(columns[3][f] == 0);
  }
}

TEST_CASE("A part that strains so that it can be seen has its corners in the film", "[report]") {
  WorkingScene text = spinning("block");
  text.material = R"("density": 2300, "model": "linear_elastic", "young_modulus": 1e4, "poisson_ratio": 0)";
  text.bodies = box("a", 0, 0, 2, 2, R"("surfaces": {"right": [1], "left": [3]})");
  text.rest += R"("surface_loads": [{"body": "a", "surface": "right", "traction": [3e3, 0]},
                                    {"body": "a", "surface": "left", "traction": [-3e3, 0]}],)";
  const Scratch scratch;
  record(text, scratch);
  const Film film = read_film(scratch.folder());
  REQUIRE(film.rigid == std::vector<std::uint8_t>{0});
  const auto columns = columns_of(film);
  REQUIRE(columns.size() == 8);
  CHECK(film.largest_shear > 0);
  const Grid last = read_vtu_text(read_whole_file(scratch / "frames/frame_000004.vtu"));
  for (std::size_t corner = 0; corner < 4; ++corner)
    CHECK(columns[2 * corner].back() * film.quantum ==
          Approx(last.points[3 * corner] - film.origin_x - film.x[corner]).margin(film.quantum));
}

TEST_CASE("A report is one page with all that it shows", "[report]") {
  const Scratch scratch;
  WorkingScene text = spinning("rigid");
  text.rest += R"("title": "<b>&\"</script>",)";
  const RunResult result = record(text, scratch);
  write_report(scratch.folder());
  const std::string page = read_whole_file(scratch / "report.html");
  CHECK_THAT(page, Contains("<title>&lt;b&gt;&amp;"));
  for (const char* outside :
       {"<script src", "<link rel=\"stylesheet", "@import", "url(http", "sourceMappingURL", "{{data}}"}) {
    CAPTURE(outside);
    CHECK_THAT(page, !Contains(outside));
  }
  const auto data = data_of(page);
  REQUIRE(data["runs"].size() == 1);
  const auto& run = data["runs"][0];
  CHECK(run["record"]["state_hash"] == result.state_hash);
  CHECK(run["history"]["names"][0] == "m.ux [m]");
  CHECK(run["history"]["times"][0].size() == 21);
  CHECK(run["energy"]["names"][0] == "kinetic [J/m]");
  CHECK(run["bodies"][1]["fixed"] == true);
  CHECK(run["film"]["parts"] == 2);
}

TEST_CASE("The command of a report names a scene that begins with a dash as a file", "[report]") {
  const Scratch scratch;
  record(spinning("rigid"), scratch);
  auto run = nlohmann::json::parse(read_whole_file(scratch / "run.json"));
  run["scene"]["file"] = "-x y.json";
  scratch.write("run.json", run.dump());
  CHECK_THAT(data_of(report_page(scratch.folder()))["command"].get<std::string>(),
             Catch::StartsWith("talus run './-x y.json'"));
}

TEST_CASE("A report without frames or results says so", "[report]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(write_report(scratch.folder()), Contains("no folder of results"));
  WorkingScene text = spinning("rigid");
  text.output = R"({"history": 0.1})";
  record(text, scratch);
  CHECK(data_of(report_page(scratch.folder()))["runs"][0]["film"]["time"].empty());
}

TEST_CASE("Frames that were cut or changed are refused in words, or read", "[report]") {
  const Scratch scratch;
  record(spinning("rigid"), scratch);
  const std::string whole = read_whole_file(scratch / "frames/frame_000001.vtu");
  for (std::size_t i = 0; i < whole.size(); i += 7) {
    for (const std::string& spoilt :
         {whole.substr(0, i), whole.substr(0, i) + static_cast<char>(whole[i] ^ 1) + whole.substr(i + 1)}) {
      try {
        read_vtu_text(spoilt);
      } catch (const InputError& problem) {
        CHECK_THAT(problem.what(), Contains("not a frame that talus wrote"));
      }
    }
  }
}
