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
  RunningHash running;
  std::string all;
  for (int i = 0; i < 1000; ++i) {
    CHECK(running.text() == hash_of_bytes(all));
    running.add("a part");
    all += "a part";
  }
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

TEST_CASE("a whole file takes no other file for its own, and keeps who may read it", "[files]") {
  const Scratch scratch;
  const std::filesystem::path file = scratch / "figure.svg", beside = scratch / "figure.svg.part";
  scratch.write("figure.svg.part", "of somebody");
  write_whole_file(file, "first");
  CHECK(read_whole_file(beside) == "of somebody");
  std::filesystem::remove(beside);
  std::filesystem::create_symlink(scratch.write("other", "elsewhere"), beside);
  std::filesystem::create_directory(scratch / "figure.svg.part2");
  std::filesystem::permissions(file,
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  write_whole_file(file, "second");
  CHECK(read_whole_file(file) == "second");
  CHECK_FALSE(std::filesystem::is_symlink(file));
  CHECK(read_whole_file(scratch / "other") == "elsewhere");
  CHECK(std::filesystem::is_directory(scratch / "figure.svg.part2"));
  CHECK(std::filesystem::status(file).permissions() ==
        (std::filesystem::perms::owner_read | std::filesystem::perms::owner_write));
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

  int ends[2];
  REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
  write_whole_file("/dev/fd/" + std::to_string(ends[1]), "to whom it is open");
  char held[32] = {};
  CHECK(::read(ends[0], held, sizeof held) == 18);
  CHECK(std::string(held) == "to whom it is open");
  ::close(ends[0]);
  ::close(ends[1]);

  std::filesystem::create_symlink("loop", scratch / "loop");
  CHECK_THROWS_WITH(write_whole_file(scratch / "loop", ""), Contains("cannot write") && Contains("loop"));
  CHECK_THROWS_WITH(write_whole_file(scratch.folder(), ""), Contains("directory"));
  CHECK_FALSE(std::filesystem::exists(scratch.folder().string() + ".part"));
}

TEST_CASE("what is held open keeps what it has and its place", "[files]") {
  const Scratch scratch;
  const std::filesystem::path log = scratch.write("log", "kept, ");
  const auto is_written = [&](int flags, const std::string& due) {
    const int descriptor = ::open(log.c_str(), flags | O_CLOEXEC);
    REQUIRE(descriptor >= 0);
    for (const char* folder : {"/dev/fd/", "/proc/self/fd/"}) {
      std::filesystem::remove(scratch / "link");
      std::filesystem::create_symlink(std::string(folder) + std::to_string(descriptor), scratch / "link");
      write_whole_file(scratch / "link", "new");
    }
    CHECK(::write(descriptor, ".", 1) == 1);
    ::close(descriptor);
    CHECK(read_whole_file(log) == due);
  };
  is_written(O_WRONLY | O_APPEND, "kept, newnew.");
  is_written(O_WRONLY, "newnew.ewnew.");
  const int descriptor = ::open(log.c_str(), O_RDONLY | O_CLOEXEC);
  CHECK_THROWS_WITH(write_whole_file("/dev/fd/" + std::to_string(descriptor), "new"),
                    Contains("cannot write '/dev/fd/"));
  ::close(descriptor);
}

TEST_CASE("What killed writers left beside a file is found, and nothing else", "[files]") {
  const Scratch scratch;
  for (const char* name :
       {"a", "a.part", "a.part2", "a.part13", "a.partly", "a.part2.vtu", "aa.part", "b.part"})
    scratch.write(name, "");
  const std::vector<std::filesystem::path> due{scratch / "a.part", scratch / "a.part13", scratch / "a.part2"};
  CHECK(temporaries_of(scratch / "a") == due);
  CHECK(temporaries_of(scratch / "nowhere/a").empty());
}
