#include "geometry/polygon.hpp"
#include "plugin/registry.hpp"
#include "simulation/working_scene.hpp"

#include <talus/cover_builder.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

using namespace talus;

namespace {

/// Writes down what a builder makes.
class MeshNotes final : public CoverSink {
 public:
  struct BoundaryVertex {
    Vec2 at;
    std::uint32_t element, side;
  };

  std::uint32_t add_patch(double x, double y) noexcept override {
    stars.push_back({x, y});
    return static_cast<std::uint32_t>(stars.size() - 1);
  }
  std::uint32_t add_element(const std::uint32_t patches[3], const Region& region) noexcept override {
    elements.push_back({patches[0], patches[1], patches[2]});
    Ring ring;
    for (std::uint32_t i = 0; i < region.ring_start[region.ring_count]; ++i) {
      ring.push_back({region.x[i], region.y[i]});
    }
    regions.push_back(ring);
    return static_cast<std::uint32_t>(elements.size() - 1);
  }
  void add_boundary_vertex(double x, double y, std::uint32_t element, std::uint32_t side) noexcept override {
    open.push_back({{x, y}, element, side});
  }
  void close_boundary_loop() noexcept override {
    loops.push_back(open);
    open.clear();
  }
  void steady_patch(std::uint32_t, const std::uint32_t[3], const double[3], double) noexcept override {
    ++steadied;
  }
  void scale_strain_mass(double) noexcept override { ++scaled; }
  void make_rigid() noexcept override { ++rigid; }
  void refuse(const char* why) noexcept override { refusal = why; }

  std::vector<Vec2> stars;
  std::vector<std::array<std::uint32_t, 3>> elements;
  std::vector<Ring> regions;
  std::vector<BoundaryVertex> open;
  std::vector<std::vector<BoundaryVertex>> loops;
  int steadied = 0, rigid = 0, scaled = 0;
  std::string refusal;
};

/// A body as the host hands it over.
struct MeshedBody {
  std::vector<double> outline_x, outline_y, node_x, node_y, line_x, line_y;
  std::vector<std::uint32_t> ring_start{0}, line_start{0};
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void add_ring(const Ring& ring) {
    for (const Vec2 p : ring) outline_x.push_back(p.x), outline_y.push_back(p.y);
    ring_start.push_back(static_cast<std::uint32_t>(outline_x.size()));
  }
  void add_node(Vec2 p) { node_x.push_back(p.x), node_y.push_back(p.y); }
  Vec2 node(std::uint32_t i) const { return {node_x[i], node_y[i]}; }

  MeshNotes covered() const {
    const RegisteredComponent* found = shipped_registry().find(ComponentKind::cover_builder, "mesh");
    REQUIRE(found != nullptr);
    CHECK(found->component->parameter_count == 0);
    const auto builder = make<CoverBuilder>(*found, {});
    BodyShape shape{};
    shape.outline = {outline_x.data(), outline_y.data(), ring_start.data(),
                     static_cast<std::uint32_t>(ring_start.size() - 1)};
    shape.discontinuities = {line_x.data(), line_y.data(), line_start.data(),
                             static_cast<std::uint32_t>(line_start.size() - 1)};
    std::vector<std::uint32_t> flat;
    for (const auto& corners : triangles) flat.insert(flat.end(), corners.begin(), corners.end());
    shape.mesh = {node_x.data(), node_y.data(), reinterpret_cast<const std::uint32_t(*)[3]>(flat.data()),
                  static_cast<std::uint32_t>(node_x.size()), static_cast<std::uint32_t>(triangles.size())};
    MeshNotes notes;
    builder->build(shape, notes);
    return notes;
  }
};

/// A frame of 3 × 3 cells around an empty one, 16 triangles, at places that are no round numbers.
MeshedBody frame() {
  MeshedBody body;
  const auto place = [](int i, int j) { return Vec2{(i - 1.5) / 3.0 + 0.01 * j, (j - 1.5) / 7.0}; };
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) body.add_node(place(i, j));
  }
  for (std::uint32_t j = 0; j < 3; ++j) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (i == 1 && j == 1) continue;
      const std::uint32_t a = i + 4 * j;
      body.triangles.push_back({a, a + 1, a + 5});
      body.triangles.push_back({a, a + 5, a + 4});
    }
  }
  Ring outer;
  // Begins half way along a side, as a ring may.
  for (const auto& [i, j] : {std::pair{2, 0},
                             {3, 0},
                             {3, 1},
                             {3, 2},
                             {3, 3},
                             {2, 3},
                             {1, 3},
                             {0, 3},
                             {0, 2},
                             {0, 1},
                             {0, 0},
                             {1, 0}}) {
    outer.push_back(place(i, j));
  }
  body.add_ring(outer);
  body.add_ring({place(1, 1), place(1, 2), place(2, 2), place(2, 1)});
  return body;
}

}  // namespace

