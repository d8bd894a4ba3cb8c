#include "checkpoint/checkpoint.hpp"

#include "files/hash.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"

#include <talus/library.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <optional>
#include <string_view>

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

/// A file is this line, the length of the rest in decimal, a line of JSON without the state, the state, and
/// the hash of all before it.
constexpr std::string_view first_line = "talus checkpoint 1\n";
constexpr int state_layout = 5;  ///< counted on when what is kept of a simulation is another
constexpr std::size_t hash_digits = 32;

Json header_of(const Checkpoint& checkpoint) {
  Json overrides = Json::array(), folders = Json::array(), libraries = Json::array();
  for (const Override& change : checkpoint.overrides) overrides.push_back({change.pointer, change.value});
  for (const auto& folder : checkpoint.plugin_folders) folders.push_back(folder.string());
  for (const auto& library : checkpoint.libraries) libraries.push_back({library.file, library.hash});
  return {{"written_by", checkpoint_writer()},
          {"reason", checkpoint.reason},
          {"scene_file", checkpoint.scene_file.string()},
          {"scene_text", checkpoint.scene_text},
          {"scene_xxh3_128", checkpoint.scene_hash},
          {"files", checkpoint.files},
          {"set", overrides},
          {"allow_plugins", checkpoint.allow_plugins},
          {"plugin_folders", folders},
          {"libraries", libraries},
          {"simd", name_of(checkpoint.simd)},
          {"neighbour_skin", checkpoint.neighbour_skin},
          {"threads", checkpoint.threads},
          {"model_hash", checkpoint.model_hash},
          {"t [s]", checkpoint.time},
          {"settling", checkpoint.settling},
          {"steps", checkpoint.steps},
          {"continued [s]", checkpoint.continued}};
}

/// What is no count, or beyond all counts, would be undefined to convert.
template <class Integer>
Integer count_of(const Json& header, const char* key, const std::string& file) {
  const Json& value = header.at(key);
  const std::uint64_t most = std::numeric_limits<Integer>::max();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
    throw InputError(fmt::format(
        "'{}' is damaged: its \"{}\" is no count; take an older copy, or run the scene anew", file, key));
  }
  return value.get<Integer>();
}

Checkpoint checkpoint_of(const Json& header, const std::string& file) {
  const std::string writer = header.at("written_by");
  if (writer != checkpoint_writer()) {
    throw InputError(
        fmt::format("'{}' was written by {}, this is {}: states of other versions cannot be continued; use "
                    "that version, or run the scene anew",
                    file, writer, checkpoint_writer()));
  }
  Checkpoint checkpoint;
  checkpoint.reason = header.at("reason");
  checkpoint.scene_file = header.at("scene_file").get<std::string>();
  checkpoint.scene_text = header.at("scene_text");
  checkpoint.scene_hash = header.at("scene_xxh3_128");
  checkpoint.files = header.at("files").get<std::map<std::string, std::string>>();
  for (const Json& change : header.at("set")) checkpoint.overrides.push_back({change.at(0), change.at(1)});
  checkpoint.allow_plugins = header.at("allow_plugins");
  for (const Json& folder : header.at("plugin_folders"))
    checkpoint.plugin_folders.emplace_back(folder.get<std::string>());
  for (const Json& library : header.at("libraries"))
    checkpoint.libraries.push_back({library.at(0), library.at(1)});
  const std::optional<SimdLevel> level = simd_level_named(header.at("simd").get<std::string>());
  if (!level) throw InputError(fmt::format("'{}' names an unknown instruction set", file));
  checkpoint.simd = *level;
  checkpoint.neighbour_skin = header.at("neighbour_skin");
  checkpoint.threads = count_of<int>(header, "threads", file);
  checkpoint.model_hash = header.at("model_hash");
  checkpoint.time = header.at("t [s]");
  checkpoint.settling = header.at("settling");
  checkpoint.steps = count_of<std::uint64_t>(header, "steps", file);
  checkpoint.continued = header.at("continued [s]").get<std::vector<double>>();
  return checkpoint;
}

}  // namespace

std::string checkpoint_writer() {
  return fmt::format("talus " TALUS_VERSION ", interface {}, state {}", abi_number, state_layout);
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  const std::string header = header_of(checkpoint).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text(first_line);
  text += fmt::format("{}\n{}\n", header.size() + 1 + checkpoint.state.size() + hash_digits, header);
  text += checkpoint.state;
  text += hash_of_bytes(text);
  write_whole_file(file, text, Durability::on_disk);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  return read_checkpoint_text(read_whole_file(file), file.string());
}

Checkpoint read_checkpoint_text(std::string_view text, const std::string& name) {
  std::string_view rest = text;
  if (!rest.starts_with(first_line)) {
    if (rest.starts_with(first_line.substr(0, first_line.rfind(' ')))) {
      throw InputError(fmt::format("'{}' is a checkpoint of another form than this program writes", name));
    }
    throw InputError(fmt::format("'{}' is no checkpoint of talus", name));
  }
  const auto damaged = [&](std::string_view what) {
    return InputError(
        fmt::format("'{}' is damaged: {}; take an older copy, or run the scene anew", name, what));
  };
  const std::size_t stored_hash = text.size() - std::min(text.size(), hash_digits);
  rest.remove_prefix(first_line.size());
  const std::size_t line = rest.find('\n');
  const std::string length(rest.substr(0, line == std::string_view::npos ? 0 : line));
  rest.remove_prefix(line == std::string_view::npos ? rest.size() : line + 1);
  if (length != std::to_string(rest.size())) {
    throw damaged(fmt::format("{} bytes should follow its second line, there are {}", length, rest.size()));
  }
  if (hash_of_bytes(text.substr(0, stored_hash)) != text.substr(stored_hash)) {
    throw damaged("its contents do not fit the hash at its end");
  }
  const std::size_t end = rest.find('\n');
  try {
    Checkpoint checkpoint = checkpoint_of(Json::parse(rest.substr(0, end)), name);
    rest.remove_prefix(end + 1);
    checkpoint.state = rest.substr(0, rest.size() - hash_digits);
    return checkpoint;
  } catch (const nlohmann::json::exception& problem) {
    throw damaged(problem.what());
  }
}

}  // namespace talus
