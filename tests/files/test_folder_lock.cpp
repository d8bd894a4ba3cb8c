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

TEST_CASE("those who ask whether a folder is being written are in nobody's way", "[files]") {
  const Scratch scratch;
  CHECK_NOTHROW(FolderLock::refuse_busy(scratch / "nowhere"));
  FolderLock::refuse_busy(scratch.folder());
  const FolderLock lock(scratch.folder());  // nothing was left of that
  CHECK_THROWS_WITH(FolderLock::refuse_busy(scratch.folder()), Catch::Contains("another talus"));
}
