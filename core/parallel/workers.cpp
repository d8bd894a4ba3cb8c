#include "parallel/workers.hpp"

namespace talus {
namespace {

constexpr int spins = 4000;  ///< some ten microseconds: longer than any stretch between two loops of a step
constexpr int yields = 200;

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

Workers::Workers(int threads) {
  for (int i = 1; i < threads; ++i) others_.emplace_back([this, i] { serve(static_cast<std::size_t>(i)); });
}

Workers::~Workers() {
  closing_.store(true, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& other : others_) other.join();
}

void Workers::share(std::size_t chunks, Call call, const void* context) {
  chunks_ = chunks;
  call_ = call;
  context_ = context;
  working_.store(static_cast<std::uint32_t>(others_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  take_part(0);
  for (int i = 0; working_.load(std::memory_order_acquire) != 0; ++i) {
    if (i < spins) {
      relax();
    } else {
      std::this_thread::yield();
    }
  }
}

void Workers::serve(std::size_t number) {
  for (std::uint32_t seen = 0;; ++seen) {
    for (int i = 0; round_.load(std::memory_order_acquire) == seen; ++i) {
      if (i < spins) {
        relax();
      } else if (i < spins + yields) {
        std::this_thread::yield();
      } else {
        round_.wait(seen, std::memory_order_acquire);
      }
    }
    if (closing_.load(std::memory_order_relaxed)) return;
    take_part(number);
    working_.fetch_sub(1, std::memory_order_release);
  }
}

/// Neighbouring chunks stay together, so that what a thread touched in one loop is near it in the next.
void Workers::take_part(std::size_t number) {
  const std::size_t all = others_.size() + 1;
  const std::size_t begin = chunks_ * number / all, end = chunks_ * (number + 1) / all;
  for (std::size_t chunk = begin; chunk < end; ++chunk) call_(context_, chunk, number);
}

}  // namespace talus