TEST_CASE("nodes of a mesh become patches and triangles elements", "[plugins][mesh]") {
  const MeshedBody body = frame();
  const MeshNotes notes = body.covered();
  CHECK(notes.refusal.empty());
  CHECK(notes.rigid == 0);
  CHECK(notes.steadied == 0);
  REQUIRE(notes.stars.size() == body.node_x.size());
  for (std::uint32_t i = 0; i < notes.stars.size(); ++i) {
    CHECK(notes.stars[i].x == body.node_x[i]);
    CHECK(notes.stars[i].y == body.node_y[i]);
  }
  CHECK(notes.elements == body.triangles);
  REQUIRE(notes.regions.size() == body.triangles.size());
  for (std::size_t t = 0; t < notes.regions.size(); ++t) {
    REQUIRE(notes.regions[t].size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(notes.regions[t][k].x == body.node(body.triangles[t][k]).x);
      CHECK(notes.regions[t][k].y == body.node(body.triangles[t][k]).y);
    }
  }
}

TEST_CASE("the boundary of a mesh follows the outline, each side on the triangle behind it",
          "[plugins][mesh]") {
  const MeshedBody body = frame();
  const MeshNotes notes = body.covered();
  CHECK(notes.open.empty());
  REQUIRE(notes.loops.size() == 2);
  CHECK(notes.loops[0].size() == 12);
  CHECK(notes.loops[1].size() == 4);
  std::uint32_t side = 0;
  for (const auto& loop : notes.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i, ++side) {
      const Vec2 from = loop[i].at, to = loop[(i + 1) % loop.size()].at;
      CHECK(loop[i].side == side);
      CHECK(from.x == body.outline_x[side]);
      CHECK(from.y == body.outline_y[side]);
      // The triangle has this very edge, in this direction: the body is on the left.
      const auto& corners = body.triangles[loop[i].element];
      int found = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 p = body.node(corners[k]), q = body.node(corners[(k + 1) % 3]);
        if (p.x == from.x && p.y == from.y && q.x == to.x && q.y == to.y) ++found;
      }
      CHECK(found == 1);
    }
  }
  CHECK(side == body.outline_x.size());
}

TEST_CASE("a body without a mesh or with discontinuities is refused by the mesh cover in words",
          "[plugins][mesh]") {
  MeshedBody bare = frame();
  bare.triangles.clear();
  const MeshNotes none = bare.covered();
  CHECK_THAT(none.refusal,
             Catch::StartsWith("the body has no mesh: give \"mesh\": \"file.msh\" instead of \"polygon\""));

  MeshedBody cut = frame();
  cut.line_x = {-1, 1};
  cut.line_y = {0, 0};
  cut.line_start = {0, 2};
  const MeshNotes torn = cut.covered();
  CHECK_THAT(torn.refusal, Catch::StartsWith("a mesh is not cut by discontinuities"));
  for (const MeshNotes* notes : {&none, &torn}) {
    CHECK(notes->stars.empty());
    CHECK(notes->elements.empty());
    CHECK(notes->loops.empty());
  }
}

TEST_CASE("an outline that is not the boundary of the mesh is refused", "[plugins][mesh]") {
  MeshedBody moved = frame();
  moved.outline_x[3] += 1e-9;
  MeshedBody without_hole = frame();
  without_hole.ring_start.pop_back();
  MeshedBody less = frame();
  less.triangles.pop_back();
  MeshedBody crossed = frame();
  std::swap(crossed.outline_x[3], crossed.outline_x[5]);
  std::swap(crossed.outline_y[3], crossed.outline_y[5]);
  for (const MeshedBody& body : {moved, without_hole, less, crossed}) {
    const MeshNotes notes = body.covered();
    CHECK(notes.refusal == "the outline of the body is not the boundary of its mesh");
    CHECK(notes.elements.empty());
  }
}
