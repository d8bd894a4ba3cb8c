#include "output/frame.hpp"

#include "output/triangulate.hpp"
#include "output/whole_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace talus {

namespace {

void append(std::vector<double>& values, Vec2 vector) {
  for (const double component : {vector.x, vector.y, 0.0}) values.push_back(component);
}

/// One array after the other, without a copy of any.
template <class... Arrays>
std::vector<GridArray> array_list(Arrays&&... arrays) {
  std::vector<GridArray> list;
  (list.push_back(std::forward<Arrays>(arrays)), ...);
  return list;
}

template <class Each>
void over_parts(const Frame& frame, const Each& each) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    for (const BodyPart& part : frame.bodies[i].parts) each(i, part);
  }
}

/// A polygon of VTK has no holes.
bool is_polygon(const BodyPart& part) {
  return part.loops.size() == 1;
}

std::vector<std::int64_t> triangles_of(const BodyPart& part) {
  std::vector<std::vector<Vec2>> loops;
  for (const std::vector<PartPoint>& loop : part.loops) {
    loops.emplace_back();
    for (const PartPoint& point : loop) loops.back().push_back(point.position);
  }
  std::vector<std::int64_t> corners;
  for (const auto& [a, b, c] : triangulate(loops)) corners.insert(corners.end(), {a, b, c});
  return corners;
}

/// The bodies of a frame as arrays of a grid. Room is made once: of a large body they are large.
class BodyGrid {
 public:
  BodyGrid(std::size_t points, std::size_t corners, std::size_t cells) {
    for (auto* values : {&grid_.points, &displacement_, &velocity_}) values->reserve(3 * points);
    for (auto* values : {&speed_, &stress_[0], &stress_[1], &stress_[2]}) values->reserve(cells);
    for (auto* values : {&material_, &body_}) values->reserve(cells);
    grid_.connectivity.reserve(corners);
    grid_.offsets.reserve(cells);
    grid_.types.reserve(cells);
  }

  /// The points of a part; its cells come next. Returns the number of the first.
  std::int64_t add_points(const BodyPart& part, Vec2 origin) {
    const auto first = static_cast<std::int64_t>(grid_.points.size() / 3);
    for (const std::vector<PartPoint>& loop : part.loops) {
      for (const PartPoint& point : loop) {
        append(grid_.points, {origin.x + point.position.x, origin.y + point.position.y});
        append(displacement_, point.displacement);
        append(velocity_, point.velocity);
      }
    }
    return first;
  }

  void add_cell(CellType type, std::span<const std::int64_t> corners, const FrameBody& body,
                std::size_t number, const BodyPart& part) {
    grid_.add_cell(type, corners);
    speed_.push_back(body.speed);
    for (std::size_t k = 0; k < 3; ++k) stress_[k].push_back(part.stress[k]);
    material_.push_back(static_cast<std::int32_t>(body.material));
    body_.push_back(static_cast<std::int32_t>(number));
  }

  Grid take() {
    grid_.point_data = array_list(GridArray{"displacement", 3, std::move(displacement_)},
                                  GridArray{"velocity", 3, std::move(velocity_)});
    grid_.cell_data = array_list(
        GridArray{"speed", 1, std::move(speed_)}, GridArray{"stress_xx", 1, std::move(stress_[0])},
        GridArray{"stress_yy", 1, std::move(stress_[1])}, GridArray{"stress_xy", 1, std::move(stress_[2])},
        GridArray{"material", 1, std::move(material_)}, GridArray{"body", 1, std::move(body_)});
    return std::move(grid_);
  }

 private:
  Grid grid_;
  std::vector<double> displacement_, velocity_, speed_;
  std::array<std::vector<double>, 3> stress_;
  std::vector<std::int32_t> material_, body_;
};

}  // namespace

bool Frame::finite() const {
  for (const FrameBody& body : bodies) {
    for (const BodyPart& part : body.parts) {
      for (const std::vector<PartPoint>& loop : part.loops) {
        for (const PartPoint& point : loop) {
          if (!std::isfinite(point.position.x) || !std::isfinite(point.position.y)) return false;
        }
      }
    }
  }
  return true;
}

Frame sample_frame(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  Frame frame{simulation.time(), scene.origin, {}, simulation.contacts()};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Vec2 speed = simulation.body_motion(i).velocity;
    frame.bodies.push_back({simulation.parts(i), scene.bodies[i].material, std::hypot(speed.x, speed.y)});
  }
  return frame;
}

