#include "plugin/descriptor_in_file.hpp"
#include "plugin/refusal.hpp"
#include "plugin/registry.hpp"

#define BOOST_DLL_USE_STD_FS
#include <boost/dll/shared_library.hpp>

#include <dlfcn.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* symbol = "talus_library";

/// What the loader of the system says, out of the sentence Boost.DLL wraps around it.
std::string loader_words(const std::string& message) {
  constexpr std::string_view lead = "(dlerror system message: ";
  const std::size_t start = message.find(lead);
  const std::size_t end = message.rfind("):");
  if (start == std::string::npos || end == std::string::npos || end < start) return message;
  return message.substr(start + lead.size(), end - start - lead.size());
}

/// Everything is resolved now, so that a missing function is found here and not in the middle of a run, and
/// no symbol of one plugin is seen by another. The mapping outlives the handle: objects, tables and code of
/// plugins are in use until the process ends.
boost::dll::shared_library open_for_good(const fs::path& file) {
  using boost::dll::load_mode::type;
  const type mode =
      static_cast<type>(boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local | RTLD_NODELETE);
  try {
    return boost::dll::shared_library(file, mode);
  } catch (const boost::dll::fs::system_error&) {
    throw;
  } catch (...) {
    // The loader of the system was left amid its work and keeps its lock: the first thread that needs it
    // would wait for ever, so nothing may go on from here.
    throw PluginError(fmt::format(
        "{}: found static objects that throw while it is loaded, wanted a talus plugin; take it out of the "
        "folders of plugins, or mend and rebuild it",
        file.string()));
  }
}

/// The same library built for the best instruction set up to `level`: in a folder of that name beside it.
fs::path variant_of(const fs::path& file, SimdLevel level) {
  for (int i = static_cast<int>(level); i > 0; --i) {
    fs::path variant = file.parent_path() / name_of(static_cast<SimdLevel>(i)) / file.filename();
    std::error_code problem;
    if (fs::is_regular_file(variant, problem)) return variant;
  }
  return file;
}

std::string no_descriptor() {
  return fmt::format(
      "found no symbol '{}', wanted the descriptor of a talus plugin; export it with "
      "TALUS_EXPORT, or take the file out of the folders of plugins",
      symbol);
}

/// What speaks against loading a file at all: to load it is to run its constructors, which must not happen on
/// a machine that lacks their instructions.
std::optional<std::string> reason_before_loading(const fs::path& file) {
  const DescriptorInFile descriptor = descriptor_in_file(file, symbol);
  if (!descriptor.is_library) return std::nullopt;
  if (!descriptor.has_symbol) return no_descriptor();
  return reason_in_numbers(descriptor.bytes);
}

/// Loads a library and adds its components, or says why not.
std::optional<std::string> reason_not_loaded(Registry& registry, const fs::path& file) {
  std::error_code problem;
  if (!fs::exists(file, problem)) {
    return "found no such file, wanted a talus plugin (lib*.so); check the path";
  }
  if (fs::is_directory(file, problem)) {
    return "found a folder, wanted a talus plugin (lib*.so); name the file, or give the folder to "
           "--plugin-path";
  }
  if (!fs::is_regular_file(file, problem))
    return "found a pipe or a device, wanted a talus plugin (lib*.so); name the file";
  const Library* library = nullptr;
  const fs::path variant = variant_of(file, registry.simd);
  try {
    if (auto reason = reason_before_loading(variant)) return reason;
    const boost::dll::shared_library opened = open_for_good(variant);
    if (!opened.has(symbol)) return no_descriptor();
    library = &opened.get<const Library>(symbol);
  } catch (const PluginError&) {
    throw;
  } catch (const std::exception& trouble) {
    return fmt::format(
        "found a file that the system cannot load: {}; wanted a talus plugin with nothing "
        "undefined; rebuild it on this machine, linked with what it uses",
        loader_words(trouble.what()));
  }
  if (auto reason = reason_to_refuse(*library)) return reason;
  if (auto reason = reason_of_clash(registry, *library)) return reason;
  registry.add(*library, file, variant);
  return std::nullopt;
}

void load_or_refuse(Registry& registry, const fs::path& file) {
  if (auto reason = reason_not_loaded(registry, file)) registry.refused.push_back({file, *std::move(reason)});
}

