#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <type_traits>
#include <vector>

namespace talus {

/// Threads that share loops many times per millisecond. They wait between loops by spinning, then by giving
/// the core away, then asleep: a loop costs to hand out what some lines of the cache take from one core to
/// another while a run steps, and nothing is burnt while it writes. Nobody waits long for a thread that has
/// not come yet, because another program has its core: those that are there do its part.
class Workers {
 public:
  /// The caller of over() is one of the `threads`. Throws InputError where the system has no room for so
  /// many.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return static_cast<int>(others_.size()) + 1; }

  /// Calls task(chunk, begin, end), or task(chunk, begin, end, thread), for chunks of `size` that cover
  /// [0, count), each on some thread. Which one cannot be seen in a result that is kept chunk by chunk. Tasks
  /// must not throw.
  template <class Task>
  void over(std::size_t count, std::size_t size, const Task& task) {
    const std::size_t chunks = (count + size - 1) / size;
    const auto run = [&](std::size_t chunk, std::size_t thread) {
      const std::size_t begin = chunk * size, end = begin + size < count ? begin + size : count;
      if constexpr (std::is_invocable_v<Task, std::size_t, std::size_t, std::size_t, std::size_t>) {
        task(chunk, begin, end, thread);
      } else {
        (void)thread;
        task(chunk, begin, end);
      }
    };
    if (others_.empty() || chunks < 2 || chunks > most_chunks) {
      for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk, 0);
      return;
    }
    share(
        chunks,
        [](const void* context, std::size_t chunk, std::size_t thread) {
          (*static_cast<decltype(&run)>(context))(chunk, thread);
        },
        &run);
  }

 private:
  static constexpr std::size_t most_chunks = (std::size_t{1} << 24) - 1;  ///< that a Count has room for

  using Call = void (*)(const void* context, std::size_t chunk, std::size_t thread);
  void close();
  void share(std::size_t chunks, Call call, const void* context);
  void serve(std::size_t number);

  struct Loop {
    std::uint64_t number;  ///< counted from 1
    std::size_t chunks;
    Call call;
    const void* context;
  };
  /// The present loop, on a line of the cache that only the caller of over() writes: others have all of it at
  /// once.
  struct alignas(64) Order {
    std::atomic<std::uint32_t> edition{0};  ///< odd while the rest is being written
    std::atomic<std::uint64_t> number{0};
    std::atomic<std::size_t> chunks{0};
    std::atomic<Call> call{nullptr};
    std::atomic<const void*> context{nullptr};
  };
  /// Of a loop, on a line of its own: chunks taken of the part that a thread begins with, or those it has
  /// done.
  struct alignas(64) Count {
    std::atomic<std::uint64_t> loop_and_chunks{0};
  };

  std::size_t begin_of_part(const Loop& loop, std::size_t part) const;
  bool take(const Loop& loop, std::size_t part, std::size_t& chunk);
  bool wants_help(const Loop& loop, std::size_t thread) const;
  bool are_done(const Loop& loop) const;
  void take_part(const Loop& loop, std::size_t thread);

  Order order_;
  std::unique_ptr<Count[]> taken_, done_;  ///< [thread]
  std::atomic<bool> closing_{false};
  std::vector<std::thread> others_;
};

}  // namespace talus
