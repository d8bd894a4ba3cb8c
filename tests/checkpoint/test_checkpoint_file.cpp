#include "archive/archive.hpp"
#include "checkpoint/checkpoint.hpp"
#include "files/hash.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

Checkpoint some_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.reason = "the run was interrupted";
  checkpoint.scene_file = "/somewhere/scene.json";
  checkpoint.scene_text = "{\n // Größe\n}";
  checkpoint.overrides = {{"/time/end", "3"}};
  checkpoint.plugin_folders = {"/a", "/b"};
  checkpoint.libraries = {{"liblaw.so", "0123"}};
  checkpoint.simd = SimdLevel::avx2;
  checkpoint.threads = 2;
  checkpoint.model_hash = "4567";
  checkpoint.time = 0.1;
  checkpoint.steps = 12;
  checkpoint.continued = {0.05};
  checkpoint.state = std::string("\0\n state \xff", 10);
  return checkpoint;
}

}  // namespace

TEST_CASE("A checkpoint is read as it was written", "[checkpoint]") {
  const Scratch scratch;
  const auto file = scratch.folder() / "checkpoint.talus";
  const Checkpoint written = some_checkpoint();
  write_checkpoint(file, written);
  CHECK_FALSE(std::filesystem::exists(scratch.folder() / "checkpoint.talus.part"));
  const Checkpoint read = read_checkpoint(file);
  CHECK(read.reason == written.reason);
  CHECK(read.scene_file == written.scene_file);
  CHECK(read.scene_text == written.scene_text);
  CHECK(read.overrides.at(0).pointer == "/time/end");
  CHECK(read.overrides.at(0).value == "3");
  CHECK(read.plugin_folders == written.plugin_folders);
  CHECK(read.libraries.at(0).file == "liblaw.so");
  CHECK(read.libraries.at(0).hash == "0123");
  CHECK(read.simd == SimdLevel::avx2);
  CHECK(read.threads == 2);
  CHECK(read.model_hash == "4567");
  CHECK(read.time == 0.1);
  CHECK(read.steps == 12);
  CHECK(read.continued == written.continued);
  CHECK(read.state == written.state);
}

TEST_CASE("Any byte of a checkpoint that is lost or changed is noticed", "[checkpoint]") {
  const Scratch scratch;
  const auto file = scratch.folder() / "checkpoint.talus", spoilt = scratch.folder() / "spoilt.talus";
  write_checkpoint(file, some_checkpoint());
  const std::string whole = read_whole_file(file);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    CAPTURE(i);
    write_whole_file(spoilt, whole.substr(0, i));
    CHECK_THROWS_AS(read_checkpoint(spoilt), InputError);
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 4);
    write_whole_file(spoilt, changed);
    CHECK_THROWS_AS(read_checkpoint(spoilt), InputError);
  }
  write_whole_file(spoilt, whole + "x");
  CHECK_THROWS_AS(read_checkpoint(spoilt), InputError);
}

TEST_CASE("A file that is no checkpoint, or one of another program, is refused in words", "[checkpoint]") {
  const Scratch scratch;
  const auto file = scratch.folder() / "checkpoint.talus";
  write_whole_file(file, "t [s],a\n");
  CHECK_THROWS_WITH(read_checkpoint(file), Contains("is no checkpoint of talus"));
  write_whole_file(file, "talus checkpoint 7\n");
  CHECK_THROWS_WITH(read_checkpoint(file), Contains("of another form"));
  CHECK_THROWS_AS(read_checkpoint(scratch.folder() / "missing.talus"), std::system_error);
}

TEST_CASE(
    "A whole checkpoint of another version, or for instruction sets that nobody knows, is refused by that",
    "[checkpoint]") {
  const Scratch scratch;
  const auto file = scratch.folder() / "checkpoint.talus";
  write_checkpoint(file, some_checkpoint());
  const std::string whole = read_whole_file(file);
  // Whole in itself: only the words differ, of the same length, and the hash is theirs.
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = whole.substr(0, whole.size() - 32);
    text.replace(text.find(from), from.size(), to);
    text += hash_of_bytes(text);
    try {
      read_checkpoint_text(text, "c.talus");
    } catch (const InputError& problem) {
      return std::string(problem.what());
    }
    return std::string();
  };
  CHECK(refusal("avx2", "avx2").empty());
  CHECK_THAT(refusal("\"written_by\":\"talus 0", "\"written_by\":\"talus 9"),
             Contains("'c.talus' was written by talus 9") && Contains("this is talus " TALUS_VERSION) &&
                 Contains("use that version, or run the scene anew"));
  CHECK(refusal("\"avx2\"", "\"abcd\"") == "'c.talus' names an unknown instruction set");
  CHECK_THAT(refusal("\"threads\":2", "\"treads\": 2"),
             Contains("'c.talus' is damaged") && Contains("threads"));
  CHECK_THAT(refusal("\"threads\":2", "\"threads\":{"), Contains("is damaged") && Contains("parse error"));
}

TEST_CASE("A checkpoint that lost bytes says how many it should have", "[checkpoint]") {
  const Scratch scratch;
  const auto file = scratch.folder() / "checkpoint.talus";
  write_checkpoint(file, some_checkpoint());
  const std::string whole = read_whole_file(file);
  CHECK_THROWS_WITH(read_checkpoint_text(whole.substr(0, whole.size() - 7), "c.talus"),
                    Contains("bytes should follow its second line, there are") &&
                        Contains("take an older copy, or run the scene anew"));
}

TEST_CASE("A state with arrays of other lengths than the scene gives, or too short a one, is not taken",
          "[checkpoint]") {
  Archive kept;
  std::vector<double> three{1, 2, 3};
  kept(three);
  const auto take = [&](std::string_view bytes, std::size_t due) {
    Archive back(bytes);
    std::vector<double> values(due);
    back.of_known_size(values);
    return values;
  };
  CHECK(take(kept.bytes(), 3) == three);
  const char* words = "the state that was kept does not belong to this scene";
  CHECK_THROWS_WITH(take(kept.bytes(), 2), words);
  CHECK_THROWS_WITH(take(std::string_view(kept.bytes()).substr(0, 20), 3), words);
  CHECK_THROWS_WITH(take(std::string(8, '\xff'), 3), words);  // a length that no memory holds
}

TEST_CASE("A count in a checkpoint that is no count is refused by its name", "[checkpoint]") {
  const Scratch scratch;
  const auto file = scratch.folder() / "checkpoint.talus";
  write_checkpoint(file, some_checkpoint());
  const std::string whole = read_whole_file(file);
  const std::string header_on = whole.substr(whole.find('{'), whole.size() - whole.find('{') - 32);
  const auto with = [&](const std::string& old_text, const std::string& new_text) {
    std::string changed = header_on;
    changed.replace(changed.find(old_text), old_text.size(), new_text);
    std::string text = fmt::format("talus checkpoint 1\n{}\n{}", changed.size() + 32, changed);
    return text + hash_of_bytes(text);
  };
  CHECK(read_checkpoint_text(with("\"steps\":12", "\"steps\":13"), "it").steps == 13);
  for (const char* value : {"4.07e88", "-1", "12.5", "true"}) {
    CAPTURE(value);
    CHECK_THROWS_WITH(read_checkpoint_text(with("\"steps\":12", fmt::format("\"steps\":{}", value)), "it"),
                      Contains("'it' is damaged: its \"steps\" is no count"));
  }
  CHECK_THROWS_WITH(read_checkpoint_text(with("\"threads\":2", "\"threads\":2147483648"), "it"),
                    Contains("its \"threads\" is no count"));
}
