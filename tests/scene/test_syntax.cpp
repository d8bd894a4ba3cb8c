#include "scene/bad_scene.hpp"
#include "scene/positions.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace talus;
using talus::sample::BadScene;
using talus::sample::check;

namespace {

const BadScene bad_texts[] = {
    {"a comma too many is named",
     "\"end\": 5}",
     "\"end\": 5,}",
     "/time",
     18,
     21,
     {"comma before '}'", "one too many"}},
    {"a missing comma is named",
     "\"talus\": 1,",
     "\"talus\": 1",
     "",
     3,
     3,
     {"found \"gravity\"", "',' or '}'"}},
    {"a key without quotes is named", "\"end\": 5}", "end: 5}", "/time", 18, 12, {"'end' is no JSON value"}},
    {"a text that does not end is named",
     "\"material\": \"rock\"}",
     "\"material\": \"rock}",
     "/bodies/1/material",
     14,
     86,
     {"not closed by a quote"}},
    {"a comment that does not end is named",
     "\"end\": 5}\n}",
     "\"end\": 5} /* and so on\n}\n",
     "",
     18,
     22,
     {"the comment is not closed by */"}},
    {"a file that ends too early is named",
     "\"end\": 5}\n}",
     "\"end\": 5",
     "/time",
     18,
     20,
     {"the file ends", "'}'"}},
    {"text after the scene is named",
     "\"end\": 5}\n}",
     "\"end\": 5}\n} 1",
     "",
     19,
     3,
     {"found '1'", "nothing more"}},
    {"NaN is no number",
     "\"end\": 5}",
     "\"end\": NaN}",
     "/time/end",
     18,
     19,
     {"'NaN' is no JSON value", "finite numbers"}},
    {"a number that begins with a needless zero is no number",
     "\"end\": 5}",
     "\"end\": 05}",
     "/time",
     18,
     19,
     {"'05' is no JSON value", "zero before other digits"}},
    {"Infinity is no number",
     "\"end\": 5}",
     "\"end\": -Infinity}",
     "/time/end",
     18,
     19,
     {"'-Infinity' is no JSON value"}},
    {"a number beyond the doubles is named",
     "\"end\": 5}",
     "\"end\": 1e999}",
     "/time/end",
     18,
     19,
     {"1e999", "1.8e308"}},
    {"a key that stands twice is named at the second one",
     "\"end\": 5}",
     "\"end\": 5, \"end\": 6}",
     "/time/end",
     18,
     22,
     {"\"end\" stands twice"}},
};

}  // namespace

TEST_CASE("every mistake in the text is told with its place and what would be right", "[scene]") {
  for (const BadScene& bad : bad_texts) {
    DYNAMIC_SECTION(bad.requirement) {
      const std::string text = sample::good_but(bad.old_text, bad.new_text);
      const std::vector<Mistake> found = sample::mistakes(text);
      REQUIRE(!found.empty());
      check(found[0], bad, text);
    }
  }
}

TEST_CASE("deep nesting is refused in words, not by a full stack", "[scene]") {
  const auto found = sample::mistakes(std::string(1000000, '['));
  REQUIRE(found.size() == 1);
  CHECK(found[0].line == 1);
  CHECK(found[0].column == 65);
  CHECK_THAT(found[0].message, Catch::Contains("nested too deep") && Catch::Contains("64"));
}

TEST_CASE("texts that are no scene are refused in words", "[scene]") {
  for (const char* text : {"", " ", "\n\n", "[]", "3", "\"scene\"", "null", "{}", "\xff\xfe",
                           "{\"talus\": 1, \"\\u0000\": 2}", "/* open"}) {
    CAPTURE(text);
    const auto found = sample::mistakes(text);
    REQUIRE(!found.empty());
    CHECK(found[0].line >= 1);
    CHECK(found[0].column >= 1);
    CHECK(!found[0].message.empty());
  }
}

TEST_CASE("a scene cut off anywhere is refused without harm", "[scene]") {
  const std::string text = sample::good;
  for (std::size_t length = 0; length < text.size(); ++length) {
    CAPTURE(length);
    REQUIRE(!sample::mistakes(text.substr(0, length)).empty());
  }
}

TEST_CASE("columns count characters and lines, not bytes", "[scene]") {
  const auto found = sample::mistakes(sample::good_but("{\"end\": 5}", "/* μ² */ {\"end\": 0}"));
  REQUIRE(found.size() == 1);
  CHECK(found[0].line == 18);
  CHECK(found[0].column == 28);
}

TEST_CASE("a file that cannot be read is no mistake of the scene", "[scene]") {
  Registry registry = sample::registry();
  CHECK_THROWS_AS(read_scene("no/such/scene.json", registry), std::system_error);
}

TEST_CASE("a byte of 0 is no end of a scene", "[scene]") {
  const ParsedText parsed = parse_json(std::string("{\"talus\": 1}") + '\0' + " garbage {{{", "s.json");
  CHECK_FALSE(parsed.complete);
  REQUIRE(parsed.mistakes.size() == 1);
  CHECK(parsed.mistakes[0].column == 13);
  CHECK_THAT(parsed.mistakes[0].text(), Catch::Contains("a byte of 0") && Catch::Contains("UTF-16"));
}
