#pragma once

#include <boost/align/aligned_allocator.hpp>

#include <cstddef>
#include <vector>

namespace talus {

/// From the start of a line of the cache on.
template <class T>
using InLines = std::vector<T, boost::alignment::aligned_allocator<T, 64>>;

/// An eighth more than is wanted: doubling would take twice the memory, no more at all new memory at most
/// searches.
template <class T, class Allocator>
void make_room_in(std::vector<T, Allocator>& values, std::size_t wanted) {
  if (wanted > values.capacity()) values.reserve(wanted + wanted / 8);
}

/// One more, by the same rule.
template <class T>
void append_to(std::vector<T>& values, const T& value) {
  make_room_in(values, values.size() + 1);
  values.push_back(value);
}

}  // namespace talus
