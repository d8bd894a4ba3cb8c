#include "scene/sample.hpp"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

#include <numbers>

using namespace talus;
using nlohmann::json;

namespace {

constexpr double degree = std::numbers::pi / 180;

}  // namespace

TEST_CASE("what a scene leaves out has its default", "[scene]") {
  const Scene scene = sample::read(sample::good);
  CHECK(scene.file == "scene.json");
  CHECK(scene.title.empty());
  CHECK((scene.origin.x == 0 && scene.origin.y == 0));
  CHECK((scene.damping.kind == Damping::Kind::constant && scene.damping.constant == 0));
  CHECK((scene.base_acceleration[0].zero() && scene.base_acceleration[1].zero()));
  CHECK(scene.stages.empty());
  CHECK_FALSE(scene.bodies[1].self_contact);
  CHECK_FALSE(scene.settle.has_value());
  CHECK_FALSE(scene.time.dt.has_value());
  CHECK(scene.time.safety == 0.2);
  CHECK(scene.output.history == 5.0 / 500);
  CHECK_FALSE(scene.output.frames.has_value());
  CHECK(scene.limits.energy_residual == 0.05);
  CHECK(scene.limits.penetration == 0.3);
  CHECK(scene.monitors[0].quantities ==
        std::vector<std::string>{"ux", "uy", "vx", "vy", "speed", "rotation"});
  CHECK_FALSE(scene.roles_by_priority);
  CHECK(scene.warnings.empty());
}

TEST_CASE("components get their values in declared order, in SI", "[scene]") {
  const Scene scene = sample::read(sample::good);
  CHECK(scene.contact.component->component->name == std::string("shear"));
  CHECK(scene.contact.values == std::vector<double>{1, 0});
  CHECK(scene.materials[0].name == "rock");
  CHECK(scene.materials[0].model.values == std::vector<double>{1e10, 0.25});
  CHECK(scene.bodies[1].cover.component->component->name == std::string("block"));
  REQUIRE(scene.interface_values.size() == 1);
  CHECK(scene.interface_values[0] == std::vector<double>{0.3, 20 * degree, 1e10, 0, 5 * degree});
}

TEST_CASE("models are chosen only where a body needs them", "[scene]") {
  const Scene scene = sample::read(sample::good_but(
      "\"material\": \"rock\"", "\"material\": \"rock\", \"cover\": {\"model\": \"rigid\"}"));
  CHECK(scene.materials[0].model.component == nullptr);
  CHECK(scene.bodies[0].cover.component == nullptr);
  CHECK(scene.bodies[1].cover.component->component->name == std::string("rigid"));
}

TEST_CASE("a single body needs neither contact nor interfaces", "[scene]") {
  const Scene scene = sample::read(R"({"talus": 1, "materials": {"m": {"density": 1}}, "time": {"end": 1},
      "cover": {"model": "rigid"},
      "bodies": [{"name": "a", "polygon": [[0, 0], [1, 0], [0, 1]], "material": "m"}]})");
  CHECK(scene.contact.component == nullptr);
  CHECK(scene.bodies[0].cover.component->component->name == std::string("rigid"));
}

TEST_CASE("comments may stand anywhere", "[scene]") {
  CHECK(sample::mistakes(std::string("// what it shows\n/* and why */ ") + sample::good + "// end").empty());
}

TEST_CASE("supports, starts and drives arrive in SI", "[scene]") {
  const Scene scene =
      sample::read(sample::good_but("\"material\": \"rock\"",
                                    "\"material\": \"rock\", \"fix\": [\"y\"], \"drive\": {\"rotation\": "
                                    "90}, \"velocity\": [3, 0], \"angular_velocity\": 90, \"priority\": 2"));
  const SceneBody& body = scene.bodies[1];
  CHECK_FALSE(body.support.x.has_value());
  CHECK(body.support.y == 0.0);
  CHECK(*body.support.rotation == Approx(90 * degree));
  CHECK(body.velocity.x == 3);
  CHECK(body.angular_velocity == Approx(90 * degree));
  CHECK(body.priority == 2);
}

TEST_CASE("an unasked history is a 500th of the run, and divides the interval of the frames", "[scene]") {
  const auto history = [](const char* output) {
    return sample::read(sample::good_but("{\"end\": 5}", "{\"end\": 7}, \"output\": " + std::string(output)))
        .output.history;
  };
  CHECK(history("{}") == 0.014);
  CHECK(history("{\"frames\": 0.1}") == Approx(0.0125));
  CHECK(history("{\"frames\": 0.14}") == Approx(0.014));
}

