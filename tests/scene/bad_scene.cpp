#include "scene/bad_scene.hpp"

#include <catch2/catch.hpp>

namespace talus::sample {
namespace {

/// The rest of the line from where the mistake is said to stand.
std::string text_at(const std::string& text, const Mistake& mistake) {
  std::size_t start = 0;
  for (std::size_t line = 1; line < mistake.line; ++line) start = text.find('\n', start) + 1;
  start += mistake.column - 1;
  return text.substr(start, text.find('\n', start) - start);
}

}  // namespace

void check(const Mistake& mistake, const BadScene& bad, const std::string& text) {
  INFO("stands at: " << text_at(text, mistake));
  INFO(mistake.text());
  CHECK(mistake.file == "scene.json");
  CHECK(mistake.pointer == bad.pointer);
  CHECK(mistake.line == bad.line);
  CHECK(mistake.column == bad.column);
  for (const char* word : bad.words) CHECK_THAT(mistake.message, Catch::Contains(word));
}

void check_alone(const BadPart& bad, const std::string& text) {
  const std::vector<Mistake> found = mistakes(text);
  for (const Mistake& mistake : found) UNSCOPED_INFO(mistake.text());
  REQUIRE(found.size() == 1);
  CHECK(found[0].pointer == bad.pointer);
  CHECK_THAT(text_at(text, found[0]), Catch::StartsWith(bad.at));
  for (const char* word : bad.words) CHECK_THAT(found[0].message, Catch::Contains(word));
}

}  // namespace talus::sample
