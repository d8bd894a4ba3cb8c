#pragma once

#include <cstdint>

/// How often the components of libcounting.so were asked since the library was loaded. One thread.
struct AskedSoFar {
  std::uint64_t law = 0, pairs = 0;          ///< calls of evaluate(), and pairs in them
  std::uint64_t material = 0, elements = 0;  ///< likewise
  std::uint64_t cover = 0;                   ///< bodies that were covered
};
