#pragma once

#include "report/frames.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// The frames of a run, read back and made small enough for a page: shapes as in the first frame, and for
/// each frame how every part has moved, in steps too small to be seen.
struct Film {
  std::vector<double> time;  ///< s
  std::size_t every = 1;     ///< of so many frames one is kept
  std::size_t frames = 0;    ///< there are in the folder

  std::vector<std::uint32_t> part_start;  ///< [part + 1] into x and y
  std::vector<std::uint32_t> part_body;   ///< [part]
  std::vector<double> x, y;               ///< m, corners in the first frame, without `origin`
  double origin_x = 0, origin_y = 0;      ///< m
  /// [part] whether it is drawn as a rigid one: it strains by less than can be seen
  std::vector<std::uint8_t> rigid;

  double quantum = 0;                           ///< m, of displacements
  double largest_speed = 0, largest_shear = 0;  ///< m/s; Pa, half the difference of the principal stresses
  /// Sixteen-bit second differences over time, for each rigid part of x, y (in quanta) and angle (65536 to a
  /// turn), then for each corner of the others of x and y: first all low bytes, then all high ones. After
  /// them eight-bit differences of speed and of shear stress of each part, 255 to the largest.
  std::string motion;

  std::vector<ContactSums> contacts;  ///< [frame]
};

/// Reads frames.pvd and what it lists. Without frames, or with more parts than a page can show, the film has
/// no times. Throws InputError where a file is not as talus writes it.
Film read_film(const std::filesystem::path& folder);

}  // namespace talus
