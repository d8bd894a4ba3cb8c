#include "output/frame.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "geometry/triangulate.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace talus {

namespace {

std::string bodies_name(std::uint64_t frame) {
  return fmt::format("frames/frame_{:06}.vtu", frame);
}

std::string contacts_name(std::uint64_t frame) {
  return fmt::format("frames/contacts_{:06}.vtu", frame);
}

void refuse_absent(const std::filesystem::path& file) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file, none);
  if (none || size == 0)
    throw InputError(
        fmt::format("'{}' is not what the run left: it is {}; put it back, or run the scene anew",
                    file.string(), none ? "gone" : "empty"));
}

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

  /// The next body, and the numbers of its points; none: all differ.
  void begin_body(std::span<const std::uint32_t> numbers) {
    first_ = points();
    numbers_ = numbers;
  }

  /// The points of a part that are not there yet; its cells come next. Returns the numbers of all in the
  /// grid, until the next call.
  std::span<const std::int64_t> add_points(const BodyPart& part, Vec2 origin) {
    part_.clear();
    for (const std::vector<PartPoint>& loop : part.loops) {
      for (const PartPoint& point : loop) {
        if (numbers_.empty()) {
          part_.push_back(points());
        } else {
          part_.push_back(first_ + numbers_.front());
          numbers_ = numbers_.subspan(1);
        }
        if (part_.back() < points()) continue;
        append(grid_.points, origin + point.position);
        append(displacement_, point.displacement);
        append(velocity_, point.velocity);
      }
    }
    return part_;
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
  std::int64_t points() const { return static_cast<std::int64_t>(grid_.points.size() / 3); }

  Grid grid_;
  std::int64_t first_ = 0;                  ///< point of the body
  std::span<const std::uint32_t> numbers_;  ///< of those of its points that are still to come
  std::vector<std::int64_t> part_;
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
  std::vector<double> normal, tangential, moment, penetration;
  std::vector<std::int32_t> slipping, body_a, body_b;
  for (const Contact& contact : frame.contacts) {
    const std::array corner{static_cast<std::int64_t>(grid.points.size() / 3)};
    grid.add_cell(CellType::vertex, corner);
    append(grid.points, frame.origin + contact.point);
    append(normal, contact.normal_force);
    append(tangential, contact.tangential_force);
    moment.push_back(contact.moment);
    penetration.push_back(contact.penetration);
    slipping.push_back(contact.slipping ? 1 : 0);
    body_a.push_back(static_cast<std::int32_t>(contact.body_a));
    body_b.push_back(static_cast<std::int32_t>(contact.body_b));
  }
  grid.point_data = array_list(
      GridArray{"normal_force", 3, std::move(normal)},
      GridArray{"tangential_force", 3, std::move(tangential)}, GridArray{"moment", 1, std::move(moment)},
      GridArray{"penetration", 1, std::move(penetration)}, GridArray{"slipping", 1, std::move(slipping)},
      GridArray{"body_a", 1, std::move(body_a)}, GridArray{"body_b", 1, std::move(body_b)});
  return grid;
}

PointNumbers point_numbers(const Simulation& simulation) {
  PointNumbers numbers;
  for (std::size_t i = 0; i < simulation.scene().bodies.size(); ++i)
    numbers.push_back(simulation.distinct_points(i));
  return numbers;
}

FrameWriter::FrameWriter(const std::filesystem::path& folder, PointNumbers numbers)
    : folder_(folder), numbers_(std::move(numbers)) {
  std::filesystem::create_directories(folder_ / "frames");
}

Grid FrameWriter::body_grid(const Frame& frame) {
  std::size_t points = 0, corners = 0, cells = 0, holed = 0;
  for (const FrameBody& body : frame.bodies) {
    for (const BodyPart& part : body.parts) {
      for (const std::vector<PartPoint>& loop : part.loops) points += loop.size();
      if (!is_polygon(part) && count_ == 0) triangles_.push_back(triangles_of(part));
      const std::size_t of_part = is_polygon(part) ? part.loops[0].size() : triangles_[holed++].size();
      corners += of_part;
      cells += is_polygon(part) ? 1 : of_part / 3;
    }
  }
  BodyGrid grid(points, corners, cells);
  holed = 0;
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const FrameBody& body = frame.bodies[i];
    grid.begin_body(numbers_.empty() ? std::span<const std::uint32_t>{} : numbers_[i]);
    for (const BodyPart& part : body.parts) {
      const std::span<const std::int64_t> at = grid.add_points(part, frame.origin);
      if (is_polygon(part)) {
        grid.add_cell(CellType::polygon, at, body, i, part);
        continue;
      }
      for (std::span<const std::int64_t> left = triangles_[holed++]; !left.empty(); left = left.subspan(3)) {
        const auto corner = [&](std::size_t k) { return at[static_cast<std::size_t>(left[k])]; };
        const std::array triangle{corner(0), corner(1), corner(2)};
        grid.add_cell(CellType::triangle, triangle, body, i, part);
      }
    }
  }
  return grid.take();
}

void FrameWriter::add(const Frame& frame) {
  const std::string bodies = bodies_name(count_), contacts = contacts_name(count_);
  write_whole_file(folder_ / bodies, vtu_text(body_grid(frame), frame.time));
  write_whole_file(folder_ / contacts, vtu_text(contact_grid(frame), frame.time));
  entries_ += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, bodies);
  entries_ += fmt::format("<DataSet timestep=\"{}\" part=\"1\" file=\"{}\"/>\n", frame.time, contacts);
  write_list();
  ++count_;
}

void FrameWriter::flush_to_disk() {
  if (count_ == 0) return;
  for (; flushed_ < count_; ++flushed_) {
    for (const std::string& name : {bodies_name(flushed_), contacts_name(flushed_)})
      talus::flush_to_disk(folder_ / name);
  }
  talus::flush_to_disk(folder_ / "frames");
  talus::flush_to_disk(folder_ / "frames.pvd");
}

std::uint64_t FrameWriter::bytes_of(const Frame& frame, PointNumbers numbers) {
  FrameWriter writer;
  writer.numbers_ = std::move(numbers);
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
  if (!archive.reading()) return;
  for (std::uint64_t frame = 0; frame < count_; ++frame) {
    refuse_absent(folder_ / bodies_name(frame));
    refuse_absent(folder_ / contacts_name(frame));
  }
  flushed_ = count_;
  write_list();
}

}  // namespace talus
