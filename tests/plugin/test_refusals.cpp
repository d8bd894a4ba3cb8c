#include "plugin/descriptors.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <sys/stat.h>

#include <unistd.h>

#include <fstream>

using namespace talus;
using namespace talus::test;
using Catch::Contains;

namespace {

/// Refused with the name of its file, what was found, what was wanted and what to do; nothing was added.
void require_refused(const std::string& stem, const std::string& found, const std::string& wanted,
                     const std::string& advice) {
  Registry registry;
  const std::string words = refusal_of(registry, library(stem));
  CHECK_THAT(words, Contains(library(stem).string() + ": "));
  CHECK_THAT(words, Contains(found));
  CHECK_THAT(words, Contains(wanted));
  CHECK_THAT(words, Contains(advice));
  CHECK(registry.components().empty());
}

}  // namespace

TEST_CASE("A library of another ABI is refused before anything else is read", "[plugin]") {
  require_refused("wrong_abi", fmt::format("found ABI {}", abi_number + 41),
                  fmt::format("wanted ABI {}", abi_number), "rebuild it against the headers of talus 0.1");
}

TEST_CASE("A library with a structure of another size is refused", "[plugin]") {
  const std::size_t size = sizeof(ContactBatch);
  require_refused("wrong_size", "found ContactBatch of " + std::to_string(size + 8) + " bytes",
                  "wanted " + std::to_string(size), "rebuild it against the headers of talus 0.1");
}

TEST_CASE("A library for another machine is refused before any of its code runs", "[plugin]") {
  require_refused("lacking_instructions", "found code for instructions that this machine lacks",
                  "wanted a library that runs here", "rebuild it without -march=native");
}

TEST_CASE("A library in other units is refused", "[plugin]") {
  require_refused("wrong_units", "found the unit system 'SI: mm t s", "wanted 'SI: m kg s",
                  "convert the library");
}

TEST_CASE("A library with another magic number is refused", "[plugin]") {
  require_refused("wrong_magic", "found the magic number 0x12345678", "wanted 0x554c4154", "no talus plugin");
}

TEST_CASE("A claim that nobody knows is refused", "[plugin]") {
  require_refused("unknown_trait", "found the traits 0x101", "talus::trait", "rebuild the library");
}

TEST_CASE("A library without a name is refused", "[plugin]") {
  require_refused("null_name", "found no name", "wanted one", "set talus_library.name");
}

TEST_CASE("A library without the descriptor is refused", "[plugin]") {
  require_refused("missing_symbol", "found no symbol 'talus_library'", "wanted the descriptor",
                  "export it with TALUS_EXPORT");
}

TEST_CASE("A library with something undefined is refused in the loader's words", "[plugin]") {
  require_refused("undefined_symbol", "undefined symbol: defined_nowhere", "wanted a talus plugin",
                  "rebuild it");
}

TEST_CASE("A library with a default outside its range is refused as a whole", "[plugin]") {
  require_refused("default_out_of_range",
                  "component 1 'default_out_of_range': parameter 'share': found the default 1.5",
                  "range [0, 1], wanted one within", "correct it and rebuild the library");
}

TEST_CASE("A file that is no library is refused in the loader's words", "[plugin]") {
  const auto file = std::filesystem::temp_directory_path() / ("libtext." + std::to_string(getpid()) + ".so");
  std::ofstream(file)
      << "This is a text, long enough to be taken for the header of a library, but it is none.\n";
  Registry registry;
  CHECK_THAT(refusal_of(registry, file), Contains(file.string() + ": ") && Contains("invalid ELF header") &&
                                             Contains("wanted a talus plugin"));
  std::filesystem::remove(file);
}

TEST_CASE("A missing file and a folder are refused as such", "[plugin]") {
  Registry registry;
  CHECK_THAT(refusal_of(registry, library("nowhere")),
             Contains("libnowhere.so: found no such file") && Contains("check the path"));
  CHECK_THAT(refusal_of(registry, TALUS_TEST_LIBRARIES),
             Contains("found a folder") && Contains("give the folder to --plugin-path"));
}

TEST_CASE("a pipe among plugins is refused, not waited for", "[plugin]") {
  const Scratch scratch;
  const std::filesystem::path pipe = scratch / "libpipe.so";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  Registry registry;
  CHECK_THAT(refusal_of(registry, pipe), Contains("found a pipe or a device"));
}

TEST_CASE("What a constructor throws becomes words with the file and the component", "[plugin]") {
  Registry registry;
  load_library(registry, library("throwing_constructor"));
  const RegisteredComponent* words = registry.find(ComponentKind::contact_model, "throws_words");
  const RegisteredComponent* number = registry.find(ComponentKind::contact_model, "throws_number");
  REQUIRE((words != nullptr && number != nullptr));
  const std::string file = library("throwing_constructor").string();
  CHECK_THROWS_WITH(make<ContactModel>(*words, {}),
                    file + ": 'throws_words' could not be made: the two stiffnesses contradict each other");
  const auto other = [&](const char* name) { return *registry.find(ComponentKind::contact_model, name); };
  CHECK_THROWS_WITH(make<ContactModel>(other("throws_controls"), {}),
                    file + ": 'throws_controls' could not be made:  [31mtoo red?");
  CHECK_THROWS_WITH(make<ContactModel>(other("throws_long"), {}), Contains("made: ääää") && !Contains("?"));
  CHECK_THROWS_WITH(make<ContactModel>(other("throws_silence"), {}),
                    file + ": 'throws_silence' could not be made: it does not say why");
  CHECK_THROWS_WITH(
      make<ContactModel>(*number, {}),
      Contains(file + ": 'throws_number' could not be made: ") && Contains("no std::exception"));
}

TEST_CASE("A name that another file has taken is refused with both files, and nothing is added", "[plugin]") {
  Registry registry;
  load_library(registry, library("good"));
  const std::string words = refusal_of(registry, library("duplicate_name"));
  CHECK_THAT(words, Contains(library("duplicate_name").string() + ": ") &&
                        Contains(library("good").string()) && Contains("'overlap_area'") &&
                        Contains("rename one of the two"));
  CHECK(registry.components().size() == 1);
  CHECK(registry.find(ComponentKind::contact_model, "blameless") == nullptr);
}
