#pragma once

#include <cstdint>
#include <string>

namespace talus {

/// What a contact law did that no law may do: found in its loads and reports, in words.
struct LawFault {
  std::string found;     ///< "" if there is nothing to find
  bool of_pair = false;  ///< whether it is known between which bodies
  std::uint32_t a = 0, b = 0;
};

}  // namespace talus
