#pragma once

#include <cstdint>

namespace talus {

/// A stream of random numbers that is the same everywhere, which the distributions of the standard library
/// are not: splitmix64 (Steele, Lea and Flood 2014). Streams of one seed differ by their number.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(seed) {
    state_ = next() ^ (stream * 0xd1342543de82ef95u);
  }

  /// Even over [0, 1).
  double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Even over [-1, 1).
  double either_way() { return 2 * share() - 1; }

 private:
  std::uint64_t next() {
    std::uint64_t mixed = state_ += 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
    return mixed ^ (mixed >> 31);
  }

  std::uint64_t state_;
};

}  // namespace talus
