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
/// the core away, then asleep: a loop costs tens of nanoseconds to hand out while a run steps, and nothing is
/// burnt while it writes. Nobody waits for a thread that has not come yet, because another program has its
/// core: those that are there do its part.
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
    if (others_.empty() || chunks < 2) {
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
  using Call = void (*)(const void* context, std::size_t chunk, std::size_t thread);
  void close();
  void share(std::size_t chunks, Call call, const void* context);
  void serve(std::size_t number);
  void take_part(std::size_t number);

  /// Chunks that one thread begins with, on a line of the cache of their own.
  struct alignas(64) Part {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  Call call_ = nullptr;
  const void* context_ = nullptr;
  std::unique_ptr<Part[]> parts_;         ///< [thread]
  std::atomic<std::uint32_t> round_{0};   ///< odd while there is a loop to take part in
  std::atomic<std::uint32_t> inside_{0};  ///< others that may be looking at the present loop
  std::atomic<std::size_t> done_{0};      ///< chunks
  std::atomic<bool> closing_{false};
  std::vector<std::thread> others_;
};

}  // namespace talus
