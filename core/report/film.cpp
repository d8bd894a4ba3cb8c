#include "report/film.hpp"

#include "files/input_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus {
namespace {

constexpr std::size_t most_parts = 20000;
constexpr std::size_t most_part_frames = 200000;  ///< some 3 MB of page for two runs
constexpr double invisible = 1.0 / 4000;          ///< share of the width of the picture
constexpr double levels = 32000;                  ///< of displacement

/// One frame, corners part after part.
struct Picture {
  std::vector<double> x, y, speed, shear;
};

Picture picture_of(const Grid& grid) {
  Picture picture;
  for (const std::int64_t corner : grid.connectivity) {
    picture.x.push_back(grid.points[3 * static_cast<std::size_t>(corner)]);
    picture.y.push_back(grid.points[3 * static_cast<std::size_t>(corner) + 1]);
  }
  picture.speed = reals_of(grid.cell_data, "speed");
  const auto &xx = reals_of(grid.cell_data, "stress_xx"), &yy = reals_of(grid.cell_data, "stress_yy"),
             &xy = reals_of(grid.cell_data, "stress_xy");
  for (std::size_t i = 0; i < xx.size(); ++i) picture.shear.push_back(std::hypot((xx[i] - yy[i]) / 2, xy[i]));
  return picture;
}

/// How a part got from one picture to another as a rigid one, by least squares, and by how much it did not.
struct RigidMotion {
  double x, y, angle, miss;
};

RigidMotion rigid_motion(const Film& film, std::size_t part, const Picture& now) {
  const std::size_t begin = film.part_start[part], end = film.part_start[part + 1];
  const auto share = 1.0 / static_cast<double>(end - begin);
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  for (std::size_t i = begin; i < end; ++i) {
    x0 += film.x[i] * share, y0 += film.y[i] * share;
    x1 += (now.x[i] - film.origin_x) * share, y1 += (now.y[i] - film.origin_y) * share;
  }
  double dot = 0, cross = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const double px = film.x[i] - x0, py = film.y[i] - y0;
    const double qx = now.x[i] - film.origin_x - x1, qy = now.y[i] - film.origin_y - y1;
    dot += px * qx + py * qy;
    cross += px * qy - py * qx;
  }
  const double angle = std::atan2(cross, dot), c = std::cos(angle), s = std::sin(angle);
  double miss = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const double px = film.x[i] - x0, py = film.y[i] - y0;
    const double qx = now.x[i] - film.origin_x - x1, qy = now.y[i] - film.origin_y - y1;
    miss = std::max(miss, std::hypot(c * px - s * py - qx, s * px + c * py - qy));
  }
  return {x1 - x0, y1 - y0, angle, miss};
}

/// Sixteen-bit numbers over time as second differences, wrapping around.
class Columns {
 public:
  void add(const std::vector<long>& values) {
    std::uint16_t last = 0, before = 0;
    for (const long value : values) {
      const auto now = static_cast<std::uint16_t>(value);
      const auto second = static_cast<std::uint16_t>(now - last - (last - before));
      low_ += static_cast<char>(second & 255);
      high_ += static_cast<char>(second >> 8);
      before = last;
      last = now;
    }
  }
  std::string bytes() const {
    std::string bytes = low_;
    bytes += high_;
    return bytes;
  }

 private:
  std::string low_, high_;
};

void append_levels(std::string& bytes, const std::vector<Picture>& pictures, std::size_t part,
                   std::vector<double> Picture::*values, double largest) {
  unsigned char last = 0;
  for (const Picture& picture : pictures) {
    const double share = largest > 0 ? std::clamp((picture.*values)[part] / largest, 0.0, 1.0) : 0;
    const auto now = static_cast<unsigned char>(std::lround(255 * share));
    bytes += static_cast<char>(now - last);
    last = now;
  }
}

