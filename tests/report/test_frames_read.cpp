#include "files/input_error.hpp"
#include "output/scratch.hpp"
#include "output/vtu.hpp"
#include "report/frames.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// Two contacts, of which one slips.
Grid two_contacts() {
  Grid grid;
  grid.points = {0, 0, 0, 1, 0, 0};
  for (const std::int64_t corner : {0, 1}) grid.add_cell(CellType::vertex, {&corner, 1});
  grid.point_data = {{"normal_force", 3, std::vector<double>{3, 4, 0, 0, -1, 0}},
                     {"tangential_force", 3, std::vector<double>{0, 0, 0, 2, 0, 0}},
                     {"slipping", 1, std::vector<std::int32_t>{0, 1}}};
  return grid;
}

}  // namespace

TEST_CASE("the contacts of a frame add up to their number, those that slip, and sums of magnitudes",
          "[report]") {
  const ContactSums sums = contact_sums(two_contacts());
  CHECK(sums.count == 2);
  CHECK(sums.slipping == 1);
  CHECK(sums.normal == 6);
  CHECK(sums.tangential == 2);
}

TEST_CASE(
    "a frame without an array that each frame has, or with another kind of numbers, is refused by its name",
    "[report]") {
  Grid grid = two_contacts();
  CHECK_THROWS_WITH(reals_of(grid.point_data, "slipping"), "a frame has no 'slipping'");
  grid.point_data.pop_back();
  CHECK_THROWS_WITH(contact_sums(grid), "a frame has no 'slipping'");
}

TEST_CASE("a frame's file that is none is named", "[report]") {
  const Scratch scratch;
  const std::string file = scratch.write("frame.vtu", "t [s],a\n");
  CHECK_THROWS_WITH(read_grid(file),
                    Contains(file) && Contains("not a frame that talus wrote: a part is missing"));
}

TEST_CASE("a frame with an array of another length than it has points or cells is refused", "[report]") {
  Grid grid = two_contacts();
  CHECK_NOTHROW(read_vtu_text(vtu_text(grid, 0)));
  std::get<std::vector<double>>(grid.point_data[0].values).pop_back();
  CHECK_THROWS_WITH(read_vtu_text(vtu_text(grid, 0)), Contains("an array is not as long as"));
  grid = two_contacts();
  grid.cell_data = {{"speed", 1, std::vector<double>{}}};
  CHECK_THROWS_WITH(read_vtu_text(vtu_text(grid, 0)), Contains("an array is not as long as"));
}

TEST_CASE("frames are listed in their order, each with its file of contacts", "[report]") {
  const Scratch scratch;
  CHECK(listed_frames(scratch.folder()).empty());
  scratch.write("frames.pvd", R"(<Collection>
<DataSet timestep="0" part="0" file="frames/a.vtu"/>
<DataSet timestep="0" part="1" file="frames/b.vtu"/>
<DataSet timestep="0.25" part="0" file="frames/c.vtu"/>
</Collection>)");
  const std::vector<ListedFrame> frames = listed_frames(scratch.folder());
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].bodies == scratch.folder() / "frames/a.vtu");
  CHECK(frames[0].contacts == scratch.folder() / "frames/b.vtu");
  CHECK(frames[1].time == 0.25);
  CHECK(frames[1].contacts.empty());
}
