#include "scene/sample.hpp"

#include <catch2/catch.hpp>

#include <cstdio>

using namespace talus;

namespace {

int made = 0, dropped = 0;

constexpr Parameter spring[] = {number("spring", "N/m", 0, 0, unbounded, "Spring of a vertex.")};
constexpr Component law[] = {
    {ComponentKind::contact_model, "springy", "A law that its defaults do not suit.", spring, 1, nullptr, 0,
     [](const double* values, char* error, std::size_t error_size) noexcept -> void* {
       if (values[0] > 0) return &++made;
       std::snprintf(error, error_size, "a spring above 0 is needed");
       return nullptr;
     },
     [](void*) noexcept { ++dropped; }}};

/// The sample's components and that law.
Registry& registry() {
  static const Library springs = library("springs", "1", "nobody", law);
  static Registry all = [] {
    Registry with_sample = sample::registry();
    with_sample.add(springs, "/nowhere/libspringy.so");
    return with_sample;
  }();
  return all;
}

std::vector<Mistake> mistakes(const std::string& text, const ReadOptions& options = {}) {
  try {
    read_scene_text(text, "scene.json", registry(), options);
  } catch (const SceneError& error) {
    return error.mistakes;
  }
  return {};
}

const std::string chosen = "{\"model\": \"shear\", \"shear\": {\"friction_rule\": \"paper\"}}";

}  // namespace

TEST_CASE("defaults that a constructor refuses are a mistake where the law is named", "[scene]") {
  const auto found = mistakes(sample::good_but(chosen, "{\"model\": \"springy\"}"));
  REQUIRE(found.size() == 1);
  CHECK(found[0].text() ==
        "scene.json:8:24: /contact/model: contact law \"springy\" refuses its parameters: a spring above 0 "
        "is needed");
}

TEST_CASE("values that a constructor refuses are a mistake at the section of the law", "[scene]") {
  const auto found = mistakes(sample::good_but(chosen, "{\"model\": \"springy\", \"springy\": {}}"));
  REQUIRE(found.size() == 1);
  CHECK(found[0].pointer == "/contact/springy");
  CHECK(found[0].line == 8);
  CHECK(found[0].column == 46);
  CHECK_THAT(found[0].message, Catch::EndsWith("a spring above 0 is needed"));
}

TEST_CASE("a law chosen by --set that refuses its parameters points at the --set", "[scene]") {
  const auto found = mistakes(sample::good, {{{"/contact/model", "springy"}}, false});
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].text(), Catch::StartsWith("--set /contact/model=springy: /contact/model: "));
}

TEST_CASE("a chosen law is made once to be checked and then dropped, and others are not made", "[scene]") {
  made = dropped = 0;
  const std::string both = "{\"model\": \"springy\", \"springy\": {\"spring\": 1}}";
  CHECK(mistakes(sample::good_but(chosen, both)).empty());
  CHECK(made == 1);
  CHECK(dropped == 1);
  CHECK(mistakes(sample::good_but(chosen, both), {{{"/contact/model", "shear"}}, false}).empty());
  CHECK(made == 1);
}