TEST_CASE("the resolved scene spells out every default", "[scene]") {
  const json resolved = json::parse(sample::read(sample::good).resolved);
  CHECK(resolved["time"] == json({{"end", 5}, {"dt", "auto"}, {"safety", 0.2}}));
  CHECK(resolved["origin"] == json({0, 0}));
  CHECK(resolved["contact"] == json({{"model", "shear"},
                                     {"roles", "symmetric"},
                                     {"shear", {{"friction_rule", "paper"}, {"strict", false}}}}));
  CHECK(resolved["cover"] == json({{"model", "block"}, {"tilt", 0}}));
  CHECK(resolved["materials"]["rock"]["poisson_ratio"] == 0.25);
  CHECK(resolved["interfaces"][0] == json({{"between", {"*", "*"}},
                                           {"normal_stiffness", 1e10},
                                           {"friction_angle", 20},
                                           {"normal_damping", 0.3},
                                           {"cohesion", 0},
                                           {"dilation", 5}}));
  CHECK(resolved["bodies"][1]["velocity"] == json({0, 0}));
  CHECK(resolved["output"]["history"] == 0.01);
  CHECK(resolved["limits"]["penetration"] == 0.3);
  CHECK(resolved["monitors"][0]["quantities"].size() == 6);
}

TEST_CASE("the resolved scene reads again as the same scene", "[scene]") {
  const ReadOptions options{
      {{"/output", "{\"frames\": 0.3}"},
       {"/settle", "{\"duration\": 0.5, \"damping\": 300}"},
       {"/bodies/1/surfaces", "{\"base\": [0], \"side\": [1, 3]}"},
       {"/bodies/1/drive", "{\"rotation\": 7}"},
       {"/prescribed",
        "[{\"body\": \"block\", \"surface\": \"side\", \"stiffness\": 1e12, \"velocity\": [null, 1]}]"},
       {"/tolerances", "[{\"monitor\": \"block\", \"quantity\": \"ux\", \"rms\": 1}]"}},
      false};
  const Scene first = sample::read(sample::good, options);
  const Scene second = sample::read(first.resolved);
  CHECK(second.resolved == first.resolved);
  CHECK(second.interface_values == first.interface_values);
  CHECK(second.interface_row == first.interface_row);
  CHECK(second.surfaces.size() == first.surfaces.size());
  CHECK(second.contact.values == first.contact.values);
  CHECK(second.output.history == first.output.history);
  CHECK(second.bodies[1].outer.surface_class == first.bodies[1].outer.surface_class);
  CHECK(second.bodies[1].support.rotation == first.bodies[1].support.rotation);
  CHECK(second.prescribed[0].surface_class == first.prescribed[0].surface_class);
  CHECK_FALSE(second.prescribed[0].velocity[0].has_value());
  CHECK((*second.prescribed[0].velocity[1])(7, {}) == 1.0);
  CHECK(second.tolerances[0].rms == 1.0);
}

TEST_CASE("prescribed surfaces find their class", "[scene]") {
  const Scene scene = sample::read(sample::good, {{{"/bodies/1/surfaces", "{\"left\": [3]}"},
                                                   {"/prescribed",
                                                    "[{\"body\": \"block\", \"surface\": \"left\", "
                                                    "\"stiffness\": 1e12, \"displacement\": [0.1, null]}]"}},
                                                  false});
  CHECK(scene.surfaces[scene.prescribed[0].surface_class].surface == "left");
  CHECK((*scene.prescribed[0].displacement[0])(7, {}) == 0.1);
  CHECK_FALSE(scene.prescribed[0].displacement[1].has_value());
}

TEST_CASE("the order of keys in the file has no meaning", "[scene]") {
  const json shuffled = json::parse(sample::good);  // sorted by key
  CHECK(sample::read(shuffled.dump()).resolved == sample::read(sample::good).resolved);
}

TEST_CASE("a library that is loaded already needs no permission", "[scene]") {
  Registry registry = sample::registry();
  const std::string text =
      sample::good_but("\"talus\": 1,", "\"talus\": 1, \"plugins\": [\"../nowhere/libsample.so\"],");
  const Scene scene = read_scene_text(text, "/elsewhere/scene.json", registry);
  CHECK(json::parse(scene.resolved)["plugins"] == json({"/nowhere/libsample.so"}));
}

TEST_CASE("an allowed library that does not exist is the plugin's error", "[scene]") {
  Registry registry = sample::registry();
  const std::string text =
      sample::good_but("\"talus\": 1,", "\"talus\": 1, \"plugins\": [\"./libnone.so\"],");
  CHECK_THROWS_AS(read_scene_text(text, "/elsewhere/scene.json", registry, {{}, true}), PluginError);
}