/// Calls `take` with each `lib*.so` of the folders, in order.
template <class Take>
void over_libraries(Registry& registry, std::span<const fs::path> folders, const Take& take) {
  for (const fs::path& folder : folders) {
    const fs::path path = fs::absolute(folder).lexically_normal();
    std::error_code problem;
    std::vector<fs::path> files;
    for (auto entry = fs::directory_iterator(path, problem); entry != fs::directory_iterator();
         entry.increment(problem)) {
      const fs::path& file = entry->path();
      if (file.extension() == ".so" && file.filename().string().starts_with("lib")) files.push_back(file);
    }
    if (problem) {
      registry.refused.push_back(
          {path, fmt::format("found no folder that can be read ({}), wanted one with "
                             "talus plugins; check --plugin-path and TALUS_PLUGIN_PATH",
                             problem.message())});
    }
    std::ranges::sort(files);
    for (const fs::path& file : files) take(file);
  }
}

bool bring_the_same(const OfferedLibrary& p, const OfferedLibrary& q) {
  return std::ranges::any_of(p.brings, [&](const ComponentName& name) {
    return std::ranges::find(q.brings, name) != q.brings.end();
  });
}

/// Those before it that bring a name of its own are loaded first: it is refused as if all were.
void load_one_offered(Registry& registry, const fs::path& file) {
  const auto place = [&] { return std::ranges::find(registry.offered, file, &OfferedLibrary::file); };
  for (auto own = place(); own != registry.offered.end(); own = place()) {
    const auto rival = std::find_if(registry.offered.begin(), own,
                                    [&](const OfferedLibrary& other) { return bring_the_same(other, *own); });
    if (rival == own) {
      registry.offered.erase(own);
      load_or_refuse(registry, file);
      return;
    }
    load_one_offered(registry, fs::path(rival->file));
  }
}

/// What a file brings; nothing where only loading it will tell.
std::optional<std::vector<ComponentName>> brought_by(const fs::path& file, SimdLevel level) {
  try {
    return components_in_file(variant_of(file, level), symbol);
  } catch (const std::exception&) {
    return std::nullopt;  // that it cannot be read is told where it is loaded
  }
}

/// What the folders offer keeps its names: it comes before a library that is named by its path.
void load_rivals(Registry& registry, const fs::path& file) {
  if (registry.offered.empty()) return;
  const auto brings = brought_by(file, registry.simd);
  if (!brings) {
    load_offered(registry);
    return;
  }
  for (const ComponentName& name : *brings) demand(registry, name.kind, name.name);
}

}  // namespace

void load_library(Registry& registry, const fs::path& file) {
  // A bare name would be looked up in the current directory, or in the folders of the system.
  const fs::path path = fs::absolute(file).lexically_normal();
  load_rivals(registry, path);
  if (const auto reason = reason_not_loaded(registry, path)) throw refusal(path, *reason);
}

void load_folders(Registry& registry, std::span<const fs::path> folders) {
  over_libraries(registry, folders, [&](const fs::path& file) { load_or_refuse(registry, file); });
}

void offer_folders(Registry& registry, std::span<const fs::path> folders) {
  over_libraries(registry, folders, [&](const fs::path& file) {
    if (auto brings = brought_by(file, registry.simd)) {
      registry.offered.push_back({file, *std::move(brings)});
    } else {
      load_or_refuse(registry, file);
    }
  });
}

const RegisteredComponent* demand(Registry& registry, ComponentKind kind, const std::string& name) {
  const ComponentName wanted{kind, name};
  while (true) {
    if (const RegisteredComponent* found = registry.find(kind, name)) return found;
    const auto offer = std::ranges::find_if(registry.offered, [&](const OfferedLibrary& library) {
      return std::ranges::find(library.brings, wanted) != library.brings.end();
    });
    if (offer == registry.offered.end()) return nullptr;
    load_one_offered(registry, fs::path(offer->file));
  }
}

void load_offered(Registry& registry) {
  const std::vector<OfferedLibrary> rest = std::exchange(registry.offered, {});
  for (const OfferedLibrary& library : rest) load_or_refuse(registry, library.file);
}

}  // namespace talus
