#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace talus::conformance {

/// An array between two guard zones, so that what reads or writes past it neither crashes at once nor goes
/// unseen. All bytes of the zones have one value; 0xFF makes doubles NaN and indices as large as they get.
template <class T>
class Guarded {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit Guarded(std::size_t count = 0, unsigned char inside = 0) { resize(count, inside); }
  explicit Guarded(std::span<const T> values) : Guarded(values.size()) {
    if (!values.empty()) std::memcpy(data(), values.data(), values.size_bytes());
  }

  void resize(std::size_t count, unsigned char inside) {
    count_ = count;
    lines_.assign((all() + sizeof(Line) - 1) / sizeof(Line), {});
    if (count > 0) std::memset(bytes() + zone, inside, count * sizeof(T));
  }

  std::size_t size() const { return count_; }
  T* data() { return reinterpret_cast<T*>(bytes() + zone); }
  const T* data() const { return reinterpret_cast<const T*>(bytes() + zone); }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + count_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + count_; }

  void surround(unsigned char value) {
    std::memset(bytes(), value, zone);
    std::memset(bytes() + all() - zone, value, zone);
  }
  bool surrounded_by(unsigned char value) const {
    const auto same = [value](unsigned char byte) { return byte == value; };
    const unsigned char* const after = bytes() + all() - zone;
    return std::all_of(bytes(), bytes() + zone, same) && std::all_of(after, after + zone, same);
  }
  bool same_bytes(const Guarded& other) const {
    return count_ == other.count_ && std::memcmp(bytes(), other.bytes(), all()) == 0;
  }

 private:
  static constexpr std::size_t zone = 16 * sizeof(T);  ///< of doubles two of the widest vectors

  /// What no type here wants to be aligned more than.
  struct alignas(64) Line {
    unsigned char byte[64];
  };
  static_assert(alignof(T) <= alignof(Line));

  std::size_t all() const { return 2 * zone + count_ * sizeof(T); }  ///< bytes
  unsigned char* bytes() { return lines_.data()->byte; }
  const unsigned char* bytes() const { return lines_.data()->byte; }

  std::vector<Line> lines_;
  std::size_t count_ = 0;
};

}  // namespace talus::conformance
