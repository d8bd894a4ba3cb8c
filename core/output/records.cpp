#include "output/records.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/run_record.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace talus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_text(const Json& value) {
  return value.is_string();
}

bool is_number(const Json& value) {
  return value.is_number();
}

/// What is no finite number is null in JSON.
bool is_any_number(const Json& value) {
  return value.is_number() || value.is_null();
}

bool is_texts(const Json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), is_text);
}

bool is_numbers(const Json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), is_number);
}

bool has_text(const Json& value, const char* key) {
  return value.is_object() && value.contains(key) && value[key].is_string();
}

bool is_end(const Json& value) {
  return value == name_of(RunEnd::finished) || value == name_of(RunEnd::interrupted) ||
         value == name_of(RunEnd::stopped);
}

bool is_libraries(const Json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(),
                                         [](const Json& library) { return has_text(library, "path"); });
}

bool is_overrides(const Json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& change) {
           return has_text(change, "pointer") && has_text(change, "value");
         });
}

bool is_compared_runs(const Json& value) {
  return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), [](const Json& run) {
           return has_text(run, "value") && has_text(run, "folder");
         });
}

/// Something of a record that a reader counts on.
struct Due {
  const char* pointer;
  bool (*is)(const Json& value);
  bool always = true;  ///< or where it is there
};

constexpr Due due_of_run[] = {{"/end", is_end},
                              {"/trouble", is_text, false},
                              {"/t [s]", is_number},
                              {"/scene/file", is_text},
                              {"/scene/title", is_text},
                              {"/scene/xxh3_128", is_text},
                              {"/plugins", is_libraries},
                              {"/settings/simd", is_text},
                              {"/settings/set", is_overrides},
                              {"/blocks", is_number},
                              {"/elements", is_number},
                              {"/steps", is_number},
                              {"/settle_steps", is_number},
                              {"/cost/settling/cpu [s]", is_number},
                              {"/cost/stepping/cpu [s]", is_number},
                              {"/dt [s]", is_any_number},
                              {"/largest_penetration [m]", is_any_number},
                              {"/largest_residual_share", is_any_number},
                              {"/warnings", is_texts}};

constexpr Due due_of_comparison[] = {{"/varied", is_text},
                                     {"/runs", is_compared_runs},
                                     {"/moments [s]", is_numbers, false},
                                     {"/reference/file", is_text, false},
                                     {"/reference/copy", is_text, false}};

template <std::size_t count>
Json read_record(const fs::path& file, const char* of, const Due (&all)[count]) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("'{}' is no record of a {}: {}; restore it, or make the {} again",
                                 file.string(), of, why, of));
  };
  Json record = Json::parse(read_whole_file(file), nullptr, false);
  if (!record.is_object()) refuse("it is no whole JSON object");
  for (const Due& due : all) {
    const Json::json_pointer pointer(due.pointer);
    const bool there = record.contains(pointer);
    if (there ? !due.is(record.at(pointer)) : due.always)
      refuse(fmt::format("its {} is {}", due.pointer, there ? "not what talus writes" : "missing"));
  }
  return record;
}

template <class Read>
std::optional<Json> if_whole(const fs::path& file, const Read& read) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return read();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

Json read_run_record(const fs::path& folder) {
  return read_record(folder / "run.json", "run", due_of_run);
}

std::optional<Json> run_record_in(const fs::path& folder) {
  return if_whole(folder / "run.json", [&] { return read_run_record(folder); });
}

Json read_comparison_record(const fs::path& folder) {
  Json record = read_record(folder / "compare.json", "comparison", due_of_comparison);
  if (!record.value("ended", true))
    throw InputError(fmt::format(
        "the comparison in '{}' is at work, or was broken off before its end: wait for it, or begin it anew "
        "with --overwrite",
        folder.string()));
  return record;
}

std::optional<Json> comparison_record_in(const fs::path& folder) {
  return if_whole(folder / "compare.json",
                  [&] { return read_record(folder / "compare.json", "comparison", due_of_comparison); });
}

bool holds_comparison(const fs::path& folder) {
  if (fs::exists(folder / "compare.json")) return true;
  if (fs::exists(folder / "run.json")) return false;
  throw InputError(fmt::format("'{}' holds neither run.json nor compare.json: it is no folder of results",
                               folder.string()));
}

}  // namespace talus
