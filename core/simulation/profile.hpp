#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

namespace talus {

/// Parts of a step, in their order.
enum class Phase { move, boundary, neighbours, contacts, loads, materials, velocities, books, checks };
inline constexpr std::size_t phase_count = 9;

/// "move", "boundary", ...
std::string_view name_of(Phase phase);

/// Seconds on the clock that each part of the steps has taken. Switched off it reads no clock.
class Profile {
 public:
  explicit Profile(bool on) : on_(on) {}

  bool on() const { return on_; }
  /// The part before, if any, ends here.
  void enter(Phase phase) {
    if (!on_) return;
    leave();
    running_ = true;
    phase_ = phase;
  }
  void leave() {
    if (!on_) return;
    const Clock::time_point now = Clock::now();
    if (running_)
      seconds_[static_cast<std::size_t>(phase_)] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
    running_ = false;
  }
  const std::array<double, phase_count>& seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool on_, running_ = false;
  Phase phase_ = Phase::move;
  Clock::time_point since_;
  std::array<double, phase_count> seconds_{};
};

}  // namespace talus