Grid contact_grid(const Frame& frame) {
  Grid grid;
  std::vector<double> normal, tangential, penetration;
  std::vector<std::int32_t> slipping, body_a, body_b;
  for (const Contact& contact : frame.contacts) {
    const std::array corner{static_cast<std::int64_t>(grid.points.size() / 3)};
    grid.add_cell(CellType::vertex, corner);
    append(grid.points, {frame.origin.x + contact.point.x, frame.origin.y + contact.point.y});
    append(normal, contact.normal_force);
    append(tangential, contact.tangential_force);
    penetration.push_back(contact.penetration);
    slipping.push_back(contact.slipping ? 1 : 0);
    body_a.push_back(static_cast<std::int32_t>(contact.body_a));
    body_b.push_back(static_cast<std::int32_t>(contact.body_b));
  }
  grid.point_data = array_list(
      GridArray{"normal_force", 3, std::move(normal)},
      GridArray{"tangential_force", 3, std::move(tangential)},
      GridArray{"penetration", 1, std::move(penetration)}, GridArray{"slipping", 1, std::move(slipping)},
      GridArray{"body_a", 1, std::move(body_a)}, GridArray{"body_b", 1, std::move(body_b)});
  return grid;
}

FrameWriter::FrameWriter(const std::filesystem::path& folder) : folder_(folder) {
  std::filesystem::create_directories(folder_ / "frames");
}

Grid FrameWriter::body_grid(const Frame& frame) {
  std::size_t points = 0, corners = 0, cells = 0, holed = 0;
  over_parts(frame, [&](std::size_t, const BodyPart& part) {
    for (const std::vector<PartPoint>& loop : part.loops) points += loop.size();
    if (!is_polygon(part) && count_ == 0) triangles_.push_back(triangles_of(part));
    const std::size_t of_part = is_polygon(part) ? part.loops[0].size() : triangles_[holed++].size();
    corners += of_part;
    cells += is_polygon(part) ? 1 : of_part / 3;
  });
  BodyGrid grid(points, corners, cells);
  holed = 0;
  std::vector<std::int64_t> ring;
  over_parts(frame, [&](std::size_t number, const BodyPart& part) {
    const FrameBody& body = frame.bodies[number];
    const std::int64_t first = grid.add_points(part, frame.origin);
    if (is_polygon(part)) {
      ring.resize(part.loops[0].size());
      std::iota(ring.begin(), ring.end(), first);
      grid.add_cell(CellType::polygon, ring, body, number, part);
      return;
    }
    const std::vector<std::int64_t>& triangles = triangles_[holed++];
    for (std::size_t k = 0; k < triangles.size(); k += 3) {
      const std::array triangle{first + triangles[k], first + triangles[k + 1], first + triangles[k + 2]};
      grid.add_cell(CellType::triangle, triangle, body, number, part);
    }
  });
  return grid.take();
}

void FrameWriter::add(const Frame& frame) {
  const std::string bodies = fmt::format("frames/frame_{:06}.vtu", count_);
  const std::string contacts = fmt::format("frames/contacts_{:06}.vtu", count_);
  write_whole_file(folder_ / bodies, vtu_text(body_grid(frame), frame.time));
  write_whole_file(folder_ / contacts, vtu_text(contact_grid(frame), frame.time));
  entries_ += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, bodies);
  entries_ += fmt::format("<DataSet timestep=\"{}\" part=\"1\" file=\"{}\"/>\n", frame.time, contacts);
  write_list();
  ++count_;
}

std::uint64_t FrameWriter::bytes_of(const Frame& frame) {
  FrameWriter writer;
  return vtu_text(writer.body_grid(frame), frame.time).size() +
         vtu_text(contact_grid(frame), frame.time).size();
}

void FrameWriter::write_list() const {
  write_whole_file(folder_ / "frames.pvd",
                   "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                   "byte_order=\"LittleEndian\">\n<Collection>\n" +
                       entries_ + "</Collection>\n</VTKFile>\n");
}

void FrameWriter::exchange(Archive& archive) {
  archive(count_);
  archive(entries_);
  archive(triangles_);
  if (archive.reading()) write_list();
}

}  // namespace talus
