#include "files/input_error.hpp"
#include "output/vtu.hpp"

#include <zlib.h>

#include <array>
#include <cstring>
#include <span>

namespace talus {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw InputError(std::string("not a frame that talus wrote: ") + what);
}

/// The value of each letter, or 64.
constexpr std::array<unsigned char, 256> values_of_letters() {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<unsigned char, 256> values{};
  for (unsigned char& value : values) value = letters.size();
  for (std::size_t i = 0; i < letters.size(); ++i)
    values[static_cast<unsigned char>(letters[i])] = static_cast<unsigned char>(i);
  return values;
}

std::vector<unsigned char> bytes_of_base64(std::string_view text) {
  static constexpr std::array<unsigned char, 256> values = values_of_letters();
  if (text.size() % 4 != 0) refuse("its text comes in fours");
  std::vector<unsigned char> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t bits = 0;
    std::size_t padding = 0;
    for (std::size_t j = i; j < i + 4; ++j) {
      if (text[j] == '=') ++padding;
      const unsigned value = text[j] == '=' ? 0u : values[static_cast<unsigned char>(text[j])];
      if (value > 63 || padding > 2) refuse("a letter is out of place");
      bits = bits << 6 | value;
    }
    for (std::size_t j = 0; j < 3 - padding; ++j)
      bytes.push_back(static_cast<unsigned char>(bits >> (16 - 8 * j)));
  }
  return bytes;
}

std::uint64_t word(std::span<const unsigned char> bytes, std::size_t index) {
  std::uint64_t value = 0;
  if ((index + 1) * sizeof value > bytes.size()) refuse("an array ends early");
  std::memcpy(&value, bytes.data() + index * sizeof value, sizeof value);
  return value;
}

/// The way back of encode_inline().
std::vector<unsigned char> decode_inline(std::string_view text) {
  constexpr std::size_t first_words = 32;  // letters of the first three words
  const std::uint64_t blocks = word(bytes_of_base64(text.substr(0, first_words)), 0);
  if (blocks > text.size()) refuse("more blocks than bytes");
  const std::size_t header_letters = ((3 + blocks) * sizeof(std::uint64_t) + 2) / 3 * 4;
  if (header_letters > text.size()) refuse("an array ends early");
  const std::vector<unsigned char> header = bytes_of_base64(text.substr(0, header_letters)),
                                   compressed = bytes_of_base64(text.substr(header_letters));
  std::vector<unsigned char> bytes;
  std::size_t start = 0;
  for (std::uint64_t block = 0; block < blocks; ++block) {
    const std::uint64_t last = word(header, 2),
                        size = block + 1 == blocks && last != 0 ? last : word(header, 1);
    const std::uint64_t packed = word(header, 3 + block);
    // zlib makes nothing a thousand times smaller.
    if (packed > compressed.size() - start || size / 1100 > packed)
      refuse("a block is longer than its array");
    const std::size_t used = bytes.size();
    bytes.resize(used + size);
    uLongf room = size;
    if (uncompress(bytes.data() + used, &room, compressed.data() + start, packed) != Z_OK || room != size)
      refuse("a block does not inflate to its size");
    start += packed;
  }
  return bytes;
}

template <class Number>
std::vector<Number> numbers_of(std::string_view text) {
  const std::vector<unsigned char> bytes = decode_inline(text);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

std::string_view between(std::string_view text, std::string_view begin, std::string_view end) {
  const std::size_t from = text.find(begin);
  if (from == std::string_view::npos) refuse("a part is missing");
  const std::size_t to = text.find(end, from + begin.size());
  if (to == std::string_view::npos) refuse("a part has no end");
  return text.substr(from + begin.size(), to - from - begin.size());
}

/// Calls take(type, name, components, letters) with each array of a part of the file.
template <class Take>
void each_array(std::string_view part, const Take& take) {
  constexpr std::string_view begin = "<DataArray ";
  for (std::size_t at = part.find(begin); at != std::string_view::npos; at = part.find(begin, at + 1)) {
    const std::string_view rest = part.substr(at), head = between(rest, begin, ">");
    const std::string components(between(head, "NumberOfComponents=\"", "\""));
    take(between(head, "type=\"", "\""), std::string(between(head, "Name=\"", "\"")),
         static_cast<std::uint32_t>(std::strtoul(components.c_str(), nullptr, 10)), between(rest, ">", "<"));
  }
}

std::vector<GridArray> data_of(std::string_view part) {
  std::vector<GridArray> arrays;
  each_array(part, [&](std::string_view type, const std::string& name, std::uint32_t components,
                       std::string_view letters) {
    if (type == "Float64") {
      arrays.push_back({name, components, numbers_of<double>(letters)});
    } else {
      arrays.push_back({name, components, numbers_of<std::int32_t>(letters)});
    }
  });
  return arrays;
}

}  // namespace

Grid read_vtu_text(std::string_view text) {
  Grid grid;
  grid.point_data = data_of(between(text, "<PointData>", "</PointData>"));
  grid.cell_data = data_of(between(text, "<CellData>", "</CellData>"));
  each_array(between(text, "<Points>", "</Points>"),
             [&](std::string_view, const std::string&, std::uint32_t, std::string_view letters) {
               grid.points = numbers_of<double>(letters);
             });
  each_array(between(text, "<Cells>", "</Cells>"),
             [&](std::string_view, const std::string& name, std::uint32_t, std::string_view letters) {
               if (name == "connectivity") grid.connectivity = numbers_of<std::int64_t>(letters);
               if (name == "offsets") grid.offsets = numbers_of<std::int64_t>(letters);
               if (name == "types") grid.types = numbers_of<CellType>(letters);
             });
  std::int64_t start = 0;
  for (const std::int64_t end : grid.offsets) {
    if (end < start || end > static_cast<std::int64_t>(grid.connectivity.size()))
      refuse("a cell has no corners");
    start = end;
  }
  const auto refuse_other_size = [](const std::vector<GridArray>& arrays, std::size_t entries) {
    for (const GridArray& array : arrays) {
      const std::size_t size = std::visit([](const auto& values) { return values.size(); }, array.values);
      if (size != entries * array.components)
        refuse("an array is not as long as its points or cells are many");
    }
  };
  refuse_other_size(grid.point_data, grid.points.size() / 3);
  refuse_other_size(grid.cell_data, grid.offsets.size());
  for (const std::int64_t corner : grid.connectivity) {
    if (corner < 0 || corner >= static_cast<std::int64_t>(grid.points.size() / 3))
      refuse("a corner is no point");
  }
  return grid;
}

const GridArray* find_array(const std::vector<GridArray>& arrays, std::string_view name) {
  for (const GridArray& array : arrays) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

}  // namespace talus
