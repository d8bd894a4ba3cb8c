#include "geometry/gmsh_file.hpp"

#include "files/input_error.hpp"
#include "text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace talus {
namespace {

const char* kind_of(std::uint64_t type) {
  switch (type) {
    case 3:
      return "4-node quadrangle";
    case 4:
      return "4-node tetrahedron";
    case 5:
      return "8-node hexahedron";
    case 8:
      return "3-node line";
    case 9:
      return "6-node triangle";
    case 10:
      return "9-node quadrangle";
    case 16:
      return "8-node quadrangle";
    default:
      return "another element";
  }
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : rest_(text) { file_.name = name; }

  GmshFile parse() {
    while (next_line()) {
      if (!line_.starts_with('$'))
        fail(fmt::format("{} stands where a section ($...) should begin", shown(line_)));
      const std::string section(line_.substr(1));
      if (section == "MeshFormat") {
        read_format();
      } else if (section == "PhysicalNames") {
        read_names();
      } else if (section == "Entities" && needs_format().by_entity) {
        read_entities();
      } else if (section == "Nodes") {
        needs_format().by_entity ? read_node_blocks() : read_nodes();
      } else if (section == "Elements") {
        needs_format().by_entity ? read_element_blocks() : read_elements();
      } else {
        skip(section);
        continue;
      }
      close(section);
    }
    needs_format();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& words) const {
    throw InputError(fmt::format("{}:{}: {}", file_.name, line_number_, words));
  }

  /// The next line that holds anything.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line_ = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++line_number_;
      if (!line_.empty()) {
        fields_ = line_;
        return true;
      }
    }
    return false;
  }

  /// A line of data; `what` is what should stand there.
  void data_line(const char* what) {
    if (!next_line()) fail(fmt::format("the file ends where {} should follow", what));
    if (line_.starts_with('$')) fail(fmt::format("the section ends where {} should follow", what));
  }

  std::string_view word(const char* what) {
    const std::size_t end = fields_.find_first_of(" \t");
    const std::string_view found = fields_.substr(0, end);
    if (found.empty()) fail(fmt::format("the line ends where {} should follow", what));
    fields_ = end == std::string_view::npos ? std::string_view() : trimmed(fields_.substr(end));
    return found;
  }

  template <class Number>
  Number number(const char* what) {
    const std::string_view found = word(what);
    Number value{};
    const auto [end, problem] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (problem != std::errc() || end != found.data() + found.size()) {
      fail(fmt::format("{} stands where {} should", shown(found), what));
    }
    return value;
  }

  std::uint64_t count(const char* what) { return number<std::uint64_t>(what); }

  double coordinate() {
    const double value = number<double>("a coordinate");
    if (!std::isfinite(value)) fail("a coordinate is not finite");
    return value;
  }

  const GmshFile& needs_format() const {
    if (!has_format_) fail("there is no section $MeshFormat before this: the file is no mesh of Gmsh");
    return file_;
  }

  void read_format() {
    data_line("the version of the format");
    const std::string_view version = word("the version of the format");
    if (version != "2.2" && version != "4.1") {
      fail(fmt::format("the format is MSH {}, wanted 2.2 or 4.1; save the mesh as one of these",
                       shown(version)));
    }
    if (count("0 for text") != 0) fail("the mesh is binary, wanted text; save it as ASCII");
    file_.by_entity = version == "4.1";
    has_format_ = true;
  }

  void read_names() {
    data_line("the number of names");
    for (std::uint64_t left = count("the number of names"); left > 0; --left) {
      data_line("a physical name");
      const int dimension = number<int>("the dimension of a physical group");
      const auto tag = number<std::int64_t>("the number of a physical group");
      if (fields_.size() < 3 || fields_.front() != '"' || fields_.back() != '"') {
        fail("the name of a physical group should stand in double quotes");
      }
      const std::string_view name = fields_.substr(1, fields_.size() - 2);
      if (!printable(name)) fail("the name of a physical group holds characters that cannot be shown");
      if (!file_.group_names.emplace(GmshFile::Tag{dimension, tag}, name).second) {
        fail(fmt::format("the physical group {} of dimension {} is named twice", tag, dimension));
      }
    }
  }

  void read_entities() {
    data_line("the numbers of entities");
    std::array<std::uint64_t, 4> counts;
    for (std::uint64_t& one : counts) one = count("a number of entities");
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::uint64_t left = counts[static_cast<std::size_t>(dimension)]; left > 0; --left) {
        data_line("an entity");
        const auto tag = number<std::int64_t>("the number of an entity");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) word("a coordinate of an entity");
        std::vector<std::int64_t> groups;
        for (std::uint64_t more = count("the number of physical groups"); more > 0; --more) {
          // The sign is the direction of the entity in the group.
          const auto group = number<std::int64_t>("the number of a physical group");
          if (group == std::numeric_limits<std::int64_t>::min()) fail("a physical group has no such number");
          groups.push_back(std::abs(group));
        }
        if (!file_.entity_groups.emplace(GmshFile::Tag{dimension, tag}, std::move(groups)).second) {
          fail(fmt::format("the entity {} of dimension {} is there twice", tag, dimension));
        }
      }
    }
  }

  void read_nodes() {
    data_line("the number of nodes");
    for (std::uint64_t left = count("the number of nodes"); left > 0; --left) {
      data_line("a node");
      add_node(count("the number of a node"));
    }
  }

  void read_node_blocks() {
    data_line("the number of blocks of nodes");
    for (std::uint64_t blocks = count("the number of blocks of nodes"); blocks > 0; --blocks) {
      data_line("a block of nodes");
      for (int k = 0; k < 3; ++k) word("the head of a block of nodes");
      std::vector<std::uint64_t> tags;
      for (std::uint64_t left = count("the number of nodes in the block"); left > 0; --left) {
        data_line("the number of a node");
        tags.push_back(count("the number of a node"));
      }
      for (const std::uint64_t tag : tags) {
        data_line("the coordinates of a node");
        add_node(tag);
      }
    }
  }

  void add_node(std::uint64_t tag) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    file_.nodes.push_back({tag, x, y, z, line_number_});
  }

  void read_elements() {
    data_line("the number of elements");
    for (std::uint64_t left = count("the number of elements"); left > 0; --left) {
      data_line("an element");
      word("the number of an element");
      const std::uint64_t type = checked_type();
      std::int64_t group = 0;
      const std::uint64_t tags = count("the number of tags");
      for (std::uint64_t k = 0; k < tags; ++k) {
        const auto tag = number<std::int64_t>("a tag of an element");
        if (k == 0) group = tag;
      }
      add_cell(type, group);
    }
  }

  void read_element_blocks() {
    data_line("the number of blocks of elements");
    for (std::uint64_t blocks = count("the number of blocks of elements"); blocks > 0; --blocks) {
      data_line("a block of elements");
      word("the dimension of an entity");
      const auto entity = number<std::int64_t>("the number of an entity");
      const std::uint64_t type = checked_type();
      for (std::uint64_t left = count("the number of elements in the block"); left > 0; --left) {
        data_line("an element");
        word("the number of an element");
        add_cell(type, entity);
      }
    }
  }

  std::uint64_t checked_type() {
    const std::uint64_t type = count("the type of an element");
    if (type != 1 && type != 2 && type != 15) {
      fail(fmt::format(
          "found an element of type {} ({}), wanted 3-node triangles and 2-node lines only; mesh the surface "
          "with triangles of order 1",
          type, kind_of(type)));
    }
    return type;
  }

  /// Of type 1, a line, 2, a triangle, or 15, a point, which says nothing here.
  void add_cell(std::uint64_t type, std::int64_t key) {
    if (type == 15) return;
    GmshFile::Cell cell{{0, 0, 0}, key, line_number_};
    for (std::size_t k = 0; k <= type; ++k) cell.nodes[k] = count("the number of a node");
    (type == 1 ? file_.lines : file_.triangles).push_back(cell);
  }

  void close(const std::string& section) {
    if (!next_line()) fail(fmt::format("the file ends within the section ${}", section));
    if (line_ != "$End" + section) {
      fail(fmt::format("{} stands where $End{} should: the section holds more than it says", shown(line_),
                       section));
    }
  }

  void skip(const std::string& section) {
    do {
      if (!next_line()) fail(fmt::format("the section {} is not closed", shown("$" + section)));
    } while (line_ != "$End" + section);
  }

  std::string_view rest_, line_, fields_;
  std::size_t line_number_ = 0;
  bool has_format_ = false;
  GmshFile file_;
};

}  // namespace

std::vector<std::string> GmshFile::groups_of(int dimension, std::int64_t key) const {
  std::vector<std::int64_t> groups;
  if (by_entity) {
    const auto entity = entity_groups.find({dimension, key});
    if (entity != entity_groups.end()) groups = entity->second;
  } else if (key != 0) {
    groups.push_back(key);
  }
  std::vector<std::string> names;
  for (const std::int64_t group : groups) {
    const auto found = group_names.find({dimension, group});
    names.push_back(found == group_names.end() ? std::to_string(group) : found->second);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

GmshFile parse_gmsh(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

}  // namespace talus
