#include "commands.hpp"
#include "exit_code.hpp"
#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "plugin_templates.hpp"
#include "scene_options.hpp"

#include "text/shell_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace talus {

namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

struct TemplateFile {
  std::string_view name, text;
};

/// A kind of plugin, and what its A/B scene varies, against which component that comes with talus.
struct Kind {
  std::string_view name;
  std::string_view in_words;
  std::string_view pointer;
  std::string_view baseline;
  std::array<TemplateFile, 6> files;
};

std::array<TemplateFile, 6> files_of(std::string_view source, std::string_view test, std::string_view readme,
                                     std::string_view scene) {
  return {{{"CMakeLists.txt", templates::cmake_lists},
           {"ci.sh", templates::ci},
           {"my_component.cpp", source},
           {"test_my_component.cpp", test},
           {"README.md", readme},
           {"scene.json", scene}}};
}

const std::array<Kind, 3>& kinds() {
  using namespace templates;
  static const std::array<Kind, 3> all{
      {{"contact", "contact law", "/contact/model", "overlap_area",
        files_of(contact_source, contact_test, contact_readme, contact_scene)},
       {"material", "material", "/materials/rock/model", "linear_elastic",
        files_of(material_source, material_test, material_readme, material_scene)},
       {"cover", "cover", "/cover/model", "block",
        files_of(cover_source, cover_test, cover_readme, cover_scene)}}};
  return all;
}

constexpr std::size_t longest_name = 40;

const Kind& kind_named(const Usage& usage, const std::string& word) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) {
    if (kind.name == word) return kind;
    names.emplace_back(kind.name);
  }
  throw UsageError(usage.command,
                   fmt::format("there is no kind of plugin '{}'{}; known are contact, material, cover", word,
                               guess(word, names)));
}

/// A name serves as that of a component, a C++ source, a class and a target of CMake.
void check_name(const Usage& usage, const Registry& registry, const std::string& name) {
  const auto refuse = [&](const std::string& found) {
    throw UsageError(usage.command, fmt::format("NAME '{}': {}", name, found));
  };
  const auto letter = [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_';
  };
  if (name.empty() || std::islower(static_cast<unsigned char>(name[0])) == 0 ||
      !std::all_of(name.begin(), name.end(), letter) || name.back() == '_' ||
      name.find("__") != std::string::npos) {
    refuse(
        "wanted small letters, digits and single '_', a letter first, as soft_contact; such a name serves "
        "scenes, C++ and CMake alike");
  }
  if (name.size() > longest_name)
    refuse(fmt::format("{} characters, wanted at most {}; take a shorter one", name.size(), longest_name));
  for (const std::string_view taken : {"all", "clean", "edit_cache", "help", "install", "model", "package",
                                       "rebuild_cache", "roles", "talus", "test"}) {
    if (name == taken) refuse("CMake or the scenes of talus use this word themselves; take another");
  }
  for (const RegisteredComponent& entry : registry.components()) {
    if (name == entry.component->name)
      refuse(fmt::format("{} brings a component of that name; take another", entry.file.string()));
  }
}

/// "soft_contact" as the name of a class, "SoftContact".
std::string class_name(std::string_view name) {
  std::string result;
  bool starts = true;
  for (const char c : name) {
    if (c == '_') {
      starts = true;
      continue;
    }
    result += starts ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    starts = false;
  }
  return result;
}

std::string with(std::string text, std::string_view mark, std::string_view word) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + word.size())) {
    text.replace(at, mark.size(), word);
  }
  return text;
}

std::string filled(std::string_view text, const Kind& kind, const std::string& name) {
  std::string result = with(std::string(text), "my_component", name);
  result = with(std::move(result), "MyComponent", class_name(name));
  result = with(std::move(result), "my_pointer", kind.pointer);
  return with(std::move(result), "my_baseline", kind.baseline);
}

/// Also a link that leads nowhere.
bool is_there(const fs::path& path) {
  return fs::exists(fs::symlink_status(path));
}

void write_files(const fs::path& folder, const Kind& kind, const std::string& name) {
  fs::create_directories(folder);
  for (const TemplateFile& file : kind.files) {
    const fs::path path = folder / filled(file.name, kind, name);
    write_whole_file(path, filled(file.text, kind, name));
    if (path.extension() == ".sh")
      fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
  }
}

}  // namespace

Usage usage_of_new_plugin() {
  Usage usage{
      "new-plugin", "contact|material|cover NAME [options]",
      "Writes a folder with a plugin that builds and passes its own tests: CMakeLists.txt, one source\n"
      "with the lines of the law marked, README.md, a scene that compares it with a component of talus,\n"
      "a test and a CI script.",
      "KIND NAME",
      "  talus new-plugin contact soft_contact\n"
      "  cmake -S soft_contact -B soft_contact/build && cmake --build soft_contact/build\n"};
  usage.options.add_options()("out,o", po::value<std::string>()->value_name("DIR"),
                              "folder to write, which must not exist (default: NAME)");
  add_plugin_path(usage);
  return usage;
}

int new_plugin_command(const Words& words) {
  const Usage usage = usage_of_new_plugin();
  const auto given = read_arguments(usage, words);
  if (!given) return exit_code::ok;
  const Kind& kind = kind_named(usage, text_option(*given, "KIND"));
  const std::string name = text_option(*given, "NAME");
  check_name(usage, load_registry(usage, *given), name);
  const std::string out = text_option(*given, "out");
  fs::path folder = fs::absolute(out.empty() ? name : out).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // written with a slash at its end
  if (is_there(folder)) {
    throw InputError(
        fmt::format("'{}' exists: nothing was written; take another NAME or --out DIR", folder.string()));
  }
  // Beside it first, so that what has the name is whole.
  const fs::path unfinished = folder.string() + ".unfinished";
  if (is_there(unfinished)) {
    throw InputError(
        fmt::format("'{}' is in the way: nothing was written; move it, or take another NAME or --out DIR",
                    unfinished.string()));
  }
  fs::path parent = folder.parent_path();
  while (!is_there(parent)) parent = parent.parent_path();
  try {
    write_files(unfinished, kind, name);
    fs::rename(unfinished, folder);
  } catch (...) {
    std::error_code stays;
    fs::remove_all(unfinished, stays);
    for (fs::path made = folder.parent_path(); made != parent; made = made.parent_path())
      fs::remove(made, stays);
    throw;
  }
  const std::string from = shell_word(folder.string()), build = shell_word((folder / "build").string());
  fmt::print(
      "{} {} in {}\n"
      "  its law is in the marked lines of {}.cpp; build and test it with\n"
      "  cmake -S {} -B {} && cmake --build {} && ctest --test-dir {}\n",
      kind.in_words, name, folder.string(), name, from, build, build, build);
  return exit_code::ok;
}

}  // namespace talus
