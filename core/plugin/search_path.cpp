#include "plugin/registry.hpp"

#define BOOST_DLL_USE_STD_FS
#include <boost/dll/runtime_symbol_info.hpp>

#include <cstdlib>

namespace talus {

std::filesystem::path installation_prefix() {
  return boost::dll::program_location().parent_path().parent_path();
}

std::vector<std::filesystem::path> chosen_folders(std::span<const std::filesystem::path> from_command_line) {
  std::vector<std::filesystem::path> folders;
  for (const auto& folder : from_command_line) folders.push_back(std::filesystem::absolute(folder));
  if (const char* variable = std::getenv("TALUS_PLUGIN_PATH")) {
    std::string_view rest = variable;
    while (!rest.empty()) {
      const std::size_t colon = rest.find(':');
      const std::string_view folder = rest.substr(0, colon);
      if (!folder.empty()) folders.push_back(std::filesystem::absolute(folder));
      rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
    }
  }
  return folders;
}

std::vector<std::filesystem::path> search_path(std::span<const std::filesystem::path> from_command_line) {
  std::vector<std::filesystem::path> folders = chosen_folders(from_command_line);
  folders.push_back(installation_prefix() / "lib" / "talus" / "plugins");
  return folders;
}

}  // namespace talus
