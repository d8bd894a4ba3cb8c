// Linked into each program of the preset `coverage`. Programs that share object files keep other copies of
// inline functions, and libgcov refuses to add up counters of different sets of functions: so each program,
// and what it loads, counts in a folder of its own. One that may write small files only (tests/faults) would
// leave a part of a file, to which no other can add: it does not count.

#include <sys/resource.h>

#include <cerrno>
#include <cstdlib>
#include <string>

namespace {

__attribute__((constructor)) void count_apart() {
  rlimit file_size{};
  if (getrlimit(RLIMIT_FSIZE, &file_size) != 0 || file_size.rlim_cur != RLIM_INFINITY) {
    setenv("GCOV_PREFIX", "/dev/null", 1);
    setenv("GCOV_ERROR_FILE", "/dev/null", 1);
    return;
  }
  const std::string folder = std::string(TALUS_COUNTERS "/") + program_invocation_short_name;
  setenv("GCOV_PREFIX", folder.c_str(), 1);
}

}  // namespace
