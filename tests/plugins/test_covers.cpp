#include "geometry/polygon.hpp"
#include "plugin/registry.hpp"
#include "simulation/working_scene.hpp"

#include <talus/cover_builder.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace talus;

namespace {

/// Writes down what a builder makes.
class CoverNotes final : public CoverSink {
 public:
  std::uint32_t add_patch(double x, double y) noexcept override {
    stars.push_back({x, y});
    return static_cast<std::uint32_t>(stars.size() - 1);
  }
  std::uint32_t add_element(const std::uint32_t patches[3], const Region& region) noexcept override {
    elements.push_back({patches[0], patches[1], patches[2]});
    AreaMoments sum{};
    for (std::uint32_t r = 0; r < region.ring_count; ++r) {
      Ring ring;
      for (std::uint32_t i = region.ring_start[r]; i < region.ring_start[r + 1]; ++i)
        ring.push_back({region.x[i], region.y[i]});
      sum = sum + ring_moments(ring, {0, 0});
    }
    regions.push_back(sum);
    return static_cast<std::uint32_t>(elements.size() - 1);
  }
  void add_boundary_vertex(double, double, std::uint32_t, std::uint32_t) noexcept override { ++boundary; }
  void close_boundary_loop() noexcept override { ++boundary; }
  void steady_patch(std::uint32_t, const std::uint32_t[3], const double[3], double) noexcept override {
    ++steadied;
  }
  void refuse(const char* why) noexcept override { refusal = why; }
  void scale_strain_mass(double factor) noexcept override {
    scale = factor;
    ++scaled;
  }
  void make_rigid() noexcept override { ++rigid; }

  std::vector<Vec2> stars;
  std::vector<std::array<std::uint32_t, 3>> elements;
  std::vector<AreaMoments> regions;
  int rigid = 0, boundary = 0, steadied = 0, scaled = 0;
  double scale = 1;
  std::string refusal;
};

Made<CoverBuilder> builder(const char* name, const std::vector<double>& values) {
  const RegisteredComponent* found = shipped_registry().find(ComponentKind::cover_builder, name);
  REQUIRE(found != nullptr);
  REQUIRE(found->component->parameter_count == values.size());
  return make<CoverBuilder>(*found, values);
}

/// Outline of a ring about its centroid.
struct Drawn {
  std::vector<double> x, y;
  std::vector<std::uint32_t> loop_start;
  AreaMoments moments;

  explicit Drawn(Ring ring) {
    const AreaMoments m = ring_moments(ring, {0, 0});
    for (Vec2& p : ring) p = {p.x - m.x / m.area, p.y - m.y / m.area};
    moments = ring_moments(ring, {0, 0});
    for (const Vec2 p : ring) x.push_back(p.x), y.push_back(p.y);
    loop_start = {0, static_cast<std::uint32_t>(ring.size())};
  }

  BodyShape shape() const { return {{x.data(), y.data(), loop_start.data(), 1}, moments, {}, {}}; }

  /// The same with a line through it.
  BodyShape cut() const {
    static constexpr double line_x[] = {-20, 20}, line_y[] = {0, 0};
    static constexpr std::uint32_t line_start[] = {0, 2};
    BodyShape result = shape();
    result.discontinuities = {line_x, line_y, line_start, 1};
    return result;
  }
};

double distance(Vec2 p, Vec2 q) {
  return std::hypot(p.x - q.x, p.y - q.y);
}

const std::vector<Ring> rings{
    {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
    {{0, 0}, {14, 0}, {14, 0.2}, {0, 0.2}},
    {{3, 3}, {6, 3}, {6, 4}, {4, 4}, {4, 6}, {3, 6}},
    {{-1, 0}, {5, -2}, {0, 9}},
};

}  // namespace

TEST_CASE("a block is one element of three patches on a regular triangle around the body",
          "[plugins][block]") {
  for (const Ring& ring : rings) {
    const Drawn drawn(ring);
    CoverNotes notes;
    const auto block = builder("block", {1});
    block->build(drawn.shape(), notes);
    CHECK(notes.rigid == 0);
    REQUIRE(notes.stars.size() == 3);
    REQUIRE(notes.elements.size() == 1);
    CHECK(notes.elements[0] == std::array<std::uint32_t, 3>{0, 1, 2});

    const Vec2 a = notes.stars[0], b = notes.stars[1], c = notes.stars[2];
    CHECK(distance(a, b) == Approx(distance(b, c)));
    CHECK(distance(b, c) == Approx(distance(c, a)));
    CHECK(a.x + b.x + c.x == Approx(0).margin(1e-12));
    CHECK(a.y + b.y + c.y == Approx(0).margin(1e-12));
    CHECK((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0);

    // Every vertex lies in the triangle: no weight is negative.
    for (std::size_t i = 0; i < drawn.x.size(); ++i) {
      for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        const double inside = (q.x - p.x) * (drawn.y[i] - p.y) - (q.y - p.y) * (drawn.x[i] - p.x);
        CHECK(inside >= -1e-12 * distance(p, q) * distance(p, q));
      }
    }

    const AreaMoments& region = notes.regions[0];
    CHECK(region.area == Approx(drawn.moments.area).epsilon(1e-14));
    CHECK(region.xx == Approx(drawn.moments.xx).epsilon(1e-12));
    CHECK(region.xy == Approx(drawn.moments.xy).margin(1e-12 * drawn.moments.xx));
    CHECK(region.yy == Approx(drawn.moments.yy).epsilon(1e-12));
  }
}

TEST_CASE("a rigid cover asks for a rigid body and nothing else", "[plugins][rigid]") {
  for (const Ring& ring : rings) {
    const Drawn drawn(ring);
    CoverNotes notes;
    builder("rigid", {})->build(drawn.shape(), notes);
    CHECK(notes.rigid == 1);
    CHECK(notes.stars.empty());
    CHECK(notes.elements.empty());
  }
}

TEST_CASE("a block and a rigid body cannot be cut by discontinuities", "[plugins][block][rigid]") {
  for (const auto& [name, values] :
       {std::pair{"block", std::vector<double>{1}}, std::pair{"rigid", std::vector<double>{}}}) {
    CoverNotes notes;
    builder(name, values)->build(Drawn(rings[0]).cut(), notes);
    CHECK(notes.refusal.find("cut by discontinuities") != std::string::npos);
    CHECK(notes.elements.empty());
    CHECK(notes.rigid == 0);
  }
}

TEST_CASE("a block says how heavy its strain is, where that is not as it is", "[plugins][block]") {
  const Drawn drawn(rings[2]);
  CoverNotes plain, heavy;
  builder("block", {1})->build(drawn.shape(), plain);
  builder("block", {4})->build(drawn.shape(), heavy);
  CHECK(plain.scaled == 0);
  CHECK(heavy.scaled == 1);
  CHECK(heavy.scale == 4);
  CHECK(heavy.stars.size() == 3);
}
