#pragma once

#include "verification/verify.hpp"

#include <string>
#include <vector>

namespace talus::verification {

/// A case as lines for a terminal: its name and prediction, a line per row.
std::string text_of(const CaseResult& result);

/// "group/name  prediction" of each case.
std::string list_of(const std::vector<const Case*>& cases);

/// A table of all rows of a group for Markdown, without a heading.
std::string markdown_table(const std::vector<CaseResult>& results, const std::string& group);

/// All groups with headings.
std::string markdown_of(const std::vector<CaseResult>& results);

/// Writes the tables between the markers `<!-- verify: group -->` and `<!-- end of verify -->` of a document
/// anew; groups of which not all cases were measured stay as they are. Throws InputError where a marker names
/// no group, has no end, or no table was written.
std::string with_tables(const std::string& markdown, const std::vector<CaseResult>& results);

/// Version, counts, and each case with its rows.
std::string json_of(const std::vector<CaseResult>& results);

/// "61 held, 2 MISSED, 5 shown".
std::string summary_of(const std::vector<CaseResult>& results);

}  // namespace talus::verification
