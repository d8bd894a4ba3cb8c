#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace talus {

/// Cell types of the VTK file format.
enum class CellType : std::uint8_t { vertex = 1, triangle = 5, polygon = 7 };

/// Numbers per point or per cell.
struct GridArray {
  std::string name;
  std::uint32_t components;
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;  ///< [entry * components + component]
};

/// Points and cells with data on them.
struct Grid {
  std::vector<double> points;  ///< [point * 3 + axis] m
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> offsets;  ///< [cell] end of the cell in `connectivity`
  std::vector<CellType> types;        ///< [cell]
  std::vector<GridArray> point_data, cell_data;

  void add_cell(CellType type, std::span<const std::int64_t> corners);
};

/// A .vtu file: inline binary, base64 over zlib. ParaView 5.11 cannot open the appended form, this one opens
/// everywhere.
std::string vtu_text(const Grid& grid, double time);

/// Reads what vtu_text() wrote: points, cells and data. Throws InputError, without a name for the file.
Grid read_vtu_text(std::string_view text);

/// The array of that name, or nullptr.
const GridArray* find_array(const std::vector<GridArray>& arrays, std::string_view name);

/// Bytes in the letters of base64, with = at the end where they do not come out even.
void append_base64(std::string& text, const unsigned char* bytes, std::size_t size);

/// The inline form of an array: base64 of the block header (number of blocks, block size, size of a last
/// block that is not full, compressed sizes; 64 bits each), then base64 of the compressed blocks.
std::string encode_inline(const void* bytes, std::size_t size);

}  // namespace talus
