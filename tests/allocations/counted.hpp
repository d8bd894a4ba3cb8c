#pragma once

#include <cstdint>

namespace talus {

/// Counts what is asked of the heap by anybody in this process, libraries loaded at run time included.
class CountedAllocations {
 public:
  CountedAllocations();
  ~CountedAllocations();
  CountedAllocations(const CountedAllocations&) = delete;
  CountedAllocations& operator=(const CountedAllocations&) = delete;

  std::uint64_t so_far() const;
};

}  // namespace talus
