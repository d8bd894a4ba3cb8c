#include "rings.hpp"

namespace talus::hexagonal {
namespace {

/// Closed walks along the half-edges that `belongs` accepts, over those it does not: it turns around a node
/// through what lies on its left until it finds the next that belongs.
template <class Belongs, class Close>
void walk(const Faces& faces, std::uint32_t start, std::vector<std::uint8_t>& done, Belongs&& belongs,
          Close&& close) {
  if (done[start] == 1 || !belongs(start)) return;
  std::vector<std::uint32_t> ring;
  for (std::uint32_t h = start; done[h] == 0;) {
    done[h] = 1;
    ring.push_back(h);
    h = faces.next[h];
    while (!belongs(h)) h = faces.next[h ^ 1];
  }
  close(ring);
}

/// Whether the line goes straight on from one half-edge to the next, with nothing else at the node.
bool straight(const Faces& faces, std::uint32_t before, std::uint32_t after) {
  if (faces.degree[faces.origin(after)] != 2) return false;
  const Edge &from = faces.edge(before), &to = faces.edge(after);
  return from.kind == to.kind && from.label == to.label && from.lattice == to.lattice;
}

}  // namespace

RegionMoments moments_about(Point origin, const Region& region) {
  RegionMoments sum{0, 0, 0};
  for (std::uint32_t ring = 0; ring < region.ring_count; ++ring) {
    const std::uint32_t first = region.ring_start[ring], end = region.ring_start[ring + 1];
    for (std::uint32_t i = first; i < end; ++i) {
      const std::uint32_t j = i + 1 < end ? i + 1 : first;
      const Point p{region.x[i] - origin.x, region.y[i] - origin.y};
      const Point q{region.x[j] - origin.x, region.y[j] - origin.y};
      const double part = (p.x * q.y - q.x * p.y) / 2;
      sum.area += part;
      sum.x += part * (p.x + q.x) / 3;
      sum.y += part * (p.y + q.y) / 3;
    }
  }
  return sum;
}

Regions regions(const Faces& faces, const Connectivity& connectivity) {
  Regions result;
  std::vector<std::uint8_t> done(faces.next.size(), 0);
  const auto belongs = [&](std::uint32_t h) {
    return element_at(faces, connectivity, h) != element_at(faces, connectivity, h ^ 1);
  };
  const auto close = [&](const std::vector<std::uint32_t>& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (straight(faces, ring[k > 0 ? k - 1 : ring.size() - 1], ring[k])) continue;
      const Point at = faces.graph.point[faces.origin(ring[k])];
      result.x.push_back(at.x);
      result.y.push_back(at.y);
    }
    result.ring_start.push_back(static_cast<std::uint32_t>(result.x.size()) - result.vertex_start.back());
  };
  for (std::size_t element = 0; element < connectivity.elements.size(); ++element) {
    result.ring_start.push_back(0);
    for (std::uint32_t k = connectivity.first_face[element]; k < connectivity.first_face[element + 1]; ++k) {
      faces.visit_face(connectivity.faces[k], [&](std::uint32_t h) { walk(faces, h, done, belongs, close); });
    }
    result.vertex_start.push_back(static_cast<std::uint32_t>(result.x.size()));
    result.ring_begin.push_back(static_cast<std::uint32_t>(result.ring_start.size()));
  }
  return result;
}

Boundary boundary(const Faces& faces, const Connectivity& connectivity) {
  Boundary result;
  std::vector<std::uint8_t> done(faces.next.size(), 0);
  const auto belongs = [&](std::uint32_t h) { return on_boundary(faces, connectivity, h); };
  const auto close = [&](const std::vector<std::uint32_t>& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t before = loop[k > 0 ? k - 1 : loop.size() - 1], h = loop[k];
      const std::uint32_t element = element_at(faces, connectivity, h), side = faces.edge(h).label;
      // Where something else meets this side, both of its faces have a vertex.
      const bool same =
          element == element_at(faces, connectivity, before) && side == faces.edge(before).label;
      if (same && faces.degree[faces.origin(h)] == 2) continue;
      result.vertices.push_back({faces.graph.point[faces.origin(h)], element, side});
    }
    result.loop_start.push_back(static_cast<std::uint32_t>(result.vertices.size()));
  };
  for (const std::uint32_t face : connectivity.faces) {
    faces.visit_face(face, [&](std::uint32_t h) { walk(faces, h, done, belongs, close); });
  }
  return result;
}

}  // namespace talus::hexagonal
