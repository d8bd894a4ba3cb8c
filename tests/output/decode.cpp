#include "decode.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace talus::decode {

std::vector<unsigned char> base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  if (text.size() % 4 != 0) throw std::runtime_error("base64 comes in fours");
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t bits = 0;
    std::size_t padding = 0;
    for (std::size_t j = i; j < i + 4; ++j) {
      const std::size_t value = text[j] == '=' ? 0 : letters.find(text[j]);
      if (value == std::string::npos) throw std::runtime_error("not base64");
      padding += text[j] == '=' ? 1 : 0;
      bits = bits << 6 | static_cast<std::uint32_t>(value);
    }
    for (std::size_t j = 0; j < 3 - padding; ++j)
      bytes.push_back(static_cast<unsigned char>(bits >> (16 - 8 * j)));
  }
  return bytes;
}

std::vector<unsigned char> inline_bytes(const std::string& text) {
  const auto encoded_size = [](std::size_t bytes) { return (bytes + 2) / 3 * 4; };
  const auto words_of = [](const std::vector<unsigned char>& bytes) {
    std::vector<std::uint64_t> words(bytes.size() / 8);
    if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * 8);
    return words;
  };
  const std::uint64_t blocks = words_of(base64(text.substr(0, 32)))[0];
  const std::size_t header_size = encoded_size((3 + blocks) * 8);
  const std::vector<std::uint64_t> header = words_of(base64(text.substr(0, header_size)));
  const std::vector<unsigned char> compressed = base64(text.substr(header_size));
  std::vector<unsigned char> bytes;
  std::size_t start = 0;
  for (std::uint64_t block = 0; block < blocks; ++block) {
    const bool partial = block + 1 == blocks && header[2] != 0;
    std::vector<unsigned char> plain(partial ? header[2] : header[1]);
    uLongf room = plain.size();
    if (uncompress(plain.data(), &room, compressed.data() + start, header[3 + block]) != Z_OK ||
        room != plain.size()) {
      throw std::runtime_error("a block does not inflate to its size");
    }
    bytes.insert(bytes.end(), plain.begin(), plain.end());
    start += header[3 + block];
  }
  if (start != compressed.size()) throw std::runtime_error("bytes left after the last block");
  return bytes;
}

std::string array_text(const std::string& file, const std::string& name) {
  const std::size_t tag = file.find("Name=\"" + name + "\"");
  if (tag == std::string::npos) throw std::runtime_error("no array " + name);
  const std::size_t start = file.find('>', tag) + 1;
  return file.substr(start, file.find('<', start) - start);
}

}  // namespace talus::decode
