#include "files/folder_lock.hpp"

#include "files/input_error.hpp"
#include "output/output_folder.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

using namespace talus;

TEST_CASE("a folder has one writer at a time, and another may follow", "[files]") {
  const Scratch scratch;
  scratch.write("history.csv", "t [s]\n");
  {
    const FolderLock first(scratch.folder());
    CHECK_THROWS_WITH(FolderLock(scratch.folder()), Catch::Contains("another talus"));
    CHECK_THROWS_AS(prepare_output_folder(scratch.folder(), true), InputError);
    CHECK(std::filesystem::exists(scratch / "history.csv"));
  }
  CHECK_NOTHROW(FolderLock(scratch.folder()));
  prepare_output_folder(scratch.folder(), true);
  CHECK_FALSE(std::filesystem::exists(scratch / "history.csv"));
}
