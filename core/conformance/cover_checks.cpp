#include "conformance/check.hpp"
#include "conformance/recorded_cover.hpp"
#include "conformance/sample_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

namespace talus::conformance {
namespace {

struct SampleBody {
  const char* name;
  DrawnBody body;
  std::size_t parts;  ///< that share nothing
};

/// A body of every kind that a scene may ask a cover for, a metre or so wide.
std::vector<SampleBody> sample_bodies() {
  const Line square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Line hole{{0.4, 0.35}, {0.35, 0.6}, {0.6, 0.65}, {0.65, 0.4}};
  std::vector<SampleBody> bodies;
  bodies.push_back({"a square", DrawnBody({square}), 1});
  bodies.push_back({"a triangle", DrawnBody({Line{{-0.1, 0}, {1.3, -0.2}, {0, 1.1}}}), 1});
  bodies.push_back({"a strip of 2 by 0.1 m", DrawnBody({Line{{0, 0}, {2, 0}, {2, 0.1}, {0, 0.1}}}), 1});
  bodies.push_back(
      {"an L", DrawnBody({Line{{3, 3}, {4.5, 3}, {4.5, 3.5}, {3.5, 3.5}, {3.5, 4.5}, {3, 4.5}}}), 1});
  bodies.push_back({"a polygon of 17 corners", DrawnBody({regular_polygon(17, 0.7, {50, -20}, 0.3)}), 1});
  bodies.push_back({"a square with a hole", DrawnBody({square, hole}), 1});
  bodies.push_back({"a square of 4 by 4 cells of a mesh", DrawnBody::meshed_square(4), 1});
  bodies.push_back(
      {"a square with a cut into it", DrawnBody({square}, {Line{{-0.1, 0.45}, {0.62, 0.55}}}), 1});
  bodies.push_back({"a square cut in two", DrawnBody({square}, {Line{{-0.1, 0.45}, {1.1, 0.57}}}), 2});
  return bodies;
}

/// Calls `check` for each body that the cover takes; for refusals `refused`.
void each_cover(const Subject& subject, Trial& trial,
                const std::function<void(const SampleBody&, const RecordedCover&)>& check,
                const std::function<void(const SampleBody&, const std::string&)>& refused = nullptr) {
  const Component& component = *subject.component->component;
  const auto builder =
      make<CoverBuilder>(*subject.component, in_order({component.parameters, component.parameter_count}, {}));
  for (const SampleBody& sample : sample_bodies()) {
    trial.feed(sample.name);
    RecordedCover cover;
    builder->build(sample.body.shape(), cover);
    if (cover.refusal.empty()) {
      check(sample, cover);
    } else if (refused) {
      refused(sample, cover.refusal);
    }
  }
  if (!trial.compared()) trial.not_claimed("no body got elements with a boundary of their own");
}

/// What can be read of a cover at all; the check `count` says what is wrong where not.
bool is_sound(const RecordedCover& cover) {
  const auto known = [&](std::uint32_t patch) { return patch < cover.stars.size(); };
  const bool elements = std::ranges::all_of(cover.elements, [&](const RecordedCover::Element& element) {
    return std::ranges::all_of(element.patch, known) && !element.rings.empty() &&
           std::ranges::all_of(element.rings, [](const Line& ring) { return ring.size() >= 3; });
  });
  const bool steadied = std::ranges::all_of(cover.steadied, [&](const Steadied& one) {
    return known(one.patch) && std::ranges::all_of(one.to, known);
  });
  const bool loops = std::ranges::all_of(cover.loops, [&](const auto& loop) {
    return std::ranges::all_of(loop,
                               [&](const BoundaryVertex& at) { return at.element < cover.elements.size(); });
  });
  return elements && steadied && loops;
}

double extent_of(const RecordedCover& cover, std::uint32_t element) {
  const auto& patch = cover.elements[element].patch;
  return std::max({distance(cover.stars[patch[0]], cover.stars[patch[1]]),
                   distance(cover.stars[patch[1]], cover.stars[patch[2]]),
                   distance(cover.stars[patch[2]], cover.stars[patch[0]])});
}

/// Twice the area of the triangle of the stars.
double star_area(const RecordedCover& cover, std::uint32_t element) {
  const auto& patch = cover.elements[element].patch;
  const Point a = cover.stars[patch[0]], b = cover.stars[patch[1]], c = cover.stars[patch[2]];
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Displacements of patches without any pattern: only true continuity passes.
Point scattered_displacement(const RecordedCover& cover, std::uint32_t element, Point at) {
  const auto w = cover.weights(element, at);
  Point sum{0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const double patch = cover.elements[element].patch[k];
    sum.x += w[k] * std::fmod(0.5 + 0.6180339887498949 * patch, 1.0);
    sum.y += w[k] * std::fmod(0.25 + 0.4142135623730950 * patch, 1.0);
  }
  return sum;
}

std::size_t ring_corners(const std::vector<Line>& rings) {
  return std::accumulate(rings.begin(), rings.end(), std::size_t{0},
                         [](std::size_t sum, const Line& ring) { return sum + ring.size(); });
}

void expect_moments(Trial& trial, const AreaMoments& made, const AreaMoments& wanted, double extent,
                    const char* of) {
  const double area = wanted.area;
  trial.at_most(std::abs(made.area - area), 1e-9 * area,
                fmt::format("difference of area [m²] of {}, where {:.12g} is due", of, area));
  const double first = std::max(std::abs(made.x - wanted.x), std::abs(made.y - wanted.y));
  trial.at_most(first, 1e-9 * area * extent, fmt::format("difference of a first moment [m³] of {}", of));
  const double second =
      std::max({std::abs(made.xx - wanted.xx), std::abs(made.xy - wanted.xy), std::abs(made.yy - wanted.yy)});
  trial.at_most(second, 1e-9 * area * extent * extent,
                fmt::format("difference of a second moment [m⁴] of {}", of));
}

/// Points within the body, on no pattern.
std::vector<Point> points_within(const DrawnBody& body, int count) {
  std::vector<Point> points;
  const double extent = body.extent();
  for (int i = 1; static_cast<int>(points.size()) < count && i < 100 * count; ++i) {
    const Point at{extent * (2 * std::fmod(0.7548776662466927 * i, 1.0) - 1),
                   extent * (2 * std::fmod(0.5698402909980532 * i, 1.0) - 1)};
    if (is_in(body.rings, at)) points.push_back(at);
  }
  return points;
}

void check_taken(const Subject& subject, Trial& trial) {
  std::size_t taken = 0;
  std::map<std::string, std::string> refusals;  // bodies by the words that refuse them
  each_cover(
      subject, trial,
      [&](const SampleBody&, const RecordedCover&) {
        ++taken;
        trial.due(true, "", "");
      },
      [&](const SampleBody& sample, const std::string& words) {
        std::string& bodies = refusals[words];
        bodies += (bodies.empty() ? "" : ", ") + std::string(sample.name);
      });
  trial.feed("a square, a triangle, a strip, an L, a polygon, a square with a hole, with a mesh, with cuts");
  trial.due(taken > 0, "all of them refused", "at least one of them covered or made rigid");
  std::string words;
  for (const auto& [reason, bodies] : refusals)
    words += fmt::format("{}refused: {} ({})", words.empty() ? "" : "; ", bodies, reason);
  trial.remark(words);
}

void check_count(const Subject& subject, Trial& trial) {
  each_cover(subject, trial, [&](const SampleBody& sample, const RecordedCover& cover) {
    if (cover.rigid) {
      trial.due(cover.stars.empty() && cover.elements.empty(),
                fmt::format("a rigid body with {} patches and {} elements", cover.stars.size(),
                            cover.elements.size()),
                "none of either");
      return;
    }
    trial.due(!cover.elements.empty() && cover.stars.size() >= 3,
              fmt::format("{} elements and {} patches", cover.elements.size(), cover.stars.size()),
              "an element and three patches at least, a rigid body, or a refusal in words");
    const bool block = cover.elements.size() == 1 && cover.stars.size() == 3;
    trial.due(cover.strain_mass_scale == 1 || (cover.strain_mass_scale > 1 && block),
              fmt::format("strain that is {} times as heavy in a cover of {} elements",
                          cover.strain_mass_scale, cover.elements.size()),
              "a factor of 1 or more, and only of one element of three patches");
    trial.due(is_sound(cover),
              "a patch or an element that does not exist, or a ring of less than three corners",
              "numbers that add_patch and add_element gave");
    if (trial.failed()) return;
    std::vector<char> is_steadied(cover.stars.size(), 0);
    for (const Steadied& one : cover.steadied) is_steadied[one.patch] = 1;
    for (const Steadied& one : cover.steadied) {
      trial.due(std::ranges::none_of(one.to, [&](std::uint32_t patch) { return is_steadied[patch] != 0; }),
                fmt::format("patch {} that is to follow one that is steadied itself", one.patch),
                "patches that follow free ones");
    }
    std::vector<int> used(cover.stars.size(), 0);
    for (const RecordedCover::Element& element : cover.elements) {
      for (const std::uint32_t patch : element.patch) ++used[patch];
      trial.due(!element.rings.empty(), "an element without a region", "a region");
    }
    for (std::uint32_t e = 0; e < cover.elements.size(); ++e) {
      trial.due(star_area(cover, e) > 0,
                fmt::format("element {} with patches that run clockwise or lie on a line", e),
                "three patches, counter-clockwise");
    }
    const auto idle = static_cast<std::size_t>(std::ranges::count(used, 0));
    trial.due(idle == 0, fmt::format("{} of {} patches that no element uses", idle, used.size()),
              "every patch used: one without mass cannot move");
    trial.due(cover.parts() == sample.parts, fmt::format("{} parts that share no patch", cover.parts()),
              fmt::format("{}", sample.parts));
  });
}

void check_area(const Subject& subject, Trial& trial) {
  each_cover(subject, trial, [&](const SampleBody& sample, const RecordedCover& cover) {
    if (cover.rigid || !is_sound(cover)) return;
    AreaMoments sum{};
    for (const RecordedCover::Element& element : cover.elements) {
      const AreaMoments m = moments_of(element.rings);
      trial.due(m.area > 0, fmt::format("an element of {:g} m²", m.area),
                "a positive area: regions run counter-clockwise");
      sum = {sum.area + m.area, sum.x + m.x, sum.y + m.y, sum.xx + m.xx, sum.xy + m.xy, sum.yy + m.yy};
    }
    expect_moments(trial, sum, sample.body.shape().moments, sample.body.extent(), "all elements together");
  });
}

void check_unity(const Subject& subject, Trial& trial) {
  each_cover(subject, trial, [&](const SampleBody& sample, const RecordedCover& cover) {
    if (cover.rigid || !is_sound(cover)) return;
    const auto count = static_cast<std::uint32_t>(cover.elements.size());
    for (const Point at : points_within(sample.body, 300)) {
      std::uint32_t holders = 0, holder = 0;
      for (std::uint32_t e = 0; e < count; ++e) {
        if (is_in(cover.elements[e].rings, at)) ++holders, holder = e;
      }
      trial.due(holders == 1, fmt::format("{} elements at ({:.6g}, {:.6g}) m", holders, at.x, at.y), "one");
      if (trial.failed()) return;
      const auto w = cover.weights(holder, at);
      trial.at_most(std::abs(w[0] + w[1] + w[2] - 1), 1e-9,
                    fmt::format("|sum of the weights - 1| at ({:.6g}, {:.6g}) m", at.x, at.y));
    }
    if (!sample.body.lines.empty()) return;  // across a cut weights jump
    for (std::uint32_t e = 0; e < count; ++e) {
      const double size = extent_of(cover, e), aside = 1e-7 * size;
      for (const Line& ring : cover.elements[e].rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const Point p = ring[i], q = ring[(i + 1) % ring.size()];
          const double length = distance(p, q);
          if (length < 1e-3 * size) continue;
          const Point middle{(p.x + q.x) / 2, (p.y + q.y) / 2};
          const Point beyond{middle.x + aside * (q.y - p.y) / length,
                             middle.y - aside * (q.x - p.x) / length};
          for (std::uint32_t other = 0; other < count; ++other) {
            if (other == e || !is_in(cover.elements[other].rings, beyond)) continue;
            const Point here = scattered_displacement(cover, e, middle);
            trial.at_most(
                distance(here, scattered_displacement(cover, other, middle)), 1e-6,
                fmt::format(
                    "jump of a displacement of patches by some 1 m, from element {} to {} at ({:.6g}, "
                    "{:.6g}) m",
                    e, other, middle.x, middle.y));
          }
        }
      }
    }
  });
}

void check_affine(const Subject& subject, Trial& trial) {
  // d = b + A X at every star point.
  const auto field = [](Point p) { return Point{0.3 + 1.1 * p.x - 0.7 * p.y, -0.2 + 0.4 * p.x + 0.9 * p.y}; };
  each_cover(subject, trial, [&](const SampleBody&, const RecordedCover& cover) {
    if (cover.rigid || !is_sound(cover)) return;
    for (std::uint32_t e = 0; e < cover.elements.size(); ++e) {
      const double size = extent_of(cover, e);
      trial.due(std::abs(star_area(cover, e)) > 1e-6 * size * size,
                fmt::format("star points of element {} that lie in a line", e), "a triangle");
      if (trial.failed()) return;
      for (const Line& ring : cover.elements[e].rings) {
        for (const Point at : ring) {
          const auto w = cover.weights(e, at);
          Point sum{0, 0};
          for (std::size_t k = 0; k < 3; ++k) {
            const Point d = field(cover.stars[cover.elements[e].patch[k]]);
            sum = {sum.x + w[k] * d.x, sum.y + w[k] * d.y};
          }
          trial.at_most(
              distance(sum, field(at)), 1e-9 * (1 + size),
              fmt::format("error [m] of an affine field in element {} at ({:.6g}, {:.6g}) m", e, at.x, at.y));
        }
      }
    }
    for (const Steadied& one : cover.steadied) {
      Point sum{0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        const Point d = field(cover.stars[one.to[k]]);
        sum = {sum.x + one.weights[k] * d.x, sum.y + one.weights[k] * d.y};
      }
      trial.at_most(distance(sum, field(cover.stars[one.patch])), 1e-8,
                    fmt::format("error [m] of an affine field at patch {}, which is steadied", one.patch));
      trial.due(one.inertia_area > 0, fmt::format("an inertia area of {:g} m²", one.inertia_area),
                "more than 0");
    }
  });
}

struct OutlineSide {
  Point start, end;
};

std::vector<OutlineSide> all_sides(const DrawnBody& body) {
  std::vector<OutlineSide> sides;
  for (const Line& ring : body.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) sides.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
  for (const Line& line : body.lines) {
    for (std::size_t i = 0; i < line.size(); ++i)
      sides.push_back({line[i], line[std::min(i + 1, line.size() - 1)]});
  }
  return sides;
}

void check_boundary(const Subject& subject, Trial& trial) {
  each_cover(subject, trial, [&](const SampleBody& sample, const RecordedCover& cover) {
    if (cover.rigid || !is_sound(cover)) return;
    if (cover.elements.size() == 1 && cover.stars.size() == 3 && cover.loops.empty()) return;  // a block
    const std::vector<OutlineSide> sides = all_sides(sample.body);
    const std::size_t outline = ring_corners(sample.body.rings);
    const double near = 1e-7 * sample.body.extent();
    std::vector<double> followed(sides.size(), 0);
    std::vector<Line> loops;
    for (const auto& loop : cover.loops) {
      loops.emplace_back();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const BoundaryVertex &from = loop[i], &to = loop[(i + 1) % loop.size()];
        const std::string place = fmt::format("({:.6g}, {:.6g}) m", from.at.x, from.at.y);
        trial.due(from.side < sides.size(), fmt::format("side {} at {}", from.side, place),
                  fmt::format("a side below {}", sides.size()));
        if (trial.failed()) return;
        const OutlineSide& side = sides[from.side];
        trial.at_most(std::max(distance_from_segment(from.at, side.start, side.end),
                               distance_from_segment(to.at, side.start, side.end)),
                      near,
                      fmt::format("distance [m] of the boundary at {} from side {}, which it is to follow",
                                  place, from.side));
        const Point middle{(from.at.x + to.at.x) / 2, (from.at.y + to.at.y) / 2};
        double closest = std::numeric_limits<double>::infinity();
        for (const Line& ring : cover.elements[from.element].rings) {
          for (std::size_t k = 0; k < ring.size(); ++k)
            closest = std::min(closest, distance_from_segment(middle, ring[k], ring[(k + 1) % ring.size()]));
        }
        trial.at_most(
            closest, near,
            fmt::format("distance [m] of the boundary at {} from the rim of element {}, which is to carry it",
                        place, from.element));
        followed[from.side] += distance(from.at, to.at);
        loops.back().push_back(from.at);
      }
      trial.due(loops.back().size() >= 3, fmt::format("a loop of {} vertices", loop.size()),
                "three at least");
      if (trial.failed()) return;
    }
    for (std::size_t i = 0; i < outline; ++i) {
      const double due = distance(sides[i].start, sides[i].end);
      trial.at_most(std::abs(followed[i] - due), 1e-6 * due + near,
                    fmt::format("difference [m] of the boundary along side {}: {:.9g} m of {:.9g} m", i,
                                followed[i], due));
    }
    trial.due(!loops.empty(), "no boundary", "loops: the cover has several elements");
    if (!trial.failed()) {
      expect_moments(trial, moments_of(loops), sample.body.shape().moments, sample.body.extent(),
                     "the loops of the boundary");
    }
  });
}

}  // namespace

std::span<const Check> cover_checks() {
  static constexpr Check checks[] = {
      {"parameters", "declared defaults make a cover; other values make one or are refused in words",
       check_parameters},
      {"taken", "bodies are covered, made rigid, or refused in words", check_taken},
      {"count", "elements and patches exist, every patch is used, uncut bodies hang together", check_count},
      {"area", "the elements have the area and the moments of the body", check_area},
      {"unity", "weights sum to one everywhere in the body and do not jump from element to element",
       check_unity},
      {"affine", "affine fields are reproduced, by steadied patches as well", check_affine},
      {"boundary", "the loops follow every side of the body and surround it", check_boundary}};
  return checks;
}

}  // namespace talus::conformance
