#include "compare/variation.hpp"
#include "files/input_error.hpp"

#include <catch2/catch.hpp>

using namespace talus;

TEST_CASE("a variation is a pointer and its values", "[compare][variation]") {
  const Variation laws = parse_variation("/contact/model=overlap_area,vertex_edge");
  CHECK(laws.pointer == "/contact/model");
  CHECK(laws.values == std::vector<std::string>{"overlap_area", "vertex_edge"});
  CHECK_FALSE(laws.of_time());
  CHECK(parse_variation("/time/dt=1e-4,5e-5").of_time());
  CHECK_FALSE(parse_variation("/timetable=1,2").of_time());
}

TEST_CASE("commas within a value do not divide it", "[compare][variation]") {
  CHECK(parse_variation("/gravity=[0, -9.81],[0, -10]").values ==
        std::vector<std::string>{"[0, -9.81]", "[0, -10]"});
  CHECK(parse_variation(R"(/title="a\\","b","c\",d")").values ==
        std::vector<std::string>{R"("a\\")", R"("b")", R"("c\",d")"});
  CHECK(parse_variation(R"(/title=a\"b,c)").values == std::vector<std::string>{R"(a\"b)", "c"});
  CHECK(parse_variation("/title=\"a,b\",c").values == std::vector<std::string>{"\"a,b\"", "c"});
}

TEST_CASE("a variation that says nothing clear is refused", "[compare][variation]") {
  for (const char* text : {"contact/model=a,b", "/contact/model", "/a=b,,c", "/a=", "/a=b,b"}) {
    CHECK_THROWS_AS(parse_variation(text), InputError);
  }
}

TEST_CASE("a value makes a folder name that stays within its folder", "[compare][variation]") {
  CHECK(folder_of_value("overlap_area") == "overlap_area");
  CHECK(folder_of_value("1e-4") == "1e-4");
  CHECK(folder_of_value("../x y") == ".._x_y");
  CHECK(folder_of_value("..") == "_");
  CHECK(folder_of_value("лёд") != folder_of_value("мел"));
  CHECK(folder_of_value("лёд").starts_with("______"));
  const std::string long_value(200, 'a');
  CHECK(folder_of_value(long_value) == long_value);
  const std::string first = folder_of_value(long_value + "b"), second = folder_of_value(long_value + "c");
  CHECK(first.size() == 200);
  CHECK(first.starts_with("aaa"));
  CHECK(first != second);
  CHECK(folder_of_value(long_value + "b") == first);
}
