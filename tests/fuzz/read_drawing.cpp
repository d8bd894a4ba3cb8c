#include "targets.hpp"

#include "blocks/dxf.hpp"
#include "files/input_error.hpp"

#include <cmath>

namespace talus::fuzz {

void read_drawing(std::string_view bytes) {
  try {
    for (const DxfLine& line : read_dxf_text(bytes, "joints.dxf").lines) {
      demand(line.points.size() >= 2, "a line without length");
      for (const Vec2 point : line.points)
        demand(std::isfinite(point.x) && std::isfinite(point.y), "a point that is nowhere");
    }
  } catch (const InputError&) {
  }
}

}  // namespace talus::fuzz
