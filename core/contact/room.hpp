#pragma once

#include <cstddef>
#include <vector>

namespace talus {

/// An eighth more than is wanted: doubling would take twice the memory, no more at all new memory at most
/// searches.
template <class T>
void make_room_in(std::vector<T>& values, std::size_t wanted) {
  if (wanted > values.capacity()) values.reserve(wanted + wanted / 8);
}

/// One more, by the same rule.
template <class T>
void append_to(std::vector<T>& values, const T& value) {
  make_room_in(values, values.size() + 1);
  values.push_back(value);
}

}  // namespace talus
