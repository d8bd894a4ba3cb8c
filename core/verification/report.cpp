#include "verification/report.hpp"

#include "files/input_error.hpp"
#include "files/marked_tables.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace talus::verification {
namespace {

const char* verdict(const Row& row) {
  if (!row.held) return "";
  return *row.held ? "held" : "MISSED";
}

std::string against(const Row& row) {
  return row.tolerance.empty() ? row.reference : fmt::format("{} ± {}", row.reference, row.tolerance);
}

std::string in_cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.replace(at, 1, "\\|");
  return text;
}

}  // namespace

std::string text_of(const CaseResult& result) {
  std::string text = fmt::format("{}: {}\n", result.of->full_name(), result.of->sentence);
  for (const Row& row : result.rows) {
    text += fmt::format("  {:<6}  {:<14}  {}: {}", verdict(row), in_words(row.kind), row.what, row.measured);
    const std::string due = against(row);
    text += due.empty() ? "\n" : fmt::format(" ({})\n", due);
  }
  if (!result.trouble.empty()) text += fmt::format("  MISSED  ended before its end: {}\n", result.trouble);
  return text;
}

std::string list_of(const std::vector<const Case*>& cases) {
  std::size_t widest = 0;
  for (const Case* each : cases) widest = std::max(widest, each->full_name().size());
  std::string text;
  for (const Case* each : cases)
    text += fmt::format("{:<{}}  {}\n", each->full_name(), widest, each->sentence);
  return text;
}

std::string markdown_table(const std::vector<CaseResult>& results, const std::string& group) {
  std::string text = "| what | kind | reference | tolerance | measured | |\n|---|---|---|---|---|---|\n";
  for (const CaseResult& result : results) {
    if (group != result.of->group) continue;
    text += fmt::format("| **`{}`** {} | | | | | |\n", result.of->name, in_cell(result.of->sentence));
    for (const Row& row : result.rows) {
      text += fmt::format("| – {} | {} | {} | {} | {} | {} |\n", in_cell(row.what), in_words(row.kind),
                          in_cell(row.reference), row.tolerance, in_cell(row.measured), verdict(row));
    }
    if (!result.trouble.empty())
      text += fmt::format("| – ended before its end | | | | {} | MISSED |\n", in_cell(result.trouble));
  }
  return text;
}

std::string markdown_of(const std::vector<CaseResult>& results) {
  std::string text;
  const char* group = "";
  for (const CaseResult& result : results) {
    if (std::string(group) == result.of->group) continue;
    group = result.of->group;
    text += fmt::format("{}## {}\n\n{}", text.empty() ? "" : "\n", group, markdown_table(results, group));
  }
  return text;
}

std::string with_tables(const std::string& markdown, const std::vector<CaseResult>& results) {
  std::map<std::string, std::size_t> due, measured;
  for (const Case* each : all_cases()) ++due[each->group];
  for (const CaseResult& result : results) measured[result.of->group] += result.done ? 1 : 0;
  std::map<std::string, std::optional<std::string>> tables;
  for (const auto& [group, count] : due) {
    tables[group];
    if (measured[group] == count) tables[group] = markdown_table(results, group);
  }
  std::string document = with_marked_tables(markdown, "verify", tables);
  const bool written = std::any_of(tables.begin(), tables.end(), [&](const auto& entry) {
    return entry.second &&
           markdown.find(fmt::format("<!-- verify: {} -->", entry.first)) != std::string::npos;
  });
  if (!written)
    throw InputError("nothing to write: of no group that the document has all cases were measured");
  return document;
}

std::string json_of(const std::vector<CaseResult>& results) {
  using Json = nlohmann::ordered_json;
  std::size_t missed = 0, held = 0;
  Json cases = Json::array();
  for (const CaseResult& result : results) {
    Json rows = Json::array();
    for (const Row& row : result.rows) {
      held += row.held.value_or(false) ? 1 : 0;
      rows.push_back({{"what", row.what},
                      {"kind", in_words(row.kind)},
                      {"reference", row.reference},
                      {"tolerance", row.tolerance},
                      {"measured", row.measured},
                      {"value", row.value ? Json(*row.value) : Json()},
                      {"held", row.held ? Json(*row.held) : Json()}});
    }
    missed += result.missed();
    cases.push_back({{"group", result.of->group},
                     {"name", result.of->name},
                     {"prediction", result.of->sentence},
                     {"done", result.done},
                     {"trouble", result.trouble},
                     {"rows", rows}});
  }
  return Json{{"talus", TALUS_VERSION}, {"held", held}, {"missed", missed}, {"cases", cases}}.dump(1) + "\n";
}

std::string summary_of(const std::vector<CaseResult>& results) {
  std::size_t held = 0, missed = 0, shown = 0;
  for (const CaseResult& result : results) {
    missed += result.missed();
    for (const Row& row : result.rows) {
      held += row.held.value_or(false) ? 1 : 0;
      shown += row.held ? 0 : 1;
    }
  }
  return fmt::format("{} held, {} missed, {} shown", held, missed, shown);
}

}  // namespace talus::verification
