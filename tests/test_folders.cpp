#include "files/whole_file.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

using namespace talus;

namespace {

namespace fs = std::filesystem;

/// [folder] of core: those of which its files include one.
std::map<std::string, std::set<std::string>> included_folders(const fs::path& core) {
  const std::regex include("#include \"([a-z_]+)/");
  std::map<std::string, std::set<std::string>> all;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(core)) {
    const std::string folder = fs::relative(entry.path(), core).begin()->string();
    if (folder == "kit" || (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp"))
      continue;
    const std::string text = read_whole_file(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at) {
      if ((*at)[1] != folder) all[folder].insert((*at)[1]);
    }
  }
  return all;
}

/// Where a way along includes leads back to the folder that it begins in.
bool leads_to(const std::map<std::string, std::set<std::string>>& included, const std::string& from,
              const std::string& to, std::set<std::string>& seen) {
  const auto next = included.find(from);
  if (next == included.end()) return false;
  for (const std::string& folder : next->second) {
    if (folder == to || (seen.insert(folder).second && leads_to(included, folder, to, seen))) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("No folder of core depends on one that depends on it", "[folders]") {
  const auto included = included_folders(fs::path(TALUS_DOCS) / "../core");
  REQUIRE(included.at("simulation").contains("contact"));
  for (const auto& [folder, others] : included) {
    INFO(folder);
    std::set<std::string> seen;
    CHECK_FALSE(leads_to(included, folder, folder, seen));
  }
}
