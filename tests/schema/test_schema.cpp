#include "schema/json_schema.hpp"

#include "apps/program.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/scratch.hpp"
#include "scene/sample.hpp"
#include "schema/reference.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

Registry installed() {
  Registry registry;
  load_folders(registry, std::vector<std::filesystem::path>{TALUS_PLUGINS});
  return registry;
}

const OrderedJson& choice_of(const OrderedJson& section, const std::string& model) {
  for (const OrderedJson& choice : section["allOf"]) {
    const auto condition = choice["if"].value("properties", OrderedJson::object());
    if (condition.contains("model") && condition["model"]["const"] == model) return choice["then"];
  }
  throw std::runtime_error("no such model: " + model);
}

}  // namespace

TEST_CASE("The schema says of a parameter what its table says", "[schema]") {
  const OrderedJson schema = scene_schema(installed());
  const OrderedJson& safety = schema["$defs"]["time"]["properties"]["safety"];
  CHECK(safety["type"] == "number");
  CHECK(safety["exclusiveMinimum"] == 0);
  CHECK(safety["maximum"] == 0.9);
  CHECK(safety["default"] == 0.2);
  CHECK(schema["$defs"]["time"]["required"] == OrderedJson::array({"end"}));
  CHECK(schema["$defs"]["time"]["additionalProperties"] == false);
  CHECK(schema["$defs"]["sleep"]["properties"]["after"]["title"] == "after [s]");
  CHECK(schema["properties"]["gravity"]["default"] == OrderedJson::array({0, 0}));
  CHECK_FALSE(schema["$defs"]["output"]["properties"]["frames"].contains("default"));
}

TEST_CASE("The fields of a section follow its model", "[schema]") {
  const OrderedJson schema = scene_schema(installed());
  const OrderedJson& material = schema["$defs"]["material"];
  CHECK(choice_of(material, "mohr_coulomb")["properties"].contains("dilation_angle"));
  CHECK_FALSE(choice_of(material, "linear_elastic")["properties"].contains("dilation_angle"));
  CHECK(choice_of(schema["$defs"]["cover"], "hexagonal")["required"] == OrderedJson::array({"size"}));
  CHECK(schema["$defs"]["contact"]["properties"]["vertex_edge"]["properties"].contains("calibration"));
}

TEST_CASE("A law of a library brings its own keys for itself and for interfaces", "[schema]") {
  const OrderedJson schema = scene_schema(sample::registry());
  CHECK(schema["$defs"]["contact"]["properties"]["shear"]["properties"]["strict"]["default"] == false);
  CHECK(schema["$defs"]["interface"]["properties"]["dilation"]["maximum"] == 45);
  const OrderedJson& shear = schema["allOf"][0];
  CHECK(shear["if"]["properties"]["contact"]["properties"]["model"]["const"] == "shear");
  const OrderedJson& row = shear["then"]["properties"]["interfaces"]["items"];
  CHECK(row["properties"]["dilation"]["maximum"] == 45);
  CHECK(row["properties"]["dilation"]["default"] == 5);
  CHECK(row["required"] == OrderedJson::array({"normal_damping", "friction_angle", "normal_stiffness"}));
  // Not read by this law, but known to interfaces.
  CHECK_THAT(row["properties"]["tensile_strength"]["description"].get<std::string>(), Contains("not read"));
  const OrderedJson& without = schema["allOf"][2]["then"]["properties"]["interfaces"]["items"];
  CHECK(without["properties"]["dilation"] == false);
}

TEST_CASE("The reference of scenes is what the program writes", "[schema][docs]") {
  const std::string docs = read_whole_file(TALUS_DOCS "/scenes.md");
  // Where this fails: talus schema --reference docs/scenes.md
  CHECK(with_reference(docs, installed()) == docs);
  for (const Part& part : parts_of_scene()) {
    CAPTURE(part.pointer);
    CHECK_THAT(docs, Contains("<!-- reference: " + part.pointer + " -->"));
  }
}

TEST_CASE("A reference with a wrong name or without an end is refused in words", "[schema][docs]") {
  const Registry registry = installed();
  CHECK(with_reference("no mark", registry) == "no mark");
  CHECK_THROWS_WITH(with_reference("<!-- reference: /tme -->\n<!-- end of reference -->\n", registry),
                    Contains("no table \"/tme\"") && Contains("did you mean \"/time\""));
  CHECK_THROWS_WITH(with_reference("<!-- reference: /time -->\n", registry), Contains("has no end"));
}

TEST_CASE("A reference is written into a file, and nothing where that fails", "[schema][apps]") {
  const Scratch scratch;
  const auto file =
      scratch.write("mine.md", "# Mine\n<!-- reference: /sleep -->\nold\n<!-- end of reference -->\nend\n");
  REQUIRE(call_talus(scratch.folder(), {"schema", "--reference", "mine.md"}).code == 0);
  CHECK_THAT(read_whole_file(file), Contains("| `after` | s | 0.05 | > 0 |") && !Contains("old") &&
                                        Catch::EndsWith("<!-- end of reference -->\nend\n"));
  scratch.write("mine.md", "<!-- reference: /nothing -->\n");
  const Call call = call_talus(scratch.folder(), {"schema", "--reference", "mine.md"});
  CHECK(call.code == 2);
  CHECK(call.out.empty());
  CHECK(read_whole_file(file) == "<!-- reference: /nothing -->\n");
}
