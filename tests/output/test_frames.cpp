#include "decode.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "geometry/triangulate.hpp"
#include "output/frame.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

PartPoint at(double x, double y) {
  return {{x, y}, {x / 8, y / 8}, {2 * x, -y}};
}

Frame example_frame(double time) {
  Frame frame;
  frame.time = time;
  frame.origin = {500000, 0};
  frame.bodies.push_back({{{{{at(0, 0), at(1, 0), at(1, 1), at(0, 1)}}, {1, 2, 3}}}, 2, 3.5});
  frame.bodies.push_back(
      {{{{{at(2, 0), at(4, 0), at(4, 2), at(2, 2)}, {at(2.5, 0.5), at(2.5, 1.5), at(3.5, 1.5), at(3.5, 0.5)}},
         {4, 5, 6}}},
       1,
       0.5});
  frame.contacts.push_back({0, 1, {1, 0.5}, {7, 8}, {-9, 10}, 1e-3, true, -11});
  return frame;
}

double area(const std::vector<std::vector<Vec2>>& loops, bool each_positive) {
  std::vector<Vec2> points;
  for (const auto& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
  double sum = 0;
  for (const auto& [a, b, c] : triangulate(loops)) {
    const Vec2 p = points[a], q = points[b], r = points[c];
    const double twice = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if (each_positive) CHECK(twice > 0);
    sum += twice / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("an inline array decodes to its bytes at every block boundary", "[output][vtu]") {
  for (const std::size_t size : {0u, 1u, 2u, 3u, 32767u, 32768u, 32769u, 65536u, 100000u}) {
    std::vector<unsigned char> bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<unsigned char>(i * i % 251);
    CHECK(decode::inline_bytes(encode_inline(bytes.data(), size)) == bytes);
  }
}

TEST_CASE("a frame's file decodes to the corners, fields and cells of its bodies", "[output][vtu]") {
  const Scratch scratch;
  FrameWriter writer(scratch.folder(), {});
  writer.add(example_frame(0));
  const std::string file = read_whole_file(scratch / "frames/frame_000000.vtu");
  CHECK_THAT(file, Contains("compressor=\"vtkZLibDataCompressor\"") && Contains("header_type=\"UInt64\"") &&
                       !Contains("appended"));
  CHECK_THAT(file, Contains("NumberOfPoints=\"12\" NumberOfCells=\"9\""));
  const auto points = decode::array<double>(file, "Points");
  REQUIRE(points.size() == 36);
  CHECK(std::vector<double>(points.begin() + 3, points.begin() + 9) ==
        std::vector<double>{500001, 0, 0, 500001, 1, 0});
  CHECK(decode::array<double>(file, "displacement")[4 * 3] == 0.25);
  CHECK(decode::array<double>(file, "velocity")[2 * 3 + 1] == -1);
  const auto types = decode::array<unsigned char>(file, "types");
  CHECK(types == std::vector<unsigned char>{7, 5, 5, 5, 5, 5, 5, 5, 5});
  CHECK(decode::array<std::int64_t>(file, "offsets") ==
        std::vector<std::int64_t>{4, 7, 10, 13, 16, 19, 22, 25, 28});
  const auto connectivity = decode::array<std::int64_t>(file, "connectivity");
  CHECK(std::vector<std::int64_t>(connectivity.begin(), connectivity.begin() + 4) ==
        std::vector<std::int64_t>{0, 1, 2, 3});
  for (std::size_t i = 4; i < connectivity.size(); ++i) CHECK((connectivity[i] >= 4 && connectivity[i] < 12));
  CHECK(decode::array<double>(file, "stress_xy") == std::vector<double>{3, 6, 6, 6, 6, 6, 6, 6, 6});
  CHECK(decode::array<double>(file, "speed")[0] == 3.5);
  CHECK(decode::array<std::int32_t>(file, "material")[0] == 2);
  CHECK(decode::array<std::int32_t>(file, "body")[8] == 1);
}

TEST_CASE("points that are one and the same are written once", "[output][vtu]") {
  const Scratch scratch;
  Frame frame = example_frame(0);
  FrameBody two_parts{{}, 1, 0.5};
  two_parts.parts.push_back({{{at(5, 0), at(6, 0), at(5, 1)}}, {1, 2, 3}});
  two_parts.parts.push_back({{{at(6, 0), at(6, 1), at(5, 1)}}, {4, 5, 6}});
  frame.bodies.insert(frame.bodies.begin(), two_parts);
  FrameWriter(scratch.folder(), {{0, 1, 2, 1, 3, 2}, {}, {0, 1, 2, 3, 4, 5, 6, 7}}).add(frame);
  const Grid grid = read_vtu_text(read_whole_file(scratch / "frames/frame_000000.vtu"));
  REQUIRE(grid.points.size() == 3 * (4 + 4 + 8));
  const std::vector<std::int64_t> expected{0, 1, 2, 1, 3, 2, 4, 5, 6, 7};
  CHECK(std::vector<std::int64_t>(grid.connectivity.begin(), grid.connectivity.begin() + 10) == expected);
  CHECK(grid.points[3 * 3] == 500006);
  CHECK(grid.points[3 * 3 + 1] == 1);
  CHECK(grid.points[3 * 4] == 500000);
  const Scratch other;
  FrameWriter(other.folder(), {}).add(frame);
  const Grid each = read_vtu_text(read_whole_file(other / "frames/frame_000000.vtu"));
  REQUIRE(each.connectivity.size() == grid.connectivity.size());
  for (std::size_t i = 0; i < grid.connectivity.size(); ++i) {
    const auto p = static_cast<std::size_t>(grid.connectivity[i]),
               q = static_cast<std::size_t>(each.connectivity[i]);
    CHECK(grid.points[3 * p] == each.points[3 * q]);
    CHECK(grid.points[3 * p + 1] == each.points[3 * q + 1]);
  }
}

TEST_CASE("a writer that goes on from a checkpoint fills holes as it did", "[output][vtu][checkpoint]") {
  const Scratch scratch, other;
  FrameWriter whole(scratch.folder(), {}), again(other.folder(), {});
  whole.add(example_frame(0));
  Archive out(0);
  whole.exchange(out);
  const std::string bytes = out.take_bytes();
  Archive bare(bytes);
  CHECK_THROWS_WITH(again.exchange(bare), Contains("frame_000000.vtu' is not what the run left: it is gone"));
  for (const char* file : {"frames/frame_000000.vtu", "frames/contacts_000000.vtu"})
    std::filesystem::copy_file(scratch / file, other / file);
  Archive in(bytes);
  again.exchange(in);
  CHECK(in.at_end());
  whole.flush_to_disk();
  // Its hole has come so near to a corner that other triangles would be found by now.
  Frame later = example_frame(0.1);
  for (PartPoint& point : later.bodies[1].parts[0].loops[1]) point.position.x -= 0.45;
  whole.add(later);
  again.add(later);
  const std::string file = read_whole_file(scratch / "frames/frame_000001.vtu");
  CHECK(file == read_whole_file(other / "frames/frame_000001.vtu"));
  CHECK(read_vtu_text(file).connectivity ==
        read_vtu_text(read_whole_file(scratch / "frames/frame_000000.vtu")).connectivity);
}

TEST_CASE("a frame's file decodes to the places, forces and depths of its contacts", "[output][vtu]") {
  const std::string file = vtu_text(contact_grid(example_frame(0.5)), 0.5);
  CHECK(decode::array<double>(file, "Points") == std::vector<double>{500001, 0.5, 0});
  CHECK(decode::array<double>(file, "normal_force") == std::vector<double>{7, 8, 0});
  CHECK(decode::array<double>(file, "tangential_force") == std::vector<double>{-9, 10, 0});
  CHECK(decode::array<double>(file, "moment") == std::vector<double>{-11});
  CHECK(decode::array<double>(file, "penetration") == std::vector<double>{1e-3});
  CHECK(decode::array<std::int32_t>(file, "slipping") == std::vector<std::int32_t>{1});
  CHECK(decode::array<unsigned char>(file, "types") == std::vector<unsigned char>{1});
  CHECK_THAT(file, Contains("ascii\">0.5<"));
}

TEST_CASE("a frame without contacts is a file all the same", "[output][vtu]") {
  Frame frame = example_frame(0);
  frame.contacts.clear();
  const std::string file = vtu_text(contact_grid(frame), 0);
  CHECK_THAT(file, Contains("NumberOfPoints=\"0\" NumberOfCells=\"0\""));
  CHECK(decode::array<double>(file, "normal_force").empty());
}

TEST_CASE("the collection lists every time from the first frame on", "[output][pvd]") {
  const Scratch scratch;
  FrameWriter writer(scratch.folder(), {});
  for (const double time : {0.0, 0.1, 0.30000000000000004}) {
    writer.add(example_frame(time));
    const std::string collection = read_whole_file(scratch / "frames.pvd");
    CHECK_THAT(collection, Contains("timestep=\"0\" part=\"0\" file=\"frames/frame_000000.vtu\""));
    CHECK_THAT(collection, Contains("</VTKFile>"));
  }
  const std::string collection = read_whole_file(scratch / "frames.pvd");
  CHECK_THAT(collection, Contains("timestep=\"0.1\" part=\"1\" file=\"frames/contacts_000001.vtu\""));
  CHECK_THAT(collection,
             Contains("timestep=\"0.30000000000000004\" part=\"0\" file=\"frames/frame_000002.vtu\""));
  CHECK_FALSE(std::filesystem::exists(scratch / "frames.pvd.part"));
}

TEST_CASE("a frame knows whether its positions are numbers", "[output][vtu]") {
  Frame frame = example_frame(0);
  CHECK(frame.finite());
  frame.bodies[1].parts[0].loops[1][2].position.y = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(frame.finite());
}

TEST_CASE("triangles fill a polygon with holes", "[output][triangulate]") {
  const std::vector<Vec2> square{{0, 0}, {6, 0}, {6, 6}, {0, 6}};
  const std::vector<Vec2> left{{1, 1}, {1, 3}, {2, 3}, {2, 1}}, right{{4, 1}, {4, 3}, {5, 3}, {5, 1}},
      top{{1, 4}, {3, 5}, {5, 4}};
  CHECK(area({square}, true) == Approx(36));
  CHECK(area({square, left}, true) == Approx(34));
  CHECK(area({square, left, right}, true) == Approx(32));
  CHECK(area({square, top, left, right}, true) == Approx(30));
  const std::vector<Vec2> hook{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
  CHECK(area({hook}, true) == Approx(10));
  const std::vector<Vec2> subdivided{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  CHECK(area({subdivided}, false) == Approx(4));
}

TEST_CASE("a frame that is damaged is refused by what is wrong with it", "[output][vtu]") {
  const Scratch scratch;
  FrameWriter(scratch.folder(), {}).add(example_frame(0));
  const std::string whole = read_whole_file(scratch / "frames/frame_000000.vtu");
  const Grid good = read_vtu_text(whole);
  const auto refusal = [](const std::string& text) {
    try {
      read_vtu_text(text);
    } catch (const InputError& problem) {
      return std::string(problem.what());
    }
    return std::string();
  };
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK(refusal("") == "not a frame that talus wrote: a part is missing");
  CHECK_THAT(refusal(changed("<Points>", "<Dots>")), Contains("a part is missing"));
  CHECK_THAT(refusal(changed("</Cells>", "")), Contains("a part has no end"));

  // The letters of the first array; the header of blocks stands in the first 32.
  const std::size_t letters = whole.find('>', whole.find("<DataArray ", whole.find("<Points>"))) + 1;
  const auto with = [&](std::size_t at, std::size_t length, const std::string& to) {
    std::string text = whole;
    return text.replace(letters + at, length, to);
  };
  CHECK_THAT(refusal(with(3, 1, "*")), Contains("a letter is out of place"));
  CHECK_THAT(refusal(with(40, 1, "")), Contains("its text comes in fours"));
  CHECK_THAT(refusal(with(0, 8, "/////w==")), Contains("more blocks than bytes"));
  CHECK_THAT(refusal(with(0, whole.find('<', letters) - letters, "AQAA")), Contains("an array ends early"));

  Grid grid = good;
  grid.offsets[1] = grid.offsets[0] - 1;
  CHECK_THAT(refusal(vtu_text(grid, 0)), Contains("a cell has no corners"));
  grid = good;
  grid.offsets.back() = 1000;
  CHECK_THAT(refusal(vtu_text(grid, 0)), Contains("a cell has no corners"));
  for (const std::int64_t nowhere : {std::int64_t{-1}, std::int64_t{12}}) {
    grid = good;
    grid.connectivity[0] = nowhere;  // of 12 points
    CHECK_THAT(refusal(vtu_text(grid, 0)), Contains("a corner is no point"));
  }
}
