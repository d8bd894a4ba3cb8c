#pragma once

#include "geometry/vec2.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A polyline of a drawing; a closed one repeats its first point.
struct DxfLine {
  std::string layer;
  std::vector<Vec2> points;  ///< as written, none twice in a row
};

struct DxfDrawing {
  std::vector<DxfLine> lines;
  int units = 0;                           ///< $INSUNITS of the header: 0 none, 6 metres
  std::map<std::string, int> passed_over;  ///< how often entities of other kinds stand in it
  std::map<std::string, int> flattened;    ///< how often lines that are taken leave the plane
  std::set<std::string> hidden_layers;     ///< that are switched off or frozen, whatever stands on them
};

/// Reads LINE, POLYLINE and LWPOLYLINE entities of model space from a DXF file (text), in the order of the
/// file; lines that are not level as seen from above. Throws InputError with file and line where it is no
/// DXF, or a polyline has arcs or stands in a plane other than that of the drawing; std::system_error when it
/// cannot be read.
DxfDrawing read_dxf(const std::filesystem::path& file);
DxfDrawing read_dxf_text(std::string_view text, const std::string& name);

}  // namespace talus
