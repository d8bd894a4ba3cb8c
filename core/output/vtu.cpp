#include "output/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string_view>

namespace talus {

namespace {

static_assert(std::endian::native == std::endian::little, "the files say byte_order=\"LittleEndian\"");

constexpr std::size_t block_size = 32768;  // what VTK itself writes

template <class Number>
void append_array(std::string& text, std::string_view type, std::string_view name, std::uint32_t components,
                  const std::vector<Number>& values) {
  fmt::format_to(std::back_inserter(text),
                 "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">", type,
                 name, components);
  text += encode_inline(values.data(), values.size() * sizeof(Number));
  text += "</DataArray>\n";
}

void append_data(std::string& text, std::string_view tag, const std::vector<GridArray>& arrays) {
  text += fmt::format("<{}>\n", tag);
  for (const GridArray& array : arrays) {
    if (const auto* reals = std::get_if<std::vector<double>>(&array.values)) {
      append_array(text, "Float64", array.name, array.components, *reals);
    } else {
      append_array(text, "Int32", array.name, array.components,
                   std::get<std::vector<std::int32_t>>(array.values));
    }
  }
  text += fmt::format("</{}>\n", tag);
}

}  // namespace

void append_base64(std::string& text, const unsigned char* bytes, std::size_t size) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::size_t at = text.size();
  text.resize(at + (size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t left = std::min<std::size_t>(3, size - i);
    const std::uint32_t three = static_cast<std::uint32_t>(bytes[i]) << 16 |
                                (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8 : 0u) |
                                (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0u);
    text[at++] = letters[three >> 18 & 63];
    text[at++] = letters[three >> 12 & 63];
    text[at++] = left > 1 ? letters[three >> 6 & 63] : '=';
    text[at++] = left > 2 ? letters[three & 63] : '=';
  }
}

void Grid::add_cell(CellType type, std::span<const std::int64_t> corners) {
  connectivity.insert(connectivity.end(), corners.begin(), corners.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  types.push_back(type);
}

std::string encode_inline(const void* bytes, std::size_t size) {
  const auto* data = static_cast<const unsigned char*>(bytes);
  const std::size_t blocks = (size + block_size - 1) / block_size;
  std::vector<std::uint64_t> header{blocks, block_size, size % block_size};
  std::vector<unsigned char> compressed;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t start = block * block_size;
    const std::size_t length = std::min(block_size, size - start);
    const std::size_t used = compressed.size();
    uLongf room = compressBound(static_cast<uLong>(length));
    compressed.resize(used + room);
    if (compress2(compressed.data() + used, &room, data + start, static_cast<uLong>(length), Z_BEST_SPEED) !=
        Z_OK) {
      throw std::runtime_error("zlib could not compress a block of a .vtu file");
    }
    compressed.resize(used + room);
    header.push_back(room);
  }
  std::string text;
  append_base64(text, reinterpret_cast<const unsigned char*>(header.data()),
                header.size() * sizeof(std::uint64_t));
  append_base64(text, compressed.data(), compressed.size());
  return text;
}

std::string vtu_text(const Grid& grid, double time) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n"
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{}</DataArray>\n</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      time, grid.points.size() / 3, grid.types.size());
  append_data(text, "PointData", grid.point_data);
  append_data(text, "CellData", grid.cell_data);
  text += "<Points>\n";
  append_array(text, "Float64", "Points", 3, grid.points);
  text += "</Points>\n<Cells>\n";
  append_array(text, "Int64", "connectivity", 1, grid.connectivity);
  append_array(text, "Int64", "offsets", 1, grid.offsets);
  append_array(text, "UInt8", "types", 1, grid.types);
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return text;
}

}  // namespace talus
