#include "parallel/large_pages.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstdint>

namespace talus {

#if defined(__linux__)

void prefer_large_pages(const void* data, std::size_t bytes) {
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  constexpr int collapse = 25;  // MADV_COLLAPSE, Linux 6.1, which not all headers know
  const auto first = reinterpret_cast<std::uintptr_t>(data), end = (first + bytes) / page * page;
  const std::uintptr_t begin = (first + page - 1) / page * page;
  if (begin >= end) return;
  // Both are wishes: the first for a system that joins pages in its own time, the second for one that can at
  // once.
  void* const from = reinterpret_cast<void*>(begin);
  (void)madvise(from, end - begin, MADV_HUGEPAGE);
  (void)madvise(from, end - begin, collapse);
}

#else

void prefer_large_pages(const void* /*data*/, std::size_t /*bytes*/) {}

#endif

}  // namespace talus
