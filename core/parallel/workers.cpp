#include "parallel/workers.hpp"

#include "files/input_error.hpp"
#include "parallel/subnormals.hpp"

#include <fmt/format.h>

#include <system_error>

namespace talus {
namespace {

constexpr int spins = 4000;  ///< some ten microseconds: longer than any stretch between two loops of a step
constexpr int yields = 200;
/// Some microseconds for a thread that is at work to do its part. Whoever helps it sooner fetches the values
/// of the part from another core, and the other fetches them back in the next loop.
constexpr int patience = 200;

/// A loop, of which 2^39 are told from each other, and chunks of it.
constexpr std::uint64_t counted(std::uint64_t loop, std::uint64_t chunks) {
  return loop << 24 | chunks;
}
constexpr std::uint64_t chunks_of(std::uint64_t count) {
  return count & 0xFFFFFF;
}
/// How many loops after the one of the count; negative: before.
constexpr std::int64_t loops_since(std::uint64_t count, std::uint64_t loop) {
  return static_cast<std::int64_t>((loop << 24) - (count & ~std::uint64_t{0xFFFFFF})) >> 24;
}

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

Workers::Workers(int threads)
    : taken_(std::make_unique<Count[]>(static_cast<std::size_t>(threads))),
      done_(std::make_unique<Count[]>(static_cast<std::size_t>(threads))) {
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
  order_.edition.fetch_add(2);
  order_.edition.notify_all();
  for (std::thread& other : others_) other.join();
}

void Workers::share(std::size_t chunks, Call call, const void* context) {
  const Loop loop{order_.number.load(std::memory_order_relaxed) + 1, chunks, call, context};
  order_.edition.store(order_.edition.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  order_.number.store(loop.number, std::memory_order_relaxed);
  order_.chunks.store(chunks, std::memory_order_relaxed);
  order_.call.store(call, std::memory_order_relaxed);
  order_.context.store(context, std::memory_order_relaxed);
  order_.edition.fetch_add(1);
  order_.edition.notify_all();
  take_part(loop, 0);
  for (int i = 0; !are_done(loop); ++i) {
    if (i < spins) {
      relax();
    } else {
      std::this_thread::yield();
    }
  }
}

void Workers::serve(std::size_t number) {
  const NoSubnormals as_the_caller;
  for (std::uint32_t seen = 0;;) {
    std::uint32_t now = order_.edition.load(std::memory_order_acquire);
    for (int i = 0; now == seen || now % 2 != 0; ++i) {
      if (i < spins) {
        relax();
      } else if (i < spins + yields) {
        std::this_thread::yield();
      } else {
        order_.edition.wait(now, std::memory_order_acquire);
      }
      now = order_.edition.load(std::memory_order_acquire);
    }
    if (closing_.load(std::memory_order_relaxed)) return;
    const Loop loop{
        order_.number.load(std::memory_order_relaxed), order_.chunks.load(std::memory_order_relaxed),
        order_.call.load(std::memory_order_relaxed), order_.context.load(std::memory_order_relaxed)};
    std::atomic_thread_fence(std::memory_order_acquire);
    if (order_.edition.load(std::memory_order_relaxed) != now) continue;
    seen = now;
    take_part(loop, number);
  }
}

/// Parts are alike in every loop and made of neighbours, so that what a thread touched in one loop is near it
/// in the next.
std::size_t Workers::begin_of_part(const Loop& loop, std::size_t part) const {
  return loop.chunks * part / (others_.size() + 1);
}

/// The next chunk of a part. As long as one is left its loop goes on, and what it refers to is there; who
/// comes too late finds all taken, or a later loop.
bool Workers::take(const Loop& loop, std::size_t part, std::size_t& chunk) {
  const std::size_t begin = begin_of_part(loop, part), count = begin_of_part(loop, part + 1) - begin;
  std::atomic<std::uint64_t>& taken = taken_[part].loop_and_chunks;
  std::uint64_t now = taken.load(std::memory_order_relaxed);
  for (;;) {
    const std::int64_t later = loops_since(now, loop.number);
    const std::uint64_t before = later > 0 ? 0 : chunks_of(now);
    if (later < 0 || before >= count) return false;
    if (!taken.compare_exchange_weak(now, counted(loop.number, before + 1), std::memory_order_relaxed))
      continue;
    chunk = begin + before;
    return true;
  }
}

/// Whether there may be something left to do of the part of a thread. Waits for it, not for long, and not at
/// all for one that was not there for the loop before, because another program has its core. What it has
/// taken is not looked at for nothing: the line would have to come back to it for the next loop.
bool Workers::wants_help(const Loop& loop, std::size_t thread) const {
  for (int i = 0; i < patience; ++i) {
    const std::int64_t behind =
        loops_since(done_[thread].loop_and_chunks.load(std::memory_order_relaxed), loop.number);
    if (behind <= 0) return false;
    if (behind > 1) return true;
    relax();
  }
  return true;
}

/// First the thread's own part, then what is left of those of others.
void Workers::take_part(const Loop& loop, std::size_t thread) {
  const std::size_t all = others_.size() + 1;
  std::uint64_t done = 0;
  for (std::size_t i = 0; i < all; ++i) {
    const std::size_t part = (thread + i) % all;
    if (i > 0 && !wants_help(loop, part)) continue;
    for (std::size_t chunk = 0; take(loop, part, chunk); ++done) loop.call(loop.context, chunk, thread);
    // Also of one that came too late: it was there.
    done_[thread].loop_and_chunks.store(counted(loop.number, done), std::memory_order_release);
  }
}

bool Workers::are_done(const Loop& loop) const {
  std::uint64_t done = 0;
  for (std::size_t i = 0; i <= others_.size(); ++i) {
    const std::uint64_t count = done_[i].loop_and_chunks.load(std::memory_order_acquire);
    if (loops_since(count, loop.number) == 0) done += chunks_of(count);
  }
  return done == loop.chunks;
}

}  // namespace talus
