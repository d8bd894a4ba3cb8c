#include "output/scratch.hpp"
#include "plugin/descriptors.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

using namespace talus;
using namespace talus::test;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

Registry offered_from(const std::vector<fs::path>& folders) {
  Registry registry;
  offer_folders(registry, folders);
  return registry;
}

}  // namespace

TEST_CASE("What a library brings is told by its file as by the library itself", "[plugin]") {
  Registry loaded;
  load_folders(loaded, std::array{fs::path(TALUS_PLUGINS), fs::path(TALUS_TEST_LIBRARIES)});
  std::size_t told = 0;
  for (const RegisteredComponent& entry : loaded.components()) {
    INFO(entry.file.string());
    const auto names = components_in_file(entry.file, "talus_library");
    REQUIRE(names);
    CHECK(std::ranges::count(*names, ComponentName{entry.component->kind, entry.component->name}) == 1);
    ++told;
  }
  CHECK(told > 10);
  // A library without any is told to have none.
  CHECK_FALSE(components_in_file(library("wrong_abi"), "talus_library"));
  CHECK_FALSE(components_in_file(library("missing_symbol"), "talus_library"));
  CHECK_FALSE(components_in_file(TALUS_LAW_SOURCE, "talus_library"));
}

TEST_CASE("An offered library is loaded when its component is demanded, and no other", "[plugin]") {
  const Scratch scratch;
  fs::copy_file(library("good"), scratch / "libgood.so");
  fs::copy_file(library("throwing_constructor"), scratch / "libthrowing.so");
  Registry registry = offered_from({scratch.folder()});
  CHECK(registry.components().empty());
  CHECK(demand(registry, ComponentKind::contact_model, "nobody") == nullptr);
  CHECK(demand(registry, ComponentKind::material, "overlap_area") == nullptr);
  CHECK(registry.components().empty());
  const RegisteredComponent* law = demand(registry, ComponentKind::contact_model, "overlap_area");
  REQUIRE(law != nullptr);
  CHECK(law->file == scratch / "libgood.so");
  CHECK(registry.offered.size() == 1);
  load_offered(registry);
  CHECK(registry.offered.empty());
  CHECK(registry.find(ComponentKind::contact_model, "throws_words") != nullptr);
  // What was found stays where it is while more come.
  CHECK(law == registry.find(ComponentKind::contact_model, "overlap_area"));
}

TEST_CASE("Of two libraries that offer a name the first one has it, whichever is demanded", "[plugin]") {
  const Scratch first, second;
  fs::copy_file(library("good"), first / "libgood.so");
  fs::copy_file(library("duplicate_name"), second / "liba.so");
  Registry loaded;
  const std::array folders{first.folder(), second.folder()};
  load_folders(loaded, folders);
  Registry registry = offered_from({first.folder(), second.folder()});
  for (const OfferedLibrary& offer : std::vector<OfferedLibrary>(registry.offered)) {
    for (const ComponentName& name : offer.brings) {
      INFO(name.name);
      const RegisteredComponent* found = demand(registry, name.kind, name.name);
      const RegisteredComponent* due = loaded.find(name.kind, name.name);
      REQUIRE((found == nullptr) == (due == nullptr));
      if (found != nullptr) CHECK(found->file == due->file);
    }
  }
  load_offered(registry);
  REQUIRE(registry.refused.size() == 1);
  CHECK(registry.refused[0].reason == loaded.refused[0].reason);
}

TEST_CASE("A library named by its path cannot take a name that the folders offer", "[plugin]") {
  const Scratch scratch;
  fs::copy_file(library("good"), scratch / "libgood.so");
  Registry registry = offered_from({scratch.folder()});
  CHECK_THAT(refusal_of(registry, library("duplicate_name")),
             Contains("'overlap_area'") && Contains((scratch / "libgood.so").string()));
}

TEST_CASE("What does not fit is refused when it is offered", "[plugin]") {
  const Scratch scratch;
  fs::copy_file(library("wrong_abi"), scratch / "libb.so");
  const Registry registry = offered_from({scratch.folder()});
  CHECK(registry.offered.empty());
  REQUIRE(registry.refused.size() == 1);
  CHECK_THAT(registry.refused[0].reason, Contains(fmt::format("found ABI {}", abi_number + 41)));
}
