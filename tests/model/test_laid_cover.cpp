#include "model/laid_cover.hpp"
#include "model/model.hpp"
#include "scene/read.hpp"
#include "simulation/working_scene.hpp"

#include <talus/cover_builder.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

/// What is wrong with a cover of the unit square by two triangles.
enum class Flaw {
  none,
  refuses,
  refuses_without_words,
  empty,
  unknown_patch,
  half_the_area,
  no_boundary,
  boundary_elsewhere,
  boundary_reversed,
  boundary_without_corner,
  short_loop,
  unknown_element,
  unknown_side,
  steadies_nothing,
  steadies_itself,
  steadies_by_nothing,
  steadies_lightly
};

Flaw flaw = Flaw::none;  // a builder has no other way to be told

class FlawedCover final : public CoverBuilder {
 public:
  void build(const BodyShape& body, CoverSink& sink) const noexcept override {
    if (flaw == Flaw::refuses) sink.refuse("squares are too plain");
    if (flaw == Flaw::refuses_without_words) sink.refuse(nullptr);
    if (flaw == Flaw::refuses || flaw == Flaw::refuses_without_words || flaw == Flaw::empty) return;
    for (std::uint32_t i = 0; i < 4; ++i) sink.add_patch(body.outline.x[i], body.outline.y[i]);
    add_half(body, sink, {0, 1, 2}, {0, 1, flaw == Flaw::unknown_patch ? 9U : 2U});
    if (flaw != Flaw::half_the_area) add_half(body, sink, {0, 2, 3}, {0, 2, 3});
    if (flaw == Flaw::steadies_nothing) {
      const std::uint32_t to[] = {0, 1, 7};
      const double weights[] = {1, 0, 0};
      sink.steady_patch(3, to, weights, 0);
    }
    if (flaw == Flaw::steadies_itself) {
      const std::uint32_t to[] = {0, 3, 2};
      const double weights[] = {0, 1, 0};
      sink.steady_patch(3, to, weights, 1);
    }
    if (flaw == Flaw::steadies_by_nothing || flaw == Flaw::steadies_lightly) {
      const bool lightly = flaw == Flaw::steadies_lightly;
      const std::uint32_t to[] = {0, 1, 2};
      const double weights[] = {lightly ? 1 : std::numeric_limits<double>::quiet_NaN(), 0, 0};
      sink.steady_patch(3, to, weights, lightly ? -0.5 : 1);
    }
    if (flaw == Flaw::no_boundary) return;
    const std::uint32_t corners = flaw == Flaw::short_loop                ? 2
                                  : flaw == Flaw::boundary_without_corner ? 3
                                                                          : 4;
    const double aside = flaw == Flaw::boundary_elsewhere ? 10 : 0;
    for (std::uint32_t k = 0; k < corners; ++k) {
      const std::uint32_t i = flaw == Flaw::boundary_reversed ? 3 - k : k;
      const std::uint32_t element = flaw == Flaw::unknown_element ? 2 : i < 2 ? 0 : 1;
      const std::uint32_t side = flaw == Flaw::boundary_reversed ? (i + 3) % 4 : i;
      sink.add_boundary_vertex(body.outline.x[i] + aside, body.outline.y[i], element,
                               flaw == Flaw::unknown_side ? 4 : side);
    }
    sink.close_boundary_loop();
  }

 private:
  static void add_half(const BodyShape& body, CoverSink& sink, const std::array<std::uint32_t, 3>& corners,
                       const std::array<std::uint32_t, 3>& patches) {
    double x[3], y[3];
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = body.outline.x[corners[i]];
      y[i] = body.outline.y[corners[i]];
    }
    const std::uint32_t start[] = {0, 3};
    sink.add_element(patches.data(), {x, y, start, 1});
  }
};

const Component flawed_component = [] {
  Component component{};
  component.kind = ComponentKind::cover_builder;
  component.name = "flawed";
  component.sentence = "Covers squares, but for one flaw.";
  component.create = [](const double*, char*, std::size_t) noexcept -> void* {
    return static_cast<CoverBuilder*>(new FlawedCover);
  };
  component.destroy = [](void* made) noexcept { delete static_cast<CoverBuilder*>(made); };
  return component;
}();

/// Why a cover with this flaw is refused; "" if it is taken.
template <class Refusal>
std::string refusal_with(Flaw one) {
  static const RegisteredComponent component{&flawed_component, nullptr, "/plugins/libflawed.so"};
  WorkingScene text;
  text.bodies = box("square", 0, 0, 1, 1);
  Scene scene = text.read();
  scene.bodies[0].cover = {&component, {}};
  flaw = one;
  try {
    build_model(scene);
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A cover that does not fit its body is refused, and the library, the body and the fault are named",
          "[model][cover]") {
  CHECK(refusal_with<std::runtime_error>(Flaw::none) == "");
  const struct {
    Flaw flaw;
    const char* words;
  } faults[] = {
      {Flaw::empty, "it made no element"},
      {Flaw::unknown_patch, "an element names patch 9 of 4"},
      {Flaw::half_the_area, "its elements have an area of 0.5 m2, the body has 1 m2"},
      {Flaw::no_boundary, "it has 2 elements and 4 patches, which takes a boundary, and gave none"},
      {Flaw::boundary_elsewhere,
       "its boundary at (9.5, -0.5) m from the centroid is 10 m off side 0, which it is to follow"},
      {Flaw::boundary_reversed, "its boundary surrounds -1 m2, the body has 1 m2"},
      {Flaw::boundary_without_corner,
       "its boundary at (0.5, 0.5) m from the centroid is 1 m off side 2, which it is to follow"},
      {Flaw::short_loop, "a loop of its boundary has 2 vertices"},
      {Flaw::unknown_element, "a boundary vertex names element 2 of 2 and side 0 of 4"},
      {Flaw::unknown_side, "a boundary vertex names element 0 of 2 and side 4 of 4"},
      {Flaw::steadies_nothing, "it steadies a patch that does not exist"},
      {Flaw::steadies_itself, "patch 3 is to follow patch 3, which is steadied itself"},
      {Flaw::steadies_by_nothing, "patch 3 is to follow others with weights of nan in all, not 1"},
      {Flaw::steadies_lightly, "patch 3 is to get the inertia of -0.5 m2, which takes more than 0"}};
  for (const auto& fault : faults) {
    CHECK_THAT(refusal_with<PluginError>(fault.flaw),
               Contains("/plugins/libflawed.so: cover 'flawed' does not fit body 'square': ") &&
                   Contains(fault.words));
  }
}

TEST_CASE("A body that its cover refuses is told with the cover's own words", "[model][cover]") {
  CHECK(refusal_with<SceneError>(Flaw::refuses) ==
        "working.json: /bodies/0: body 'square' cannot have the cover 'flawed': squares are too plain");
  CHECK_THAT(refusal_with<SceneError>(Flaw::refuses_without_words), Contains("it does not say why"));
}

TEST_CASE("A needle whose area is little more than rounding gets a cover all the same", "[model][cover]") {
  WorkingScene text;
  text.cover = "block";
  text.bodies = R"({"name": "needle", "material": "rock", "polygon": [[5.571428917683737, 7.428571890459266],
      [5.999999999363636, 7.999999996818182], [6, 8]]})";
  CHECK_NOTHROW(build_model(text.read()));
}
