#include "output/output_folder.hpp"

#include "files/folder_lock.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("results are not overwritten unasked, other files never", "[output][files]") {
  const Scratch scratch;
  const auto folder = scratch / "out/deep";
  prepare_output_folder(folder, false);
  CHECK(std::filesystem::is_directory(folder));
  scratch.write("out/deep/notes.txt", "mine");
  CHECK_NOTHROW(prepare_output_folder(folder, false));
  scratch.write("out/deep/history.csv", "t [s]");
  std::filesystem::create_directory(folder / "frames");
  scratch.write("out/deep/frames/frame_000007.vtu", "");
  scratch.write("out/deep/frames/photo.vtu", "");
  CHECK_THROWS_WITH(prepare_output_folder(folder, false), Contains("--overwrite") && Contains("history.csv"));
  CHECK(std::filesystem::exists(folder / "history.csv"));
  prepare_output_folder(folder, true);
  CHECK_FALSE(std::filesystem::exists(folder / "history.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "frames/frame_000007.vtu"));
  CHECK(std::filesystem::exists(folder / "frames/photo.vtu"));
  CHECK(read_whole_file(folder / "notes.txt") == "mine");
  CHECK_THROWS_AS(prepare_output_folder(folder / "notes.txt", true), InputError);
  scratch.write("out/deep/resolved.json", "{}");
  CHECK_THROWS_WITH(prepare_output_folder(folder, true, {folder / "notes.txt", folder / "resolved.json"}),
                    Contains("resolved.json' is read to make the results"));
  CHECK_THROWS_WITH(prepare_folder_of_runs(folder), Contains("a single run ('resolved.json')"));
  CHECK(std::filesystem::exists(folder / "resolved.json"));
  CHECK_NOTHROW(prepare_output_folder(folder, true, {folder / "notes.txt"}));
  CHECK_NOTHROW(prepare_folder_of_runs(folder));
}

TEST_CASE("a folder of a study takes no other results unasked", "[output][files]") {
  const Scratch scratch;
  scratch.write("study.csv", "");
  CHECK_THROWS_WITH(prepare_output_folder(scratch.folder(), false),
                    Contains("holds a study ('study.csv')") && Contains("--out"));
  CHECK_NOTHROW(prepare_folder_of_runs(scratch.folder()));
  std::filesystem::create_directories(scratch / "run_0002");
  scratch.write("run_0002/history.csv", "");
  prepare_output_folder(scratch.folder(), true);
  CHECK_FALSE(std::filesystem::exists(scratch / "study.csv"));
  CHECK(std::filesystem::exists(scratch / "run_0002/history.csv"));
  // One that was broken off has no tables.
  CHECK_THROWS_WITH(prepare_output_folder(scratch.folder(), false), Contains("holds a study ('run_0002')"));
}

TEST_CASE("of a study that is replaced tables and runs go, and nothing else", "[output][files][study]") {
  const Scratch scratch;
  for (const char* folder :
       {"run_0001/frames", "run_0001_2", "run_0002", "run_0003", "run_0004", "run_away", "run_12"})
    std::filesystem::create_directories(scratch / folder);
  for (const char* file :
       {"study.csv", "study.html", "notes.txt", "run_0001/run.json", "run_0001/frames.pvd",
        "run_0001/frames/frame_000000.vtu", "run_0001_2/run.json", "run_0002/run.json", "run_0003/run.json",
        "run_0003/notes.txt", "run_0004/notes.txt", "run_away/run.json", "run_12/run.json"})
    scratch.write(file, "");
  const auto stays = [](const std::filesystem::path& run) { return run.filename() == "run_0002"; };
  CHECK_THROWS_WITH(remove_study(scratch.folder(), stays, {scratch / "run_0003/run.json"}),
                    Contains("run_0003/run.json' is read to make the results"));
  CHECK(std::filesystem::exists(scratch / "study.csv"));
  CHECK(std::filesystem::exists(scratch / "run_0001/run.json"));
  remove_study(scratch.folder(), stays, {});
  for (const char* gone : {"study.csv", "study.html", "run_0001", "run_0001_2", "run_0003/run.json"})
    CHECK_FALSE(std::filesystem::exists(scratch / gone));
  for (const char* kept : {"notes.txt", "run_0002/run.json", "run_0003/notes.txt", "run_0004/notes.txt",
                           "run_away/run.json", "run_12/run.json"})
    CHECK(std::filesystem::exists(scratch / kept));
}

TEST_CASE("nothing of a study goes while one of its runs is being written", "[output][files][study]") {
  const Scratch scratch;
  for (const char* file : {"study.csv", "run_0001/run.json", "run_0002/run.json"}) {
    std::filesystem::create_directories((scratch / file).parent_path());
    scratch.write(file, "");
  }
  const FolderLock lock(scratch / "run_0002");
  CHECK_THROWS_WITH(remove_study(scratch.folder(), [](const auto&) { return false; }, {}),
                    Contains("another talus"));
  CHECK(std::filesystem::exists(scratch / "study.csv"));
  CHECK(std::filesystem::exists(scratch / "run_0001/run.json"));
}
