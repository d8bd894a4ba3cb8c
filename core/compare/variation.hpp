#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// What varies between the runs of a comparison: "/contact/model=overlap_area,vertex_edge". The first value
/// is the baseline. A comma within brackets, braces or quotation marks belongs to a value.
struct Variation {
  std::string pointer;
  std::vector<std::string> values;

  bool of_time() const;  ///< whether the time settings vary, so that the runs keep their own time steps
};

/// Throws InputError.
Variation parse_variation(std::string_view text);

/// Name of the subfolder for the run of a value: the value with all but letters, digits and . + - _ replaced,
/// and with a hash for its end where it is long, or has letters that are not ASCII.
std::string folder_of_value(std::string_view value);

}  // namespace talus
