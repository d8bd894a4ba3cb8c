#include "files/hash.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("hashes are those of xxh128sum", "[files][hash]") {
  CHECK(hash_of_bytes("") == "99aa06d3014798d86001c324468d497f");
  const Scratch scratch;
  CHECK(hash_of_file(scratch.write("empty", "")) == hash_of_bytes(""));
  CHECK(hash_of_file(scratch.write("one", "a")) == hash_of_bytes("a"));
  CHECK(hash_of_bytes("a") != hash_of_bytes("b"));
}

TEST_CASE("a whole file replaces the one before and leaves nothing beside it", "[files]") {
  const Scratch scratch;
  write_whole_file(scratch / "run.json", "first, and long");
  write_whole_file(scratch / "run.json", "second");
  CHECK(read_whole_file(scratch / "run.json") == "second");
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}) == 1);
  CHECK_THROWS_WITH(write_whole_file(scratch / "nowhere/run.json", ""), Contains("nowhere"));
  CHECK_THROWS_WITH(read_whole_file(scratch / "absent.json"), Contains("absent.json"));
  CHECK_THROWS_AS(read_whole_file(scratch.folder()), std::system_error);
}

TEST_CASE("links are followed, and what is no file is written into", "[files]") {
  const Scratch scratch;
  scratch.write("kept.svg", "old");
  std::filesystem::create_symlink("kept.svg", scratch / "link.svg");
  std::filesystem::create_symlink("link.svg", scratch / "link to link.svg");
  write_whole_file(scratch / "link to link.svg", "new");
  CHECK(std::filesystem::is_symlink(scratch / "link to link.svg"));
  CHECK(std::filesystem::is_symlink(scratch / "link.svg"));
  CHECK(read_whole_file(scratch / "kept.svg") == "new");
  std::filesystem::create_symlink("absent.svg", scratch / "ahead.svg");
  write_whole_file(scratch / "ahead.svg", "there");
  CHECK(read_whole_file(scratch / "absent.svg") == "there");

  const std::string pipe = (scratch / "pipe").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  REQUIRE(end >= 0);
  write_whole_file(pipe, "through");
  char got[16] = {};
  CHECK(::read(end, got, sizeof got) == 7);
  ::close(end);
  CHECK(std::string(got) == "through");
  CHECK(std::filesystem::is_fifo(pipe));

  std::filesystem::create_symlink("loop", scratch / "loop");
  CHECK_THROWS_WITH(write_whole_file(scratch / "loop", ""), Contains("cannot write") && Contains("loop"));
  CHECK_THROWS_WITH(write_whole_file(scratch.folder(), ""), Contains("directory"));
  CHECK_FALSE(std::filesystem::exists(scratch.folder().string() + ".part"));
}
