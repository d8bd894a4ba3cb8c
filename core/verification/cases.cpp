#include "files/input_error.hpp"
#include "text/nearest.hpp"
#include "verification/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace talus::verification {
namespace {

bool fits(std::string_view pattern, std::string_view name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == name;
  if (name.substr(0, star) != pattern.substr(0, star)) return false;
  for (std::size_t at = star; at <= name.size(); ++at) {
    if (fits(pattern.substr(star + 1), name.substr(at))) return true;
  }
  return false;
}

bool fits(const std::string& pattern, const Case& each) {
  return fits(pattern, each.group) || fits(pattern, each.name) || fits(pattern, each.full_name());
}

}  // namespace

std::vector<const Case*> all_cases() {
  std::vector<const Case*> all;
  for (const std::span<const Case> some :
       {incline_cases(), friction_cases(), impact_cases(), statics_cases(), continuum_cases(), mass_cases(),
        hertz_cases(), example_cases(), same_bits_cases(), ratio_cases(), shape_cases(), step_cases(),
        many_cases(), metamorphic_cases()}) {
    for (const Case& each : some) all.push_back(&each);
  }
  return all;
}

std::vector<const Case*> chosen_cases(const std::vector<std::string>& patterns) {
  std::vector<const Case*> all = all_cases();
  if (patterns.empty()) return all;
  for (const std::string& pattern : patterns) {
    if (std::any_of(all.begin(), all.end(), [&](const Case* each) { return fits(pattern, *each); })) continue;
    std::vector<std::string> groups, names;
    for (const Case* each : all) {
      if (groups.empty() || groups.back() != each->group) groups.emplace_back(each->group);
      names.push_back(each->full_name());
      names.emplace_back(each->name);
    }
    names.insert(names.end(), groups.begin(), groups.end());
    throw InputError(fmt::format("no case is called '{}';{} groups: {}; `talus verify --list` has all cases",
                                 pattern, did_you_mean(pattern, names), fmt::join(groups, ", ")));
  }
  std::vector<const Case*> chosen;
  for (const Case* each : all) {
    if (std::any_of(patterns.begin(), patterns.end(),
                    [&](const std::string& pattern) { return fits(pattern, *each); }))
      chosen.push_back(each);
  }
  return chosen;
}

}  // namespace talus::verification
