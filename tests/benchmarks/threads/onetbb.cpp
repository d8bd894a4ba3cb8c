// talus::Workers on oneTBB, for comparison. Linked in place of that of the library.

#include "parallel/workers.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>

namespace talus {

/// The header takes the number of threads from `others_`: here they end at once, and oneTBB has its own, one
/// for each core.
Workers::Workers(int threads) {
  for (int i = 1; i < threads; ++i) others_.emplace_back([] {});
}

Workers::~Workers() {
  for (std::thread& other : others_) other.join();
}

void Workers::share(std::size_t chunks, Call call, const void* context) {
  const std::size_t all = others_.size() + 1;
  oneapi::tbb::parallel_for(
      std::size_t{0}, all,
      [&](std::size_t number) {
        for (std::size_t chunk = chunks * number / all; chunk < chunks * (number + 1) / all; ++chunk)
          call(context, chunk, number);
      },
      oneapi::tbb::static_partitioner());
}

}  // namespace talus
