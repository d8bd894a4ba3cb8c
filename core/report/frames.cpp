#include "report/frames.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace talus {
namespace {

template <class Number>
const std::vector<Number>& values_of(const std::vector<GridArray>& arrays, const char* name) {
  const GridArray* array = find_array(arrays, name);
  const auto* values = array == nullptr ? nullptr : std::get_if<std::vector<Number>>(&array->values);
  if (values == nullptr) throw InputError(fmt::format("a frame has no '{}'", name));
  return *values;
}

}  // namespace

std::vector<ListedFrame> listed_frames(const std::filesystem::path& folder) {
  std::vector<ListedFrame> frames;
  const std::filesystem::path file = folder / "frames.pvd";
  if (!std::filesystem::exists(file)) return frames;
  const std::string text = read_whole_file(file);
  const auto attribute = [&](std::size_t from, const std::string& name) {
    const std::size_t begin = text.find(name + "=\"", from) + name.size() + 2;
    return text.substr(begin, text.find('"', begin) - begin);
  };
  for (std::size_t at = text.find("<DataSet"); at != std::string::npos; at = text.find("<DataSet", at + 1)) {
    if (attribute(at, "part") == "0") {
      frames.push_back(
          {std::strtod(attribute(at, "timestep").c_str(), nullptr), folder / attribute(at, "file"), {}});
    } else if (!frames.empty()) {
      frames.back().contacts = folder / attribute(at, "file");
    }
  }
  return frames;
}

Grid read_grid(const std::filesystem::path& file) {
  try {
    return read_vtu_text(read_whole_file(file));
  } catch (const InputError& problem) {
    throw InputError(fmt::format("'{}': {}", file.string(), problem.what()));
  }
}

const std::vector<double>& reals_of(const std::vector<GridArray>& arrays, const char* name) {
  return values_of<double>(arrays, name);
}

const std::vector<std::int32_t>& integers_of(const std::vector<GridArray>& arrays, const char* name) {
  return values_of<std::int32_t>(arrays, name);
}

ContactSums contact_sums(const Grid& contacts) {
  const auto sum = [&](const char* name) {
    const std::vector<double>& vectors = reals_of(contacts.point_data, name);
    double total = 0;
    for (std::size_t i = 0; i + 2 < vectors.size(); i += 3) total += std::hypot(vectors[i], vectors[i + 1]);
    return total;
  };
  const std::vector<std::int32_t>& slipping = integers_of(contacts.point_data, "slipping");
  const auto slip =
      std::count_if(slipping.begin(), slipping.end(), [](std::int32_t value) { return value != 0; });
  return {contacts.points.size() / 3, static_cast<std::size_t>(slip), sum("normal_force"),
          sum("tangential_force")};
}

}  // namespace talus
