#include "model/model.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace talus;

namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

constexpr double density = 2300;

Body block_of(const std::string& polygon) {
  WorkingScene text;
  text.cover = "block";
  text.bodies = R"({"name": "a", "material": "rock", "polygon": )" + polygon + "}";
  return build_model(text.read()).bodies[0];
}

/// w_i = a + b x + c y of the triangle of the star points: 1 at its own, 0 at the others (Eq. 14).
std::array<double, 3> weight(const std::vector<Vec2>& star, std::size_t i) {
  const Vec2 o = star[i], p = star[(i + 1) % 3], q = star[(i + 2) % 3];
  const double twice = (q.x - p.x) * (o.y - p.y) - (q.y - p.y) * (o.x - p.x);
  const double b = -(q.y - p.y) / twice, c = (q.x - p.x) / twice;
  return {1 - b * o.x - c * o.y, b, c};
}

/// Eq. 17 patch by patch: M_ij = ρ ∫ w_i w_j over the polygon, by the mid-side rule on a fan of triangles,
/// which is exact for products of linear weights.
Matrix3 patch_mass(const Ring& ring, const std::vector<Vec2>& star) {
  Matrix3 mass{};
  for (std::size_t k = 0; k + 2 < ring.size(); ++k) {
    const Vec2 o = ring[0], p = ring[k + 1], q = ring[k + 2];
    const double area = ((p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x)) / 2;
    const Vec2 middle[3] = {{(o.x + p.x) / 2, (o.y + p.y) / 2},
                            {(p.x + q.x) / 2, (p.y + q.y) / 2},
                            {(q.x + o.x) / 2, (q.y + o.y) / 2}};
    for (const Vec2 at : middle) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          const auto wi = weight(star, i), wj = weight(star, j);
          mass[i][j] += density * area / 3 * (wi[0] + wi[1] * at.x + wi[2] * at.y) *
                        (wj[0] + wj[1] * at.x + wj[2] * at.y);
        }
      }
    }
  }
  return mass;
}

/// Tᵀ M T with d_i = u + H X_i: rows of T are (1, X_i, Y_i), per axis.
Matrix3 in_body_basis(const Matrix3& mass, const std::vector<Vec2>& star) {
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double ti[3] = {1, star[i].x, star[i].y}, tj[3] = {1, star[j].x, star[j].y};
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t s = 0; s < 3; ++s) result[r][s] += ti[r] * mass[i][j] * tj[s];
      }
    }
  }
  return result;
}

Ring ring_of(const std::string& polygon) {
  WorkingScene text;
  text.bodies = R"({"name": "a", "material": "rock", "polygon": )" + polygon + "}";
  const Scene scene = text.read();
  const Vec2 centre = build_model(scene).bodies[0].centre;
  Ring ring;
  for (const Vec2 p : scene.bodies[0].outer.vertices) ring.push_back({p.x - centre.x, p.y - centre.y});
  return ring;
}

/// The star points that the cover "block" gives a ring: an equilateral triangle around its farthest vertex.
std::vector<Vec2> star_around(const Ring& ring) {
  double radius = 0;
  for (const Vec2 p : ring) radius = std::max(radius, std::hypot(p.x, p.y));
  return {{-std::sqrt(3.0) * radius, -radius}, {std::sqrt(3.0) * radius, -radius}, {0, 2 * radius}};
}

const char* const polygons[] = {
    "[[0, 0], [1, 0], [1, 1], [0, 1]]",
    "[[2, 3], [6, 4], [5, 6], [3, 7], [1, 5]]",
    "[[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]",
    "[[10, 10], [10.01, 10], [10.02, 11]]",
};

}  // namespace

