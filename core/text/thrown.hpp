#pragma once

#include <exception>
#include <string>

namespace talus {

/// What the exception at hand says, also for what std::terminate() calls.
inline std::string words_of_thrown() {
  try {
    if (const std::exception_ptr problem = std::current_exception()) std::rethrow_exception(problem);
  } catch (const std::exception& problem) {
    return problem.what();
  } catch (...) {
  }
  return "something that is no std::exception";
}

}  // namespace talus
