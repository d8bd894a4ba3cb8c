// A contact law built outside the tree, against the plugin kit alone, as a stranger would.
#include "plugin/descriptors.hpp"

#include <catch2/catch.hpp>

#include <unistd.h>

#include <array>
#include <cstdlib>

using namespace talus;

namespace fs = std::filesystem;

namespace {

/// Two pieces of four corners: a unit square (body a) and a square on its tip (body b), whose lowest corner
/// is `depth` below the top of the first, at a quarter of its width.
struct TwoSquares {
  static constexpr double half = 0.70710678118654752;  // cosine of 45 degrees
  std::array<BoundaryCorner, 8> corners{{{0, 0, 1, 0, 0, 0, 1, 0, 0},
                                         {1, 0, 0, 1, 0, 0, 1, 0, 0},
                                         {1, 1, -1, 0, 0, 0, 1, 0, 0},
                                         {0, 1, 0, -1, 0, 0, 1, 0, 0},
                                         {0, -1, half, half, 0, 0, 2 * half, 0, 0},
                                         {1, 0, -half, half, 0, 0, 2 * half, 0, 0},
                                         {0, 1, -half, -half, 0, 0, 2 * half, 0, 0},
                                         {-1, 0, half, -half, 0, 0, 2 * half, 0, 0}}};
  std::array<std::uint32_t, 3> piece_start{0, 4, 8};
  std::array<std::uint8_t, 2> is_strip{};
  std::uint32_t row = 0;
  double stiffness = 3e6;
  PiecePair pieces{0, 1, 0};
  BodyPair pair{};
  std::array<double, 8> fx{}, fy{};
  std::array<ContactReport, 4> reports{};
  PairReport report{};
  double clear_depth = 0;
  std::uint32_t active = 0;

  explicit TwoSquares(double depth) {
    pair.b = 1;
    pair.piece_pair_end = 1;
    pair.offset_x = 0.25;
    pair.offset_y = 2 - depth;
    pair.master_share = 0.5;
    pair.slot_capacity = 4;
  }

  void evaluate(const ContactModel& law) {
    fx = fy = {};
    report = {};
    ContactBatch batch{};
    batch.boundaries = {corners.data(), piece_start.data(), is_strip.data(), &clear_depth};
    batch.interfaces = {&row, &stiffness, 1, 1};
    batch.pairs = &pair;
    batch.piece_pairs = &pieces;
    batch.active = &active;
    batch.active_count = 1;
    batch.dt = 1e-4;
    law.evaluate(batch, {fx.data(), fy.data(), nullptr, reports.data(), &report});
  }
};

}  // namespace

TEST_CASE("A law built outside the tree loads and pushes", "[plugin]") {
  const fs::path build = fs::temp_directory_path() / ("talus-outside." + std::to_string(getpid()));
  const std::string command = std::string("'" TALUS_CMAKE "' -S '" TALUS_OUTSIDE "' -B '") + build.string() +
                              "' -G Ninja -DTALUS_KIT='" TALUS_KIT "' > /dev/null && '" TALUS_CMAKE
                              "' --build '" +
                              build.string() + "' > /dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
  Registry registry;
  load_library(registry, build / "libsoft_corner.so");
  const RegisteredComponent* entry = registry.find(ComponentKind::contact_model, "soft_corner");
  REQUIRE(entry != nullptr);
  CHECK(std::string(entry->library->author) == "somebody else");
  CHECK(std::string(entry->component->interface_parameters[0].key) == "normal_stiffness");

  const auto law = make<ContactModel>(*entry, {});
  CHECK(law->doubles_per_contact() == 0);
  TwoSquares squares(0.1);
  squares.evaluate(*law);
  CHECK(squares.report.contact_count == 1);
  CHECK(squares.report.penetration == Approx(0.1));
  CHECK(squares.reports[0].py == Approx(3e6 * 0.01));
  CHECK(squares.fy[4] == Approx(3e4));          // the lowest corner of b goes up
  CHECK(squares.fy[2] == Approx(-3e4 * 0.25));  // the ends of a's top side bear it, the nearer one more
  CHECK(squares.fy[3] == Approx(-3e4 * 0.75));

  double sum_x = 0, sum_y = 0, moment = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const double px = squares.corners[i].x + (i < 4 ? 0 : squares.pair.offset_x);
    const double py = squares.corners[i].y + (i < 4 ? 0 : squares.pair.offset_y);
    sum_x += squares.fx[i];
    sum_y += squares.fy[i];
    moment += px * squares.fy[i] - py * squares.fx[i];
  }
  CHECK(std::abs(sum_x) < 1e-8);
  CHECK(std::abs(sum_y) < 1e-8);
  CHECK(std::abs(moment) < 1e-8);

  TwoSquares deeper(0.1 + 1e-6), shallower(0.1 - 1e-6);
  deeper.evaluate(*law);
  shallower.evaluate(*law);
  CHECK((deeper.report.stored - shallower.report.stored) / 2e-6 == Approx(3e4));
  fs::remove_all(build);  // the library stays mapped
}
