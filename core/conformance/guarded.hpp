#pragma once

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
    bytes_.assign((count + 2 * margin) * sizeof(T), 0);
    if (count > 0) std::memset(bytes_.data() + margin * sizeof(T), inside, count * sizeof(T));
  }

  std::size_t size() const { return count_; }
  T* data() { return reinterpret_cast<T*>(bytes_.data()) + margin; }
  const T* data() const { return reinterpret_cast<const T*>(bytes_.data()) + margin; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + count_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + count_; }

  void surround(unsigned char value) {
    std::memset(bytes_.data(), value, margin * sizeof(T));
    std::memset(bytes_.data() + (margin + count_) * sizeof(T), value, margin * sizeof(T));
  }
  bool surrounded_by(unsigned char value) const {
    const std::size_t zone = margin * sizeof(T), after = (margin + count_) * sizeof(T);
    for (std::size_t i = 0; i < zone; ++i) {
      if (bytes_[i] != value || bytes_[after + i] != value) return false;
    }
    return true;
  }
  bool same_bytes(const Guarded& other) const { return bytes_ == other.bytes_; }

 private:
  static constexpr std::size_t margin = 16;  ///< entries; two of the widest vectors of doubles

  std::vector<unsigned char> bytes_;  // aligned as `new` aligns: for every type here
  std::size_t count_ = 0;
};

}  // namespace talus::conformance
