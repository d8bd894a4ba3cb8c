#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace talus {

/// What can be kept as the bytes it consists of.
template <class T>
concept Plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

/// Bytes of a state. The same lines of a class put its members in and take them out, so that the two cannot
/// drift apart. Taking out what is not there throws InputError.
class Archive {
 public:
  /// To be filled, with some `expected` bytes.
  explicit Archive(std::size_t expected = 0) { bytes_.reserve(expected); }
  explicit Archive(std::string_view from) : reading_(true), from_(from) {}

  bool reading() const { return reading_; }
  const std::string& bytes() const { return bytes_; }
  std::string take_bytes() { return std::move(bytes_); }
  bool at_end() const { return from_.empty(); }

  template <Plain T>
  void operator()(T& value) {
    exchange(&value, sizeof value);
  }

  void operator()(std::string& text) {
    text.resize(count(text.size(), 1));
    exchange(text.data(), text.size());
  }

  template <class T, class Allocator>
  void operator()(std::vector<T, Allocator>& values) {
    if constexpr (Plain<T>) {
      values.resize(count(values.size(), sizeof(T)));
      exchange(values.data(), values.size() * sizeof(T));
    } else {
      values.resize(count(values.size(), 1));
      for (T& value : values) (*this)(value);
    }
  }

  /// An array whose length the scene decides.
  template <class T>
  void of_known_size(std::vector<T>& values) {
    const std::size_t size = values.size();
    (*this)(values);
    if (values.size() != size) refuse();
  }

  /// The state is not one of this scene.
  [[noreturn]] static void refuse();

 private:
  void exchange(void* value, std::size_t size);
  /// How many entries there are or will be, each of at least `least` bytes.
  std::size_t count(std::size_t size, std::size_t least);

  bool reading_ = false;
  std::string bytes_;
  std::string_view from_;
};

}  // namespace talus
