// What must hold of the cover my_component, however it is laid.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

#include <talus/testing/component.hpp>

#include <array>
#include <string>

extern "C" const talus::Library talus_library;

namespace {

struct Element {
  std::array<std::uint32_t, 3> patches;
  std::vector<double> x, y;  ///< vertices of all rings
  double area;
};

/// Keeps what a builder makes.
class Record final : public talus::CoverSink {
 public:
  std::vector<std::array<double, 2>> patches;
  std::vector<Element> elements;
  std::string refusal;

  std::uint32_t add_patch(double x, double y) noexcept override {
    patches.push_back({x, y});
    return static_cast<std::uint32_t>(patches.size() - 1);
  }
  std::uint32_t add_element(const std::uint32_t of[3], const talus::Region& region) noexcept override {
    Element element{{of[0], of[1], of[2]}, {}, {}, 0};
    for (std::uint32_t r = 0; r < region.ring_count; ++r) {
      const std::uint32_t begin = region.ring_start[r], end = region.ring_start[r + 1];
      for (std::uint32_t i = begin; i < end; ++i) {
        const std::uint32_t next = i + 1 == end ? begin : i + 1;
        element.x.push_back(region.x[i]);
        element.y.push_back(region.y[i]);
        element.area += (region.x[i] * region.y[next] - region.x[next] * region.y[i]) / 2;
      }
    }
    elements.push_back(element);
    return static_cast<std::uint32_t>(elements.size() - 1);
  }
  void add_boundary_vertex(double, double, std::uint32_t, std::uint32_t) noexcept override {}
  void close_boundary_loop() noexcept override {}
  void steady_patch(std::uint32_t, const std::uint32_t[3], const double[3], double) noexcept override {}
  void scale_strain_mass(double) noexcept override {}
  void make_rigid() noexcept override {}
  void refuse(const char* why) noexcept override { refusal = why; }
};

/// A rectangle of 2 x 1 m about its centre.
struct Rectangle {
  double x[4] = {-1, 1, 1, -1}, y[4] = {-0.5, -0.5, 0.5, 0.5};
  std::uint32_t ring_start[2] = {0, 4};
  std::uint32_t line_start[2] = {0, 2};
  talus::BodyShape shape{{x, y, ring_start, 1}, {2, 0, 0, 2 / 3.0, 0, 1 / 6.0}, {x, y, line_start, 0}, {}};
};

Record covered(const talus::BodyShape& shape) {
  Record record;
  talus::testing::make<talus::CoverBuilder>(talus_library, "my_component")->build(shape, record);
  return record;
}

}  // namespace

TEST_CASE("The elements have the area of the body and name patches that exist") {
  const Record record = covered(Rectangle().shape);
  REQUIRE(!record.elements.empty());
  double area = 0;
  for (const Element& element : record.elements) {
    area += element.area;
    for (const std::uint32_t patch : element.patches) CHECK(patch < record.patches.size());
  }
  CHECK(area == Approx(2));
}

TEST_CASE("The weights of an element add up to one and reproduce positions") {
  const Record record = covered(Rectangle().shape);
  for (const Element& element : record.elements) {
    const auto &p = record.patches[element.patches[0]], &q = record.patches[element.patches[1]],
               &r = record.patches[element.patches[2]];
    const double twice = (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
    REQUIRE(twice > 0);  // counter-clockwise
    for (std::size_t i = 0; i < element.x.size(); ++i) {
      const double x = element.x[i], y = element.y[i];
      const double at_q = ((x - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (y - p[1])) / twice;
      const double at_r = ((q[0] - p[0]) * (y - p[1]) - (x - p[0]) * (q[1] - p[1])) / twice;
      const double at_p = 1 - at_q - at_r;
      CHECK(at_p * p[0] + at_q * q[0] + at_r * r[0] == Approx(x));
      CHECK(at_p * p[1] + at_q * q[1] + at_r * r[1] == Approx(y));
      // within the triangle of the star points: no weight is negative
      CHECK(at_p >= -1e-12);
      CHECK(at_q >= -1e-12);
      CHECK(at_r >= -1e-12);
    }
  }
}

TEST_CASE("A body that is cut is refused in words") {
  Rectangle rectangle;
  rectangle.shape.discontinuities.line_count = 1;
  CHECK(covered(rectangle.shape).refusal != "");
}
