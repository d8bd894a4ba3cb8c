#include "archive/archive.hpp"

#include "files/input_error.hpp"

#include <cstring>

namespace talus {

void Archive::refuse() {
  throw InputError("the state that was kept does not belong to this scene");
}

void Archive::exchange(void* value, std::size_t size) {
  if (!reading_) {
    bytes_.append(static_cast<const char*>(value), size);
    return;
  }
  if (size > from_.size()) refuse();
  if (size > 0) std::memcpy(value, from_.data(), size);
  from_.remove_prefix(size);
}

std::size_t Archive::count(std::size_t size, std::size_t least) {
  std::uint64_t stored = size;
  exchange(&stored, sizeof stored);
  // Nobody reserves room for more than there is.
  if (reading_ && stored > from_.size() / least) refuse();
  return stored;
}

}  // namespace talus
