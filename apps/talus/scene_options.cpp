#include "scene_options.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/output_folder.hpp"
#include "terminal.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <thread>

namespace talus {

namespace po = boost::program_options;

void add_plugin_path(Usage& usage) {
  usage.options.add_options()("plugin-path", po::value<std::vector<std::string>>()->value_name("DIR"),
                              "look for plugins here first; may be given several times");
  usage.options.add_options()("simd", po::value<std::string>()->value_name("scalar|avx2|avx512|auto"),
                              "instruction set of plugins and loops; auto, the best this machine has, is the "
                              "default; same bits at any");
}

void add_allow_plugins(Usage& usage) {
  usage.options.add_options()("allow-plugins",
                              "load the libraries that the scene names by path: they run with your rights");
}

void add_scene_options(Usage& usage) {
  usage.options.add_options()(
      "set", po::value<std::vector<std::string>>()->value_name("/pointer=value"),
      "override a value of the scene before it is validated; may be given several times");
  add_plugin_path(usage);
  add_allow_plugins(usage);
}

namespace {

SimdLevel simd_of(const Usage& usage, const po::variables_map& given) {
  const SimdLevel best = best_simd_level();
  const std::string name = given.count("simd") == 0 ? "auto" : given["simd"].as<std::string>();
  if (name == "auto") return best;
  const std::optional<SimdLevel> level = simd_level_named(name);
  if (!level)
    throw UsageError(usage.command, fmt::format("--simd {}: allowed are scalar, avx2, avx512, auto", name));
  if (*level > best) {
    throw UsageError(
        usage.command,
        fmt::format("--simd {}: this machine has no more than {}; leave it at auto", name, name_of(best)));
  }
  return *level;
}

}  // namespace

std::vector<std::filesystem::path> plugin_folders_of(const Usage& usage, const po::variables_map& given) {
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : list_option(given, "plugin-path")) {
    if (!std::filesystem::is_directory(folder)) {
      throw UsageError(usage.command, fmt::format("--plugin-path {}: there is no such folder", folder));
    }
    folders.push_back(std::filesystem::absolute(folder));
  }
  return folders;
}

Registry load_registry(const Usage& usage, const po::variables_map& given) {
  Registry registry;
  registry.simd = simd_of(usage, given);
  load_folders(registry, search_path(plugin_folders_of(usage, given)));
  return registry;
}

Registry offered_registry(const Usage& usage, const po::variables_map& given) {
  Registry registry;
  registry.simd = simd_of(usage, given);
  offer_folders(registry, search_path(plugin_folders_of(usage, given)));
  return registry;
}

std::filesystem::path here_or_shipped(const std::filesystem::path& named) {
  if (named.empty() || named.is_absolute() || std::filesystem::exists(named)) return named;
  std::filesystem::path shipped = installation_prefix() / "share" / "talus" / named;
  if (!std::filesystem::is_regular_file(shipped)) return named;
  tell(fmt::format("there is no {} here: taking {}\n", named.string(), shipped.string()));
  return shipped;
}

SceneFile scene_file_of(const po::variables_map& given) {
  std::filesystem::path file = here_or_shipped(text_option(given, "SCENE"));
  std::string text = read_whole_file(file);
  return {std::move(file), std::move(text)};
}

void refuse_to_replace_what_is_read(const Scene& scene, const std::filesystem::path& result) {
  for (const std::filesystem::path& file : scene.files_read()) {
    std::error_code none;
    if (!std::filesystem::equivalent(file, result, none)) continue;
    throw InputError(fmt::format("'{}' is {}: name another file", result.string(),
                                 file == scene.file ? "the scene itself" : "read by the scene"));
  }
}

std::vector<Override> overrides_of(const Usage& usage, const po::variables_map& given) {
  std::vector<Override> overrides;
  for (const std::string& text : list_option(given, "set")) {
    const std::size_t equals = text.find('=');
    if (!text.starts_with('/') || equals == std::string::npos) {
      throw UsageError(usage.command, fmt::format("--set {}: write it as --set /pointer=value", text));
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

std::filesystem::path output_folder(const po::variables_map& given, const SceneFile& scene,
                                    const std::string& suffix) {
  const std::string out = text_option(given, "out");
  std::filesystem::path folder = out.empty()
                                     ? std::filesystem::path("out") / (scene.file.stem().string() + suffix)
                                     : std::filesystem::path(out);
  refuse_among_runs_at_work(folder);
  return folder;
}

int cores() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

int threads_of(const Usage& usage, const po::variables_map& given, int fallback) {
  if (given.count("threads") == 0) return fallback;
  const std::string text = given["threads"].as<std::string>();
  int threads = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
  if (error != std::errc() || end != text.data() + text.size() || threads < 1 || threads > 1024)
    throw UsageError(usage.command, fmt::format("--threads {}: allowed are 1 to 1024", text));
  return threads;
}

std::vector<std::string> named_libraries(const std::string& scene_text) {
  const auto json = nlohmann::json::parse(scene_text, nullptr, false, true);
  std::vector<std::string> names;
  if (!json.is_object() || !json.contains("plugins") || !json["plugins"].is_array()) return names;
  for (const auto& entry : json["plugins"]) {
    if (entry.is_string()) names.push_back(entry.get<std::string>());
  }
  return names;
}

/// A path in "plugins" is a mistake only for want of permission; what is no path at all is none of these.
bool wants_permission(const SceneError& problem) {
  return std::any_of(problem.mistakes.begin(), problem.mistakes.end(), [](const Mistake& mistake) {
    return mistake.pointer.starts_with("/plugins/") &&
           mistake.message.find("--allow-plugins") != std::string::npos;
  });
}

namespace {

/// Of libraries that, by their names, were to bring what others bring now.
void warn_of_replaced(const Registry& registry, std::vector<std::string>& warnings) {
  for (const RefusedLibrary& refused : registry.refused) {
    for (const RegisteredComponent& found : registry.components()) {
      if (refused.file.stem().string() != fmt::format("lib{}", found.component->name)) continue;
      warnings.push_back(fmt::format("{} was refused: {}; '{}' comes from {}", refused.file.string(),
                                     refused.reason, found.component->name, found.file.string()));
    }
  }
}

}  // namespace

Scene read_scene_of(const SceneFile& given, Registry& registry, const std::vector<Override>& overrides,
                    bool allow_plugins, const Log& log) {
  try {
    Scene scene = read_scene(given.file, given.text, registry, {overrides, allow_plugins});
    warn_of_replaced(registry, scene.warnings);
    return scene;
  } catch (const SceneError& problem) {
    load_offered(registry);  // what was refused may be what is missing
    for (const RefusedLibrary& refused : registry.refused) {
      log.warning(fmt::format("{} was refused: {}", refused.file.string(), refused.reason));
    }
    if (wants_permission(problem)) throw LibrariesNotAllowed(problem);
    throw;
  }
}

}  // namespace talus
