#pragma once

#include <cstddef>
#include <vector>

namespace talus {

/// Asks the system to keep these bytes in large pages, as far as whole ones lie within. Where a step goes
/// through more memory than the processor remembers the small pages of, finding pages takes a tenth of its
/// time. Does nothing where the system has none; values stay as they are.
void prefer_large_pages(const void* data, std::size_t bytes);

template <class T>
void prefer_large_pages(const std::vector<T>& values) {
  prefer_large_pages(values.data(), values.size() * sizeof(T));
}

}  // namespace talus
