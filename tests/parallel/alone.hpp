#pragma once

#include "parallel/workers.hpp"

namespace talus {

/// One thread, for what wants to be given some.
inline Workers& alone() {
  static Workers one(1);
  return one;
}

}  // namespace talus