TEST_CASE("the consistent mass of three patches falls apart into m and rho J", "[model][mass]") {
  for (const char* polygon : polygons) {
    INFO(polygon);
    const Body body = block_of(polygon);
    const std::vector<Vec2> stars = star_around(ring_of(polygon));
    const Matrix3 mass = in_body_basis(patch_mass(ring_of(polygon), stars), stars);
    const double turning = density * (body.moments.xx + body.moments.yy);
    CHECK(mass[0][0] == Approx(body.mass).epsilon(1e-10));
    CHECK(mass[0][1] == Approx(0).margin(1e-10 * body.mass));
    CHECK(mass[0][2] == Approx(0).margin(1e-10 * body.mass));
    CHECK(mass[1][1] == Approx(density * body.moments.xx).margin(1e-10 * turning));
    CHECK(mass[1][2] == Approx(density * body.moments.xy).margin(1e-10 * turning));
    CHECK(mass[2][2] == Approx(density * body.moments.yy).margin(1e-10 * turning));

    const Matrix2 inverse = body.inverse_moment();
    CHECK(inverse.xx * mass[1][1] + inverse.xy * mass[2][1] == Approx(1).epsilon(1e-6));
    CHECK(inverse.xx * mass[1][2] + inverse.xy * mass[2][2] == Approx(0).margin(1e-6));
    CHECK(inverse.yx * mass[1][1] + inverse.yy * mass[2][1] == Approx(0).margin(1e-6));
    CHECK(inverse.yx * mass[1][2] + inverse.yy * mass[2][2] == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("a rectangle has its true rotational inertia, row sums would give twelve times as much",
          "[model][mass]") {
  for (const double width : {1.0, 0.5, 20.0}) {
    const double height = 1;
    const std::string polygon =
        "[[0, 0], [" + std::to_string(width) + ", 0], [" + std::to_string(width) + ", 1], [0, 1]]";
    const Body body = block_of(polygon);
    const double mass = density * width * height;
    const double inertia = mass * (width * width + height * height) / 12;
    CHECK(body.mass == Approx(mass).epsilon(1e-14));
    CHECK(density * (body.moments.xx + body.moments.yy) == Approx(inertia).epsilon(1e-14));

    const std::vector<Vec2> around = star_around(ring_of(polygon));
    const Matrix3 patches = patch_mass(ring_of(polygon), around);
    double lumped = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 star = around[i];
      const double row = patches[i][0] + patches[i][1] + patches[i][2];
      CHECK(row == Approx(mass / 3));
      lumped += row * (star.x * star.x + star.y * star.y);
    }
    CHECK(lumped / inertia == Approx(12).epsilon(1e-10));
  }
}

TEST_CASE("a rigid body has the mass and inertia of its polygon, holes taken out", "[model][mass]") {
  WorkingScene text;
  text.bodies =
      R"({"name": "frame", "material": "rock", "polygon": [[0, 0], [4, 0], [4, 2], [0, 2]],
          "holes": [[[1, 0.5], [3, 0.5], [3, 1.5], [1, 1.5]]]})";
  const Body body = build_model(text.read()).bodies[0];
  CHECK(body.centre.x == Approx(2));
  CHECK(body.centre.y == Approx(1));
  CHECK(body.mass == Approx(density * (8 - 2)));
  CHECK(body.inertia() == Approx(density * (8 * (16 + 4) - 2 * (4 + 1)) / 12.0));
  CHECK(body.width == Approx(2));
}

TEST_CASE("far from the origin a body keeps its shape to round-off of its written vertices",
          "[model][mass]") {
  const Body here = block_of("[[0, 0], [1, 0], [1, 0.5], [0, 0.5]]");
  const Body there =
      block_of("[[500000, 5000000], [500001, 5000000], [500001, 5000000.5], [500000, 5000000.5]]");
  CHECK(there.mass == Approx(here.mass).epsilon(1e-14));
  CHECK(there.moments.xx == Approx(here.moments.xx).epsilon(1e-12));
  CHECK(there.moments.yy == Approx(here.moments.yy).epsilon(1e-12));
  CHECK(there.centre.x == 500000.5);
  CHECK(there.centre.y == 5000000.25);
}
