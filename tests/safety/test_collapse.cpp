#include "safety/collapse.hpp"

#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace {

/// Of one piece that never was farther.
PieceMotions motions(double moved, double way, double speed, double time) {
  return {{moved}, {way}, {speed}, {way}, time};
}

}  // namespace

TEST_CASE("A piece that slows down goes on until it rests or has come far", "[safety]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.bodies = box("table", -3, -1, 3, 0, R"("fixed": true)") + ", " + box("a", 0, 0, 1, 1);
  const Pieces pieces(Simulation(text.read(), {}));
  REQUIRE(pieces.all().size() == 1);
  REQUIRE(pieces.all()[0].width == Approx(1));
  struct Case {
    double moved_middle, speed_middle, moved_end, speed_end;  // m, m/s
    Course due;
  };
  for (const Case& c : {Case{0.01, 0.1, 0.02, 0.1, Course::failed},       // at a steady speed
                        Case{0.01, 0.1, 0.016, 0.05, Course::goes_on},    // at half of it
                        Case{0.01, 0.1, 0.012, 0.05, Course::rests},      // hardly any way in the second half
                        Case{0.01, 0.1, 0.016, 0.01, Course::rests},      // nearly at rest
                        Case{0.03, 0.1, 0.06, 0.01, Course::failed},      // far
                        Case{0.06, 0.1, 0.06, 0, Course::stopped},        // and then at rest
                        Case{0.0001, 0.1, 0.0002, 0.1, Course::goes_on},  // steady, too little to tell
                        Case{0.0001, 0.1, 0.00016, 0.05, Course::rests},  // slower, and too little to tell
                        Case{0.0005, 0.002, 0.0007, 0.002, Course::goes_on},  // steady, after it gave way
                        Case{0.0100, 0.012, 0.0112, 0.012, Course::failed},   // steady, far since then
                        Case{0.0005, 0.1, 0.0007, 0.1, Course::rests}}) {     // vibrating
    INFO(c.moved_end << " m, " << c.speed_end << " m/s");
    CHECK(pieces.course(0, motions(c.moved_middle, c.moved_middle, c.speed_middle, 0.1),
                        motions(c.moved_end, c.moved_end, c.speed_end, 0.2), false) == c.due);
    // What it moved while it settled hides nothing, and is far enough by itself.
    if (c.due == Course::failed || c.due == Course::stopped) continue;
    CHECK(pieces.course(0, motions(0.02 + c.moved_middle, c.moved_middle, c.speed_middle, 0.1),
                        motions(0.02 + c.moved_end, c.moved_end, c.speed_end, 0.2), false) == c.due);
  }
  // What loses some of its speed may come to rest: it fails at the last look.
  const PieceMotions middle = motions(0.01, 0.01, 0.1, 0.1), end = motions(0.0195, 0.0195, 0.095, 0.2);
  CHECK(pieces.course(0, middle, end, false) == Course::goes_on);
  CHECK(pieces.course(0, middle, end, true) == Course::failed);
  // What was farther before swings, and does not fail until it has come far.
  for (const bool last : {false, true}) {
    PieceMotions back = motions(0.02, 0.02, 0.1, 0.2);
    back.farthest = {0.021};
    CHECK(pieces.course(0, middle, back, last) == Course::goes_on);
    back.moved = {0.06};
    CHECK(pieces.course(0, middle, back, last) == Course::failed);
  }
}
