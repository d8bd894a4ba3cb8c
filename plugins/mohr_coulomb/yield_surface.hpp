#pragma once

#include <talus/plane_tensor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace talus {

/// Principal stresses, largest first, Pa; tension is positive.
using Principal = std::array<double, 3>;

inline double dot(const Principal& p, const Principal& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/// What a material bears. Angles in radians, stresses in Pa.
struct Strength {
  double friction_angle, cohesion, dilation_angle;
  double tension;  ///< cut-off; above the apex c cot φ it says nothing
};

/// The Mohr–Coulomb pyramid with a tension cut-off in the space of principal stresses, and the implicit
/// return to it. Stress changes of an isotropic elastic body keep the order of the principal stresses, so of
/// each family three planes are enough: shear between stresses 1–3, 2–3 and 1–2, tension of 1, 2 and 3.
///
/// A returned stress lies on one plane, on the edge of two or in the corner of three. Each such set has a
/// linear answer; the right one needs no other plane and pulls on none of its own. The sets are few, so all
/// are listed once and tried in order: edges, corners and apex are no special cases.
class YieldSurface {
 public:
  YieldSurface(const PlaneModuli& moduli, const Strength& strength) {
    const double s = std::sin(strength.friction_angle), limit = shear_limit(strength);
    const double d = std::sin(strength.dilation_angle);
    const double apex = s > 0 ? limit / (2 * s) : std::numeric_limits<double>::infinity();
    const double tension = std::min(strength.tension, apex);
    for (const auto [major, minor] : {std::array{0, 2}, std::array{1, 2}, std::array{0, 1}}) {
      Plane plane{};
      plane.normal[major] = 1 + s;
      plane.normal[minor] = -(1 - s);
      plane.flow[major] = 1 + d;
      plane.flow[minor] = -(1 - d);
      plane.limit = limit;
      planes_.push_back(plane);
    }
    for (int k = 0; k < 3 && std::isfinite(tension); ++k) {
      Plane plane{};
      plane.normal[k] = plane.flow[k] = 1;  // associated: a crack opens across itself
      plane.limit = tension;
      planes_.push_back(plane);
    }
    for (Plane& plane : planes_) plane.relief = elastic(moduli, plane.flow);
    list_sets();
  }

  /// The largest of the yield functions, Pa: a·σ − limit; not above 0 in the elastic domain. In the order of
  /// the principal stresses the first plane of each family comes first.
  double yield(const Principal& stress) const {
    const double shear = excess(planes_[0], stress);
    return planes_.size() == 3 ? shear : std::max(shear, excess(planes_[3], stress));
  }

  /// The stress a trial stress beyond yield relaxes to, Koiter's rule at edges and corners.
  Principal returned(const Principal& trial) const {
    Principal best = trial;
    double least = std::numeric_limits<double>::infinity();
    for (const Set& set : sets_) {
      const Answer answer = solve(set, trial);
      if (answer.violation < least) {
        least = answer.violation;
        best = answer.stress;
      }
      if (least <= 0) break;  // otherwise round-off, where the domains of two sets meet
    }
    return best;
  }

 private:
  struct Plane {
    Principal normal, flow;
    Principal relief;  ///< Pa, D times the flow: stress relieved by a unit of plastic strain
    double limit;      ///< Pa
  };

  /// Planes that are active together.
  struct Set {
    int size;
    std::array<int, 3> plane;
    std::array<std::array<double, 3>, 3> inverse;  ///< 1/Pa, of the normals times the reliefs
  };

  struct Answer {
    Principal stress;
    double violation;  ///< Pa, 0 for the right set
  };

  static double excess(const Plane& plane, const Principal& stress) {
    return dot(plane.normal, stress) - plane.limit;
  }

  static double shear_limit(const Strength& strength) {
    return 2 * strength.cohesion * std::cos(strength.friction_angle);
  }

  static Principal elastic(const PlaneModuli& d, const Principal& strain) {
    Principal stress;
    for (int k = 0; k < 3; ++k) {
      stress[k] = d.across * (strain[0] + strain[1] + strain[2]) + 2 * d.shear * strain[k];
    }
    return stress;
  }

  void list_sets() {
    const int count = static_cast<int>(planes_.size());
    for (int i = 0; i < count; ++i) add_set({1, {i, 0, 0}, {}});
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) add_set({2, {i, j, 0}, {}});
    }
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        for (int k = j + 1; k < count; ++k) add_set({3, {i, j, k}, {}});
      }
    }
  }

  /// Unless its planes meet in no point.
  void add_set(Set set) {
    std::array<std::array<double, 3>, 3> a{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    double scale = 1;
    for (int i = 0; i < set.size; ++i) {
      for (int j = 0; j < set.size; ++j) {
        a[i][j] = dot(planes_[set.plane[i]].normal, planes_[set.plane[j]].relief);
      }
      scale *= a[i][i];
    }
    // Indices taken round the clock carry the signs of the cofactors.
    const auto cofactor = [&](int i, int j) {
      const int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, t = (j + 2) % 3;
      return a[p][r] * a[q][t] - a[p][t] * a[q][r];
    };
    const double determinant = a[0][0] * cofactor(0, 0) + a[0][1] * cofactor(0, 1) + a[0][2] * cofactor(0, 2);
    if (!(std::abs(determinant) > 1e-12 * scale)) return;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) set.inverse[i][j] = cofactor(j, i) / determinant;
    }
    sets_.push_back(set);
  }

  Answer solve(const Set& set, const Principal& trial) const {
    Principal stress = trial, multiplier{0, 0, 0};
    // The second pass removes the round-off of a trial stress far away.
    for (int pass = 0; pass < 2; ++pass) {
      Principal beyond{0, 0, 0};
      for (int i = 0; i < set.size; ++i) beyond[i] = excess(planes_[set.plane[i]], stress);
      for (int i = 0; i < set.size; ++i) {
        const double step = dot(set.inverse[i], beyond);
        multiplier[i] += step;
        for (int k = 0; k < 3; ++k) stress[k] -= step * planes_[set.plane[i]].relief[k];
      }
    }
    return {stress, violation(set, stress, multiplier)};
  }

  /// How far another plane is exceeded or an own one pulls.
  double violation(const Set& set, const Principal& stress, const Principal& multiplier) const {
    double worst = 0;
    for (int i = 0; i < set.size; ++i) {
      const Plane& plane = planes_[set.plane[i]];
      worst = std::max(worst, -multiplier[i] * dot(plane.normal, plane.relief));
    }
    for (int k = 0; k < static_cast<int>(planes_.size()); ++k) {
      bool own = false;
      for (int i = 0; i < set.size; ++i) own = own || set.plane[i] == k;
      if (!own) worst = std::max(worst, excess(planes_[k], stress));
    }
    return worst;
  }

  std::vector<Plane> planes_;
  std::vector<Set> sets_;
};

}  // namespace talus
