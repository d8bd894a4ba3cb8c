#pragma once

#include <filesystem>
#include <string>

namespace talus {

/// Writes report.html into the folder of a run or of a comparison, from what is there: one page that needs
/// nothing else. Throws InputError where the folder holds no results of talus.
void write_report(const std::filesystem::path& folder);

/// The text of that page.
std::string report_page(const std::filesystem::path& folder);

}  // namespace talus
