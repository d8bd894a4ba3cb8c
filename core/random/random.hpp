#pragma once

#include <cstdint>

namespace talus {

/// A stream of random numbers that is the same everywhere, which the distributions of the standard library
/// are not: splitmix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Streams of one seed that differ by their number.
  static Random stream(std::uint64_t seed, std::uint64_t number) {
    return Random(Random(seed).next() ^ (number * 0xd1342543de82ef95u));
  }

  std::uint64_t next() {
    std::uint64_t mixed = state_ += 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
    return mixed ^ (mixed >> 31);
  }
  /// Even over [0, 1).
  double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Even over [low, high).
  double between(double low, double high) { return low + (high - low) * share(); }
  /// Even over 0 to count - 1, but for a share of count / 2⁶⁴.
  std::uint64_t below(std::uint64_t count) { return next() % count; }

 private:
  std::uint64_t state_;
};

}  // namespace talus
