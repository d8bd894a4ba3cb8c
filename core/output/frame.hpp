#pragma once

#include "archive/archive.hpp"
#include "output/vtu.hpp"
#include "simulation/simulation.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

struct FrameBody {
  std::vector<BodyPart> parts;
  std::uint32_t material;
  double speed;  ///< m/s, of the centre of mass
};

/// All that a picture of one instant shows.
struct Frame {
  double time = 0;  ///< s
  Vec2 origin;      ///< m, added to positions on writing
  std::vector<FrameBody> bodies;
  std::vector<Contact> contacts;

  bool finite() const;  ///< whether all positions are numbers
};

Frame sample_frame(const Simulation& simulation);

/// [body][point] which points of the parts of a body are one and the same (see
/// Simulation::distinct_points()); empty where there are none such.
using PointNumbers = std::vector<std::vector<std::uint32_t>>;
PointNumbers point_numbers(const Simulation& simulation);

/// Writes `frames.pvd` and, beside it, `frames/frame_000000.vtu` (bodies) and `frames/contacts_000000.vtu`
/// (contact forces as points). The .pvd lists only whole files and is itself whole at any moment.
class FrameWriter {
 public:
  FrameWriter(const std::filesystem::path& folder, PointNumbers numbers);

  void add(const Frame& frame);
  /// Size of the files of such a frame.
  static std::uint64_t bytes_of(const Frame& frame, PointNumbers numbers);

  /// Files of frames written so far outlive a failure of the power.
  void flush_to_disk();

  /// What was written so far; taken out of an archive it is what the .pvd lists from now on. Throws
  /// InputError where a file of it is gone or empty.
  void exchange(Archive& archive);

 private:
  FrameWriter() = default;
  void write_list() const;
  Grid body_grid(const Frame& frame);

  std::filesystem::path folder_;
  PointNumbers numbers_;
  std::uint64_t count_ = 0, flushed_ = 0;  ///< frames; of these surely on the disk
  std::string entries_;                    ///< DataSet lines of the .pvd
  /// [part with holes][3 * triangle + corner], as in the first frame
  std::vector<std::vector<std::int64_t>> triangles_;
};

Grid contact_grid(const Frame& frame);

}  // namespace talus
