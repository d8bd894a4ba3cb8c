#include "parallel/workers.hpp"

#include "output/input_error.hpp"

#include <fmt/format.h>

#include <system_error>

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

Workers::Workers(int threads) : parts_(std::make_unique<Part[]>(static_cast<std::size_t>(threads))) {
  others_.reserve(static_cast<std::size_t>(threads) - 1);
  try {
    for (int i = 1; i < threads; ++i) others_.emplace_back([this, i] { serve(static_cast<std::size_t>(i)); });
  } catch (const std::system_error& failure) {
    const std::size_t started = others_.size() + 1;
    close();
    throw InputError(fmt::format("of {} threads the system started {}, no more: {}; take fewer by --threads",
                                 threads, started, failure.code().message()));
  }
}

Workers::~Workers() {
  close();
}

void Workers::close() {
  closing_.store(true, std::memory_order_relaxed);
  round_.fetch_add(1);
  round_.notify_all();
  for (std::thread& other : others_) other.join();
}

/// Neighbouring chunks stay together, so that what a thread touched in one loop is near it in the next.
void Workers::share(std::size_t chunks, Call call, const void* context) {
  call_ = call;
  context_ = context;
  done_.store(0, std::memory_order_relaxed);
  const std::size_t all = others_.size() + 1;
  for (std::size_t i = 0; i < all; ++i) {
    parts_[i].end = chunks * (i + 1) / all;
    parts_[i].next.store(chunks * i / all, std::memory_order_relaxed);
  }
  round_.fetch_add(1);
  round_.notify_all();
  take_part(0);
  const auto wait_until = [](const auto& reached) {
    for (int i = 0; !reached(); ++i) {
      if (i < spins) {
        relax();
      } else {
        std::this_thread::yield();
      }
    }
  };
  wait_until([&] { return done_.load(std::memory_order_acquire) == chunks; });
  // Whoever enters from now on sees that the loop is over, or is seen here: both orders are those of one
  // sequence of all threads.
  round_.fetch_add(1);
  wait_until([&] { return inside_.load() == 0; });
}

void Workers::serve(std::size_t number) {
  for (std::uint32_t seen = 0;;) {
    std::uint32_t now = round_.load(std::memory_order_acquire);
    for (int i = 0; now == seen || now % 2 == 0; ++i) {
      if (i < spins) {
        relax();
      } else if (i < spins + yields) {
        std::this_thread::yield();
      } else {
        round_.wait(now, std::memory_order_acquire);
      }
      now = round_.load(std::memory_order_acquire);
    }
    inside_.fetch_add(1);
    seen = round_.load();
    if (seen % 2 != 0) take_part(number);
    inside_.fetch_sub(1, std::memory_order_release);
    if (closing_.load(std::memory_order_relaxed)) return;
  }
}

/// First the thread's own part, then what is left of those of others.
void Workers::take_part(std::size_t number) {
  const std::size_t all = others_.size() + 1;
  std::size_t done = 0;
  for (std::size_t i = 0; i < all; ++i) {
    Part& part = parts_[(number + i) % all];
    while (part.next.load(std::memory_order_relaxed) < part.end) {
      const std::size_t chunk = part.next.fetch_add(1, std::memory_order_relaxed);
      if (chunk >= part.end) break;
      call_(context_, chunk, number);
      ++done;
    }
  }
  if (done != 0) done_.fetch_add(done, std::memory_order_release);
}

}  // namespace talus
