#include "parallel/large_pages.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <memory>

namespace talus {

#if defined(__linux__)

void prefer_large_pages(const void* data, std::size_t bytes) {
  constexpr std::size_t page = std::size_t{1} << 21;
  constexpr int collapse = 25;  // MADV_COLLAPSE, Linux 6.1, which not all headers know
  void* begin = const_cast<void*>(data);
  if (std::align(page, page, begin, bytes) == nullptr) return;
  const std::size_t whole = bytes / page * page;
  // Both are wishes: the first for a system that joins pages in its own time, the second for one that can at
  // once.
  (void)madvise(begin, whole, MADV_HUGEPAGE);
  (void)madvise(begin, whole, collapse);
}

#else

void prefer_large_pages(const void* /*data*/, std::size_t /*bytes*/) {}

#endif

}  // namespace talus
