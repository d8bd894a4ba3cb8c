#pragma once

// A small cover that is right in every respect, for others to spoil in one: a fan of triangles from the
// centroid to the sides of a convex polygon. Each virtual function is a place where a cover can go wrong.

#include <talus/library.hpp>

#include <vector>

namespace spoilt {

class Fan : public talus::CoverBuilder {
 public:
  explicit Fan(const double* /*values*/) {}

  void build(const talus::BodyShape& body, talus::CoverSink& sink) const noexcept override {
    const talus::Region& outline = body.outline;
    if (outline.ring_count != 1 || body.discontinuities.line_count > 0 || !convex(outline)) {
      sink.refuse("a fan covers convex polygons without holes and cuts");
      return;
    }
    const std::uint32_t corners = outline.ring_start[1];
    std::vector<std::uint32_t> patch;
    for (std::uint32_t i = 0; i < corners; ++i) patch.push_back(sink.add_patch(outline.x[i], outline.y[i]));
    const std::uint32_t centre = sink.add_patch(0, 0), last = closing_patch(outline, patch[0], sink);
    constexpr std::uint32_t ring[2] = {0, 3};
    for (std::uint32_t i = 0; i < corners; ++i) {
      const std::uint32_t next = i + 1 == corners ? 0 : i + 1;
      const std::uint32_t other = next == 0 ? last : patch[next];
      const std::uint32_t patches[3] = {centre, clockwise() ? other : patch[i],
                                        clockwise() ? patch[i] : other};
      const double tip = i == 0 ? first_tip() : 0;
      const double x[3] = {tip * (outline.x[i] + outline.x[next]), outline.x[i], outline.x[next]};
      const double y[3] = {tip * (outline.y[i] + outline.y[next]), outline.y[i], outline.y[next]};
      sink.add_element(patches, {x, y, ring, 1});
    }
    for (std::uint32_t i = 0; i < corners; ++i)
      sink.add_boundary_vertex(outline.x[i], outline.y[i], i, side_at(i, corners));
    sink.close_boundary_loop();
    finish(centre, patch, sink);
  }

 protected:
  /// The patch at corner 0 for the last triangle.
  virtual std::uint32_t closing_patch(const talus::Region&, std::uint32_t first, talus::CoverSink&) const {
    return first;
  }
  virtual bool clockwise() const { return false; }  ///< the patches of an element
  virtual double first_tip() const { return 0; }    ///< of the first triangle, away from the centroid
  virtual std::uint32_t side_at(std::uint32_t corner, std::uint32_t /*corners*/) const { return corner; }
  virtual void finish(std::uint32_t /*centre*/, const std::vector<std::uint32_t>& /*patch*/,
                      talus::CoverSink& /*sink*/) const {}

 private:
  static bool convex(const talus::Region& outline) {
    const std::uint32_t n = outline.ring_start[1];
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n, k = (i + 2) % n;
      const double turn = (outline.x[j] - outline.x[i]) * (outline.y[k] - outline.y[j]) -
                          (outline.y[j] - outline.y[i]) * (outline.x[k] - outline.x[j]);
      if (turn < -1e-12) return false;
    }
    return true;
  }
};

template <class Cover>
constexpr talus::Component cover(const char* name) {
  return talus::cover_builder<Cover>(name, "A cover for tests.", {});
}

template <std::size_t count>
constexpr talus::Library library(const talus::Component (&components)[count]) {
  return talus::library("spoilt", "1.0", "the tests of talus", components);
}

}  // namespace spoilt
