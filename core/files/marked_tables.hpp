#pragma once

#include <map>
#include <optional>
#include <string>

namespace talus {

/// A Markdown document with what stands between `<!-- KIND: name -->` and `<!-- end of KIND -->` replaced by
/// the table of that name; a table that is known but not there to be written leaves its place as it is.
/// Throws InputError where a marker names no table or has no end.
std::string with_marked_tables(const std::string& markdown, const std::string& kind,
                               const std::map<std::string, std::optional<std::string>>& tables);

}  // namespace talus
