#include "output/scratch.hpp"
#include "scene/columns.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace {

struct Good {
  const char* requirement;
  const char* text;
  const char* column;
  std::vector<double> at, value;
};

const Good good_files[] = {
    {"two columns of numbers", "0,1\n1,2\n3,-4e-1\n", "", {0, 1, 3}, {1, 2, -0.4}},
    {"the last line needs no end", "0,1\n1,2", "", {0, 1}, {1, 2}},
    {"lines of a header, blanks, signs and ends of another system",
     "\xEF\xBB\xBFtime, ax\r\ns, m/s2\r\n\r\n -1 , +1\r\n 1.5 ,\t-2 \r\n\r\n",
     "",
     {-1, 1.5},
     {1, -2}},
    {"remarks anywhere, even with numbers",
     "# recorded, 2011\n# 3, 4\n0,1\n# a pause\n1,2\n",
     "",
     {0, 1},
     {1, 2}},
    {"a column by its name", "t,ax,ay\n0,1,2\n1,3,4\n", "ay", {0, 1}, {2, 4}},
    {"a column by its name in quotes or behind #", "#t,\"a x\",ay\n0,1,2\n1,3,4\n", "a x", {0, 1}, {1, 3}},
    {"a column by a name of the first of two lines", "t,ax\ns,m/s2\n0,1\n1,3\n", "ax", {0, 1}, {1, 3}},
    {"a history of a run", "time [s],block.ux [m]\n0,0\n0.1,5\n", "block.ux [m]", {0, 0.1}, {0, 5}},
    {"a remark with commas names no column",
     "# of station X, a, 3\nt,v,a\n0,1,2\n1,3,4\n",
     "a",
     {0, 1},
     {2, 4}},
    {"other columns may hold anything", "t,ax,note\n0,1,start\n1,3,\n", "ax", {0, 1}, {1, 3}},
};

struct Bad {
  const char* requirement;
  const char* text;
  const char* column;
  const char* said;  ///< after the name of the file
};

const Bad bad_files[] = {
    {"an empty file", "", "", ": no line of numbers: expected at least two"},
    {"a header alone", "t,ax\n", "", ": no line of numbers: expected at least two"},
    {"a single point", "t,ax\n1,2\n", "", ": only one line of numbers: expected at least two"},
    {"a word among the numbers", "t,ax\n0,1\n1,two\n", "", ":3: \"two\" is no finite number"},
    {"a first line with a slip of the pen is no header", "o,1\n1,2\n2,3\n", "",
     ":1: \"o\" is no finite number"},
    {"an empty field", "0,1\n1,\n", "", ":2: \"\" is no finite number"},
    {"a number that is none", "0,1\n1,nan\n", "", ":2: \"nan\" is no finite number"},
    {"infinity", "0,1\n1,inf\n", "", ":2: \"inf\" is no finite number"},
    {"a number beyond the doubles", "0,1\n1,1e999\n", "", ":2: \"1e999\" is no finite number"},
    {"a number with a rest", "0,1\n1,2 m\n", "", ":2: \"2 m\" is no finite number"},
    {"times that stand still", "0,1\n1,2\n\n1,3\n", "",
     ":4: 1 does not come after 1: the first column must rise strictly"},
    {"times that run back", "0,1\n-1,2\n", "",
     ":2: -1 does not come after 0: the first column must rise strictly"},
    {"a line that is longer than the others", "0,1\n1,2,3\n", "", ":2: 3 columns, but 2 in the lines before"},
    {"a single column", "0\n1\n", "",
     ":1: 1 column: expected two, or \"file.csv:name\" with the name of one; known: (none)"},
    {"semicolons", "t;a\n0;1\n1;2\n", "",
     ":2: numbers with no comma between them: expected lines as 0.1,2.5, with a point in decimals"},
    {"blanks", "0 1\n1 2\n", "",
     ":1: numbers with no comma between them: expected lines as 0.1,2.5, with a point in decimals"},
    {"commas in decimals", "0,5;1,5\n1,5;2\n", "",
     ":1: numbers with no comma between them: expected lines as 0.1,2.5, with a point in decimals"},
    {"more columns and no name", "t,ax,ay\n0,1,2\n1,2,3\n", "",
     ":2: 3 columns: expected two, or \"file.csv:name\" with the name of one; known: ax, ay"},
    {"a name that no column has", "t,ax,ay\n0,1,2\n1,2,3\n", "az",
     ":2: there is no column \"az\" after the first; did you mean \"ax\"? known: ax, ay"},
    {"the name of the first column", "t,ax\n0,1\n1,2\n", "t",
     ":2: there is no column \"t\" after the first; known: ax"},
};

}  // namespace

TEST_CASE("columns are read from files of comma-separated values", "[scene]") {
  const Scratch scratch;
  for (const Good& good : good_files) {
    DYNAMIC_SECTION(good.requirement) {
      std::string problem;
      const auto columns = read_columns(scratch.write("a.csv", good.text), good.column, problem);
      CHECK(problem.empty());
      REQUIRE(columns.has_value());
      CHECK(columns->at == good.at);
      CHECK(columns->value == good.value);
    }
  }
}

TEST_CASE("what is wrong with a file of columns is told with its line", "[scene]") {
  const Scratch scratch;
  for (const Bad& bad : bad_files) {
    DYNAMIC_SECTION(bad.requirement) {
      const auto file = scratch.write("a.csv", bad.text);
      std::string problem;
      CHECK_FALSE(read_columns(file, bad.column, problem).has_value());
      CHECK(problem == file.string() + bad.said);
    }
  }
}

TEST_CASE("what is no file of columns is refused in words", "[scene]") {
  const Scratch scratch;
  std::string problem;
  CHECK_FALSE(read_columns(scratch / "none.csv", "", problem).has_value());
  CHECK(problem == "there is no file " + (scratch / "none.csv").string());
  CHECK_FALSE(read_columns(scratch.folder(), "", problem).has_value());
  CHECK_FALSE(read_columns("/dev/zero", "", problem).has_value());
  CHECK(problem == "there is no file /dev/zero");
  const std::string bytes("\0\xff\x80,\n\0,", 8);
  CHECK_FALSE(read_columns(scratch.write("b.csv", bytes), "", problem).has_value());
}

TEST_CASE("files that are too large are refused before they fill the memory", "[scene]") {
  const Scratch scratch;
  std::string problem;
  const auto sparse = scratch.write("sparse.csv", "");
  std::filesystem::resize_file(sparse, 100'000'001);
  CHECK_FALSE(read_columns(sparse, "", problem).has_value());
  CHECK_THAT(problem, Catch::EndsWith("is larger than 100 MB, the most that is read"));
  CHECK_FALSE(read_columns(scratch.write("wide.csv", std::string(2000, ',')), "", problem).has_value());
  CHECK_THAT(problem, Catch::EndsWith(":1: expected at most 1000 columns"));
  std::string heads;
  for (int i = 0; i < 200; ++i) heads += "a,b\n";
  CHECK_FALSE(read_columns(scratch.write("heads.csv", heads), "", problem).has_value());
  CHECK_THAT(problem, Catch::EndsWith(":101: too many lines before the numbers"));
  std::string rows;
  for (std::size_t i = 0; i <= most_points; ++i) rows += std::to_string(i) + ",1\n";
  CHECK_FALSE(read_columns(scratch.write("long.csv", rows), "", problem).has_value());
  CHECK_THAT(problem, Catch::EndsWith(":1000001: more than 1000000 points, the most that are read"));
}
