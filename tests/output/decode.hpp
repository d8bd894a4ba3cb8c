#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// Reads .vtu files back the way a viewer does, independent of the writer.
namespace talus::decode {

std::vector<unsigned char> base64(const std::string& text);

/// The bytes of an inline array: block header, then zlib blocks.
std::vector<unsigned char> inline_bytes(const std::string& text);

/// The DataArray of this name.
std::string array_text(const std::string& file, const std::string& name);

template <class Number>
std::vector<Number> array(const std::string& file, const std::string& name) {
  const std::vector<unsigned char> bytes = inline_bytes(array_text(file, name));
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size() * sizeof(Number); ++i) {
    reinterpret_cast<unsigned char*>(numbers.data())[i] = bytes[i];
  }
  return numbers;
}

}  // namespace talus::decode
