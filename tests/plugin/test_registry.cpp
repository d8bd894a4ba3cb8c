#include "plugin/descriptors.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

using namespace talus;
using namespace talus::test;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

/// A folder of its own that goes with the test.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path(fs::temp_directory_path() / (name + "." + std::to_string(getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path path;
};

}  // namespace

TEST_CASE("Components are found by kind and name, names come sorted", "[plugin]") {
  Component components[] = {fitting_component("zig"), fitting_component("ant"), fitting_component("ant")};
  components[2].kind = ComponentKind::material;
  const Library library = fitting_library(components, 3);
  Registry registry;
  registry.add(library, "a.so");
  CHECK(registry.names(ComponentKind::contact_model) == std::vector<std::string>{"ant", "zig"});
  CHECK(registry.names(ComponentKind::material) == std::vector<std::string>{"ant"});
  CHECK(registry.names(ComponentKind::cover_builder).empty());
  CHECK(registry.find(ComponentKind::material, "ant")->component == &components[2]);
  CHECK(registry.find(ComponentKind::material, "zig") == nullptr);
}

TEST_CASE("Of a library with one name taken, no component enters the registry", "[plugin]") {
  const Component first = fitting_component("taken");
  const Component second[] = {fitting_component("free"), fitting_component("taken")};
  const Library one = fitting_library(&first, 1), other = fitting_library(second, 2);
  Registry registry;
  registry.add(one, "one.so");
  CHECK_THROWS_WITH(registry.add(other, "other.so"), Contains("other.so") && Contains("one.so"));
  CHECK(registry.components().size() == 1);
}

TEST_CASE("The same file is taken once, whatever path leads to it", "[plugin]") {
  const Folder folder("talus-links");
  fs::create_symlink(library("good"), folder.path / "libgood.so");
  Registry registry;
  load_library(registry, library("good"));
  load_library(registry, library("good"));
  load_library(registry, fs::relative(library("good")));
  load_library(registry, folder.path / "libgood.so");
  CHECK(registry.components().size() == 1);
  CHECK(registry.components()[0].file == library("good"));
}

TEST_CASE("Earlier folders come first, files in sorted order, what does not fit is kept with its reason",
          "[plugin]") {
  const Folder first("talus-first"), second("talus-second");
  fs::copy_file(library("good"), first.path / "libgood.so");
  fs::copy_file(library("duplicate_name"), second.path / "liba.so");
  fs::copy_file(library("wrong_abi"), second.path / "libb.so");
  fs::copy_file(library("throwing_constructor"), second.path / "libc.so");
  fs::copy_file(library("wrong_size"), second.path / "not_a_plugin.so");  // no lib*.so: not looked at
  std::ofstream(second.path / "libnotes.txt") << "no plugin either\n";

  Registry registry;
  const fs::path folders[] = {first.path, second.path, second.path / "nowhere"};
  load_folders(registry, folders);
  CHECK(registry.find(ComponentKind::contact_model, "overlap_area")->file == first.path / "libgood.so");
  CHECK(registry.find(ComponentKind::contact_model, "throws_words") != nullptr);
  REQUIRE(registry.refused.size() == 3);
  CHECK(registry.refused[0].file == second.path / "liba.so");
  CHECK_THAT(registry.refused[0].reason, Contains("'overlap_area'") && Contains(first.path.string()));
  CHECK(registry.refused[1].file == second.path / "libb.so");
  CHECK_THAT(registry.refused[1].reason, Contains(fmt::format("found ABI {}", abi_number + 41)));
  CHECK(registry.refused[2].file == second.path / "nowhere");
  CHECK_THAT(registry.refused[2].reason, Contains("no folder that can be read"));
}

TEST_CASE("Folders given come before the environment's, the installation's own last", "[plugin]") {
  const char* before = std::getenv("TALUS_PLUGIN_PATH");
  const std::string kept = before == nullptr ? "" : before;
  const fs::path given[] = {"given", "/also/given"};

  setenv("TALUS_PLUGIN_PATH", "/from/environment::/and/this", 1);
  CHECK(search_path(given) == std::vector<fs::path>{fs::absolute("given"), "/also/given", "/from/environment",
                                                    "/and/this", TALUS_PLUGINS});
  unsetenv("TALUS_PLUGIN_PATH");
  CHECK(search_path({}) == std::vector<fs::path>{TALUS_PLUGINS});
  if (before != nullptr) setenv("TALUS_PLUGIN_PATH", kept.c_str(), 1);
}

TEST_CASE("The built-in libraries enter by the same door", "[plugin]") {
  Registry registry;
  const fs::path folders[] = {TALUS_PLUGINS};
  load_folders(registry, folders);
  for (const RefusedLibrary& refused : registry.refused) {
    FAIL_CHECK(refused.file.string() << ": " << refused.reason);
  }
  CHECK(!registry.components().empty());
  for (const RegisteredComponent& entry : registry.components()) {
    INFO(entry.file.string());
    CHECK(entry.file.parent_path() == fs::path(TALUS_PLUGINS));
    CHECK(entry.file.stem() == std::string("lib") + entry.component->name);
    CHECK(std::string(entry.library->version) == TALUS_VERSION);
    CHECK(*entry.component->sentence != '\0');
  }
}
