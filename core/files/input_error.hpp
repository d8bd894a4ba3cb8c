#pragma once

#include <stdexcept>

namespace talus {

/// Something the user gave is wrong and is no scene: a reference file, a --vary list, an output folder in
/// use.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace talus
