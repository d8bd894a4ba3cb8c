#include "output/frame.hpp"

#include "output/triangulate.hpp"
#include "output/whole_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace talus {

namespace {

void append(std::vector<double>& values, Vec2 vector) {
  values.insert(values.end(), {vector.x, vector.y, 0.0});
}

/// A polygon as it is; with holes, triangles, since a VTK polygon has none.
std::vector<std::vector<std::int64_t>> cells_of(const BodyPart& body) {
  if (body.loops.size() == 1) {
    std::vector<std::int64_t> corners(body.loops[0].size());
    std::iota(corners.begin(), corners.end(), 0);
    return {corners};
  }
  std::vector<std::vector<Vec2>> loops;
  for (const std::vector<PartPoint>& loop : body.loops) {
    loops.emplace_back();
    for (const PartPoint& point : loop) loops.back().push_back(point.position);
  }
  std::vector<std::vector<std::int64_t>> cells;
  for (const auto& [a, b, c] : triangulate(loops)) cells.push_back({a, b, c});
  return cells;
}

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
    grid.add_cell(CellType::vertex, {static_cast<std::int64_t>(grid.points.size() / 3)});
    append(grid.points, {frame.origin.x + contact.point.x, frame.origin.y + contact.point.y});
    append(normal, contact.normal_force);
    append(tangential, contact.tangential_force);
    penetration.push_back(contact.penetration);
    slipping.push_back(contact.slipping ? 1 : 0);
    body_a.push_back(static_cast<std::int32_t>(contact.body_a));
    body_b.push_back(static_cast<std::int32_t>(contact.body_b));
  }
  grid.point_data = {{"normal_force", 3, normal},     {"tangential_force", 3, tangential},
                     {"penetration", 1, penetration}, {"slipping", 1, slipping},
                     {"body_a", 1, body_a},           {"body_b", 1, body_b}};
  return grid;
}

FrameWriter::FrameWriter(const std::filesystem::path& folder) : folder_(folder) {
  std::filesystem::create_directories(folder_ / "frames");
}

Grid FrameWriter::body_grid(const Frame& frame) {
  if (cells_.empty()) {
    for (const FrameBody& body : frame.bodies) {
      cells_.emplace_back();
      for (const BodyPart& part : body.parts) cells_.back().push_back(cells_of(part));
    }
  }
  Grid grid;
  std::vector<double> displacement, velocity, speed, stress_xx, stress_yy, stress_xy;
  std::vector<std::int32_t> material, number;
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const FrameBody& body = frame.bodies[i];
    for (std::size_t p = 0; p < body.parts.size(); ++p) {
      const BodyPart& part = body.parts[p];
      const auto first = static_cast<std::int64_t>(grid.points.size() / 3);
      for (const std::vector<PartPoint>& loop : part.loops) {
        for (const PartPoint& point : loop) {
          append(grid.points, {frame.origin.x + point.position.x, frame.origin.y + point.position.y});
          append(displacement, point.displacement);
          append(velocity, point.velocity);
        }
      }
      for (std::vector<std::int64_t> corners : cells_[i][p]) {
        for (std::int64_t& corner : corners) corner += first;
        grid.add_cell(part.loops.size() == 1 ? CellType::polygon : CellType::triangle, corners);
        speed.push_back(body.speed);
        stress_xx.push_back(part.stress[0]);
        stress_yy.push_back(part.stress[1]);
        stress_xy.push_back(part.stress[2]);
        material.push_back(static_cast<std::int32_t>(body.material));
        number.push_back(static_cast<std::int32_t>(i));
      }
    }
  }
  grid.point_data = {{"displacement", 3, displacement}, {"velocity", 3, velocity}};
  grid.cell_data = {{"speed", 1, speed},         {"stress_xx", 1, stress_xx}, {"stress_yy", 1, stress_yy},
                    {"stress_xy", 1, stress_xy}, {"material", 1, material},   {"body", 1, number}};
  return grid;
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
  archive(cells_);
  if (archive.reading()) write_list();
}

}  // namespace talus
