#include "machine/stopwatch.hpp"

#include <time.h>

namespace talus {

namespace {

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Elapsed read(CpuClock clock) {
  return {seconds(CLOCK_MONOTONIC),
          seconds(clock == CpuClock::process ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID)};
}

}  // namespace

Stopwatch::Stopwatch(CpuClock clock) : clock_(clock), start_(read(clock)) {}

Elapsed Stopwatch::elapsed() const {
  const Elapsed now = read(clock_);
  return {now.wall - start_.wall, now.cpu - start_.cpu};
}

}  // namespace talus
