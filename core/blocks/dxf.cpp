#include "blocks/dxf.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "text/plain_number.hpp"
#include "text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace talus {
namespace {

constexpr int closed_flag = 1;
constexpr int in_space = 8;  // a polyline of which each vertex has a height of its own
constexpr int mesh = 16 | 64;
constexpr int frame_of_spline = 16;  // a vertex that controls a curve and is not on it

/// In the words of DXF for what ASCII has not, \U+00FC, as UTF-8; halves of pairs stay as they are written.
std::string decoded(std::string_view name) {
  constexpr std::string_view mark = "\\U+";
  constexpr std::size_t digits = 4;
  std::string text;
  while (!name.empty()) {
    const std::string_view code = name.starts_with(mark) ? name.substr(mark.size(), digits) : "";
    unsigned number = 0;
    const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), number, 16);
    const bool good = code.size() == digits && error == std::errc() && end == code.data() + digits;
    if (!good || number < 0x20 || (number >= 0xD800 && number < 0xE000)) {
      text += name.front();
      name.remove_prefix(1);
      continue;
    }
    if (number >= 0x800) text += static_cast<char>(0xE0 | number >> 12);
    if (number >= 0x80) text += static_cast<char>((number >= 0x800 ? 0x80 : 0xC0) | (number >> 6 & 0x3F));
    text += static_cast<char>(number >= 0x80 ? 0x80 | (number & 0x3F) : number);
    name.remove_prefix(mark.size() + digits);
  }
  return text;
}

/// As UTF-8, which drawings are since 2007; bytes of older ones are taken for Latin-1.
std::string text_of(std::string_view name) {
  if (printable(name)) return decoded(name);
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) text += static_cast<char>(0xC0 | byte >> 6);
    text += static_cast<char>(byte >= 0x80 ? 0x80 | (byte & 0x3F) : byte);
  }
  return decoded(text);
}

