#include "text/escaped.hpp"
#include "text/printable.hpp"

#include <catch2/catch.hpp>

using namespace talus;

TEST_CASE("a letter that was cut off at the end is dropped, and whole ones stay", "[text]") {
  for (const std::string_view whole : {"", "a", "aä", "a€", "a😀"}) {
    INFO(whole);
    CHECK(without_cut_letter(whole) == whole);
    if (whole.size() < 2) continue;
    for (std::size_t size = 2; size < whole.size(); ++size)
      CHECK(without_cut_letter(whole.substr(0, size)) == "a");
  }
}

TEST_CASE("pages get text that is UTF-8, whatever was said", "[text]") {
  CHECK(escaped("a < b & \"c\"\n€") == "a &lt; b &amp; &quot;c&quot;\n€");
  CHECK(escaped("\x1b[31m€") == "?[31m€");
  CHECK(escaped("caf\xe9") == "caf?");
}