void take_shapes(const Grid& grid, Film& film) {
  const Picture first = picture_of(grid);
  film.origin_x = *std::min_element(first.x.begin(), first.x.end());
  film.origin_y = *std::min_element(first.y.begin(), first.y.end());
  for (std::size_t i = 0; i < first.x.size(); ++i) {
    film.x.push_back(first.x[i] - film.origin_x);
    film.y.push_back(first.y[i] - film.origin_y);
  }
  film.part_start.push_back(0);
  for (const std::int64_t end : grid.offsets) film.part_start.push_back(static_cast<std::uint32_t>(end));
  const std::vector<std::int32_t>& bodies = integers_of(grid.cell_data, "body");
  if (bodies.size() != grid.offsets.size()) throw InputError("a frame does not name its bodies");
  film.part_body.assign(bodies.begin(), bodies.end());
}

void pack_motion(const std::vector<Picture>& pictures, Film& film) {
  const std::size_t parts = film.part_body.size();
  const double width = *std::max_element(film.x.begin(), film.x.end()),
               height = *std::max_element(film.y.begin(), film.y.end()), extent = std::max(width, height);
  double farthest = 0;
  for (const Picture& picture : pictures) {
    for (std::size_t i = 0; i < film.x.size(); ++i) {
      farthest = std::max({farthest, std::abs(picture.x[i] - film.origin_x - film.x[i]),
                           std::abs(picture.y[i] - film.origin_y - film.y[i])});
    }
    film.largest_speed =
        std::max(film.largest_speed, *std::max_element(picture.speed.begin(), picture.speed.end()));
    film.largest_shear =
        std::max(film.largest_shear, *std::max_element(picture.shear.begin(), picture.shear.end()));
  }
  film.quantum = farthest > 0 ? farthest / levels : 1;
  const auto quanta = [&](double metres) { return std::lround(metres / film.quantum); };

  Columns columns;
  std::vector<long> x(pictures.size()), y(pictures.size()), angle(pictures.size());
  for (std::size_t part = 0; part < parts; ++part) {
    double miss = 0;
    for (std::size_t f = 0; f < pictures.size(); ++f) {
      const RigidMotion motion = rigid_motion(film, part, pictures[f]);
      x[f] = quanta(motion.x);
      y[f] = quanta(motion.y);
      angle[f] = std::lround(motion.angle / (2 * std::numbers::pi) * 65536);
      miss = std::max(miss, motion.miss);
    }
    film.rigid.push_back(miss <= invisible * extent ? 1 : 0);
    if (film.rigid.back() == 0) continue;
    columns.add(x);
    columns.add(y);
    columns.add(angle);
  }
  for (std::size_t part = 0; part < parts; ++part) {
    if (film.rigid[part] != 0) continue;
    for (std::size_t i = film.part_start[part]; i < film.part_start[part + 1]; ++i) {
      for (std::size_t f = 0; f < pictures.size(); ++f) {
        x[f] = quanta(pictures[f].x[i] - film.origin_x - film.x[i]);
        y[f] = quanta(pictures[f].y[i] - film.origin_y - film.y[i]);
      }
      columns.add(x);
      columns.add(y);
    }
  }
  film.motion = columns.bytes();
  for (std::size_t part = 0; part < parts; ++part)
    append_levels(film.motion, pictures, part, &Picture::speed, film.largest_speed);
  for (std::size_t part = 0; part < parts; ++part)
    append_levels(film.motion, pictures, part, &Picture::shear, film.largest_shear);
}

}  // namespace

Film read_film(const std::filesystem::path& folder) {
  Film film;
  const std::vector<ListedFrame> listed = listed_frames(folder);
  film.frames = listed.size();
  if (listed.empty()) return film;
  const Grid first = read_grid(listed[0].bodies);
  if (first.offsets.empty() || first.offsets.size() > most_parts) return film;
  film.every = std::max<std::size_t>(
      1, (listed.size() * first.offsets.size() + most_part_frames - 1) / most_part_frames);
  take_shapes(first, film);
  std::vector<Picture> pictures;
  for (std::size_t f = 0; f < listed.size(); ++f) {
    if (f % film.every != 0 && f + 1 != listed.size()) continue;
    pictures.push_back(picture_of(read_grid(listed[f].bodies)));
    if (pictures.back().x.size() != film.x.size())
      throw InputError("frames of one run differ in their parts");
    film.time.push_back(listed[f].time);
    film.contacts.push_back(contact_sums(read_grid(listed[f].contacts)));
  }
  pack_motion(pictures, film);
  return film;
}

}  // namespace talus
