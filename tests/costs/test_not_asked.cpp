#include "libraries/counting.hpp"
#include "scene/read.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <string>

using namespace talus;

namespace {

constexpr const char* counting_library = TALUS_TEST_LIBRARIES "/libcounting.so";
constexpr std::uint64_t steps = 200;

Registry& counting_registry() {
  static Registry registry = [] {
    Registry all;
    load_folders(all, std::array{std::filesystem::path(TALUS_PLUGINS)});
    load_library(all, counting_library);
    return all;
  }();
  return registry;
}

/// Of the library that is loaded.
AskedSoFar& asked() {
  counting_registry();
  void* handle = dlopen(counting_library, RTLD_NOW | RTLD_NOLOAD);
  REQUIRE(handle != nullptr);
  void* counts = dlsym(handle, "talus_test_asked");
  REQUIRE(counts != nullptr);
  return *static_cast<AskedSoFar*>(counts);
}

/// A scene of the counting law and material that takes 200 steps; `counting` bodies with the law's kin.
WorkingScene counting_scene(const std::string& bodies, const std::string& cover) {
  WorkingScene text;
  text.bodies = bodies;
  text.gravity = "[0, -10]";
  text.law = "counting";
  text.cover = cover;
  text.material = R"("density": 2000, "model": "counting")";
  text.time = R"({"end": 0.02, "dt": 1e-4})";
  text.output = R"({"history": 0.02})";
  return text;
}

struct Course {
  AskedSoFar asked;
  std::string last_motion;
};

/// What a run asks for from the first step on, and where the first body got to.
Course course_of(const WorkingScene& text) {
  Simulation simulation(text.read(counting_registry()), {});
  asked() = {};
  while (simulation.advance()) {
  }
  CHECK(simulation.summary().steps == steps);
  const AskedSoFar in_steps = asked();
  const Motion motion = simulation.body_motion(0);
  return {in_steps, std::to_string(motion.position.y) + " " + std::to_string(motion.velocity.y)};
}

std::string falling_block() {
  return box("block", 0, 0, 1, 1);
}

/// Fixed bodies in a row that the block does not come near.
std::string with_fixed_bodies(const std::string& bodies, int count) {
  std::string all = bodies;
  for (int i = 0; i < count; ++i)
    all += "," + box("fixed" + std::to_string(i), 20 + 2 * i, 0, 21 + 2 * i, 1, R"("fixed": true)");
  return all;
}

}  // namespace

TEST_CASE("One free block takes no contact step at all", "[costs]") {
  const Course course = course_of(counting_scene(falling_block(), "block"));
  CHECK(course.asked.law == 0);
  CHECK(course.asked.material == steps + 1);  // and once at t = 0
  CHECK(course.asked.elements == steps + 1);
}

TEST_CASE("What touches nothing is not asked of a law; what may touch is", "[costs]") {
  const Course apart = course_of(counting_scene(falling_block() + "," + box("other", 5, 0, 6, 1), "block"));
  CHECK(apart.asked.law == 0);
  const Course near = course_of(counting_scene(falling_block() + "," + box("other", 1.01, 0, 2, 1), "block"));
  CHECK(near.asked.law == steps + 1);
  CHECK(near.asked.pairs == steps + 1);
}

/// Two blocks one millimetre apart, the one behind at 20 m/s, and a third that goes another way.
WorkingScene distant_scene(double speed_of_other, const std::string& more = {}) {
  const std::string other = R"("velocity": [)" + std::to_string(speed_of_other) + ", 0]";
  WorkingScene text = counting_scene(box("block", 0, 0, 1, 1, R"("velocity": [20, 0])" + more) + "," +
                                         box("other", 1.001, 0, 2, 1, other + more) + "," +
                                         box("third", -50, 0, -49, 1, R"("velocity": [0, 20])"),
                                     "rigid");
  text.law = "distant";
  return text;
}

TEST_CASE("Neighbours that move along with each other are seldom asked about, however fast they are",
          "[costs]") {
  const Course along = course_of(distant_scene(20));
  CHECK(along.asked.pairs < steps / 10);
  // While both turn, two corners may close in at 1.4 m/s.
  const Course spinning = course_of(distant_scene(20, R"(, "angular_velocity": 30)"));
  CHECK(spinning.asked.pairs > along.asked.pairs);
  CHECK(spinning.asked.pairs < steps / 5);
}

TEST_CASE("A gap that closes is asked about before it may be closed", "[costs]") {
  // 20 mm in all, of which each look allows one.
  const Course closing = course_of(distant_scene(19));
  CHECK(closing.asked.pairs >= 20);
  CHECK(closing.asked.pairs < steps / 2);
}

TEST_CASE("A body that does not deform is not asked of its material", "[costs]") {
  const Course rigid = course_of(counting_scene(falling_block(), "rigid"));
  CHECK(rigid.asked.material == 0);
  const Course counting = course_of(counting_scene(falling_block(), "counting"));
  CHECK(counting.asked.material == 0);
  CHECK(counting.asked.cover == 0);  // bodies are covered once, before the first step
}

TEST_CASE("Fixed bodies ask for nothing and are not covered", "[costs]") {
  const WorkingScene many = counting_scene(with_fixed_bodies(falling_block(), 300), "counting");
  asked() = {};
  const Simulation laid(many.read(counting_registry()), {});
  CHECK(asked().cover == 1);

  const Course alone = course_of(counting_scene(falling_block(), "block"));
  const Course among = course_of(counting_scene(with_fixed_bodies(falling_block(), 300), "block"));
  CHECK(among.asked.law == 0);
  CHECK(among.asked.material == alone.asked.material);
  CHECK(among.asked.elements == alone.asked.elements);
  CHECK(among.last_motion == alone.last_motion);
}

TEST_CASE("What sleeps is asked of neither law nor material", "[costs]") {
  WorkingScene text = counting_scene(falling_block() + "," + box("other", 1.01, 0, 2, 1), "block");
  text.gravity = "[0, 0]";
  const Course awake = course_of(text);
  CHECK(awake.asked.pairs == steps + 1);
  text.rest += R"("sleep": {"after": 0.005},)";
  const Course asleep = course_of(text);
  CHECK(asleep.asked.law < steps / 2);  // not even about none of its pairs
  CHECK(asleep.asked.pairs < steps / 2);
  CHECK(asleep.asked.material < steps / 2);
}