/// A DXF is a list of groups: a line with a code that tells what the next line is.
class Parser {
 public:
  Parser(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

  DxfDrawing parse() {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
    if (rest_.starts_with("AutoCAD Binary DXF")) fail("this is a binary DXF: save it as text (ASCII)");
    if (rest_.starts_with("AC10")) fail("this is a DWG: save it as a DXF of text (ASCII)");
    if (!next() || code_ != 0 || value_ != "SECTION")
      fail("this is no DXF: expected it to begin with 0 and SECTION");
    bool has_entities = false;
    do {
      if (code_ == 0 && value_ == "EOF") break;
      if (code_ == 9 && value_ == "$INSUNITS" && next() && code_ == 70) drawing_.units = flags();
      note_layer();
      if (code_ != 2 || value_ != "ENTITIES") continue;
      has_entities = true;
      read_entities();
    } while (next());
    if (!has_entities) fail("the drawing has no section ENTITIES");
    return std::move(drawing_);
  }

 private:
  [[noreturn]] void fail(const std::string& words) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, words));
  }

  std::string_view take_line() {
    const std::size_t end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return trimmed(line);
  }

  /// The next group that is no comment; false at the end of the file.
  bool next() {
    constexpr int comment = 999;
    do {
      if (rest_.find_first_not_of(" \t\r\n") == std::string_view::npos) return false;
      const std::string_view code = take_line();
      const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), code_);
      if (error != std::errc() || end != code.data() + code.size())
        fail(fmt::format("{} stands where the code of a group, a whole number, should", shown(code)));
      if (rest_.empty()) fail(fmt::format("the file ends after the code {}", code_));
      value_ = take_line();
    } while (code_ == comment);
    return true;
  }

  double number() const {
    const std::optional<double> taken = plain_number(value_);
    if (!taken) fail(fmt::format("{} is no number", shown(value_)));
    return *taken;
  }

  /// A sum of flags.
  int flags() const {
    const double written = number();
    if (written != std::floor(written) || std::abs(written) > 0xFFFF)
      fail(fmt::format("{} stands where flags, a whole number, should", shown(value_)));
    return static_cast<int>(written);
  }

  /// Of the table of layers, which stands before the entities: those that CAD does not show.
  void note_layer() {
    if (code_ == 0) of_layer_ = value_ == "LAYER";
    if (!of_layer_) return;
    if (code_ == 2) layer_ = value_;
    const double value = plain_number(value_).value_or(0);
    const bool off = code_ == 62 && value < 0, frozen = code_ == 70 && std::fmod(value, 2) == 1;
    if (off || frozen) drawing_.hidden_layers.insert(text_of(layer_));
  }

  /// Ends on ENDSEC.
  void read_entities() {
    advance();
    while (value_ != "ENDSEC") {
      if (value_ == "LINE") {
        read_line();
      } else if (value_ == "LWPOLYLINE") {
        read_light_polyline();
      } else if (value_ == "POLYLINE") {
        read_polyline();
      } else {
        ++drawing_.passed_over[printable(value_) ? std::string(value_) : "?"];
        read_groups([](int) {});
      }
    }
  }

  void advance() {
    if (!next()) fail("the file ends within the section ENTITIES");
  }

  /// Calls `take` with the code of each group of an entity, and reads what all entities share. Ends on the
  /// next code 0.
  template <typename Take>
  void read_groups(Take&& take) {
    advance();
    while (code_ != 0) {
      if (code_ == 8) layer_ = value_;
      if (code_ == 67 && number() != 0) paper_ = true;
      if (code_ == 60 && number() != 0) invisible_ = true;
      take(code_);
      advance();
    }
  }

  void begin_entity() {
    layer_ = "0";
    paper_ = invisible_ = false;
    arc_line_ = 0;
  }

  void check_plane() const {
    if (code_ == 230 && number() != 1)
      fail("the polyline stands in a plane of its own (code 230): expected 1, the plane of the drawing");
  }

  /// An arc leads from a vertex to the next, and is none where no other comes.
  void note_arc() {
    if (code_ == 42 && number() != 0) arc_line_ = line_;
  }

  void refuse_arc() {
    if (arc_line_ == 0 || paper_ || invisible_) return;
    line_ = arc_line_;
    fail("the polyline has an arc (code 42): draw it as straight lines");
  }

  void read_line() {
    begin_entity();
    Vec2 from, to;
    double rise = 0;
    read_groups([&](int code) {
      if (code == 10) from.x = number();
      if (code == 20) from.y = number();
      if (code == 11) to.x = number();
      if (code == 21) to.y = number();
      if (code == 30) rise -= number();
      if (code == 31) rise += number();
    });
    keep({from, to}, false, "LINE", rise == 0);
  }

  void read_light_polyline() {
    begin_entity();
    std::vector<Vec2> points;
    bool closed = false;
    read_groups([&](int code) {
      if (code == 70) closed = (flags() & closed_flag) != 0;
      if (code == 10) {
        refuse_arc();
        points.push_back({number(), 0});
      }
      if (code == 20 && points.empty()) fail("a y (code 20) stands before the first x (code 10)");
      if (code == 20) points.back().y = number();
      note_arc();
      check_plane();
    });
    if (closed) refuse_arc();
    keep(std::move(points), closed, "LWPOLYLINE", true);
  }

  void read_polyline() {
    begin_entity();
    std::vector<Vec2> points;
    int kind = 0;
    read_groups([&](int code) {
      if (code == 70) kind = flags();
      check_plane();
    });
    const std::string_view layer = layer_;
    const bool paper = paper_, invisible = invisible_;
    std::optional<double> height;
    bool level = true;
    while (value_ == "VERTEX") {
      refuse_arc();
      Vec2 point;
      double z = 0;
      bool of_frame = false;
      read_groups([&](int code) {
        if (code == 10) point.x = number();
        if (code == 20) point.y = number();
        if (code == 30) z = number();
        if (code == 70) of_frame = (flags() & frame_of_spline) != 0;
        note_arc();
      });
      if (of_frame) continue;
      points.push_back(point);
      if (height && *height != z) level = false;
      height = z;
    }
    if (value_ != "SEQEND") fail(fmt::format("{} stands where VERTEX or SEQEND should", shown(value_)));
    read_groups([](int) {});
    layer_ = layer;
    paper_ = paper;
    invisible_ = invisible;
    if ((kind & closed_flag) != 0) refuse_arc();
    if ((kind & mesh) != 0 || ((kind & in_space) != 0 && !level)) return pass_over("POLYLINE");
    keep(std::move(points), (kind & closed_flag) != 0, "POLYLINE", level);
  }

  void pass_over(const char* kind) { ++drawing_.passed_over[fmt::format("{} not of the plane", kind)]; }

  void keep(std::vector<Vec2> points, bool closed, const char* kind, bool level) {
    if (paper_) return pass_over(kind);
    if (invisible_) {
      ++drawing_.passed_over[fmt::format("{} invisible", kind)];
      return;
    }
    if (closed && !points.empty()) points.push_back(points[0]);
    const auto same = [](Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    if (points.size() < 2) {
      ++drawing_.passed_over[fmt::format("{} without length", kind)];
      return;
    }
    if (!level) ++drawing_.flattened[kind];
    drawing_.lines.push_back({text_of(layer_), std::move(points)});
  }

  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 0;
  int code_ = 0;
  std::string_view value_;
  std::string_view layer_;
  bool of_layer_ = false;     ///< whether an entry of the table of layers is read
  bool paper_ = false;        ///< whether the entity stands on a sheet, not in the model
  bool invisible_ = false;    ///< whether the entity is hidden
  std::size_t arc_line_ = 0;  ///< where an arc begins that needs another vertex; 0: none does
  DxfDrawing drawing_;
};

}  // namespace

DxfDrawing read_dxf_text(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

DxfDrawing read_dxf(const std::filesystem::path& file) {
  return read_dxf_text(read_whole_file(file), file.string());
}

}  // namespace talus
