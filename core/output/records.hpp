#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>

namespace talus {

/// What run.json of a folder says. Throws InputError where that is not what a run writes, std::system_error
/// where there is none.
nlohmann::ordered_json read_run_record(const std::filesystem::path& folder);

/// The same; nothing where there is none or it is damaged, for those who make such a run again.
std::optional<nlohmann::ordered_json> run_record_in(const std::filesystem::path& folder);

/// What compare.json of a folder says, likewise; of a comparison that did not come to its end it throws, too.
nlohmann::ordered_json read_comparison_record(const std::filesystem::path& folder);
/// Also while it is at work: which runs are of it.
std::optional<nlohmann::ordered_json> comparison_record_in(const std::filesystem::path& folder);

/// Whether a folder holds a comparison, not a run. Throws InputError where it holds neither.
bool holds_comparison(const std::filesystem::path& folder);

}  // namespace talus
