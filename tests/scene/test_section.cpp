#include "scene/section.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;

TEST_CASE("a default without bounds is left out where a scene is spelled out, since none can be written",
          "[scene]") {
  const Json none = Json::object();
  Mistakes mistakes;
  Section section(&none, "", mistakes);
  CHECK(std::isinf(section.value(number("strength", "Pa", unbounded, 0, unbounded, "How strong it is."))));
  CHECK(section.value(number("stiffness", "Pa", 5, 0, unbounded, "How stiff it is.")) == 5);
  CHECK(mistakes.count() == 0);
  CHECK_FALSE(section.resolved.contains("strength"));
  CHECK(section.resolved.at("stiffness") == 5);
}
