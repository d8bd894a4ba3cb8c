// talus::Workers on OpenMP, for comparison. Linked in place of that of the library.

#include "parallel/workers.hpp"

#include <omp.h>

namespace talus {

/// The header takes the number of threads from `others_`: here they end at once, and OpenMP has its own.
Workers::Workers(int threads) {
  for (int i = 1; i < threads; ++i) others_.emplace_back([] {});
}

Workers::~Workers() {
  for (std::thread& other : others_) other.join();
}

void Workers::share(std::size_t chunks, Call call, const void* context) {
  const std::size_t all = others_.size() + 1;
#pragma omp parallel num_threads(static_cast <int>(all))
  {
    const auto number = static_cast<std::size_t>(omp_get_thread_num());
    for (std::size_t chunk = chunks * number / all; chunk < chunks * (number + 1) / all; ++chunk)
      call(context, chunk, number);
  }
}

}  // namespace talus
