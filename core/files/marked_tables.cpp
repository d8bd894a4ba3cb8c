#include "files/marked_tables.hpp"

#include "files/input_error.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace talus {

std::string with_marked_tables(const std::string& markdown, const std::string& kind,
                               const std::map<std::string, std::optional<std::string>>& tables) {
  const std::string begin_mark = fmt::format("<!-- {}: ", kind),
                    end_mark = fmt::format("<!-- end of {} -->", kind);
  constexpr std::string_view begin_end = " -->";
  std::string result;
  std::size_t at = 0;
  for (std::size_t mark = markdown.find(begin_mark); mark != std::string::npos;
       mark = markdown.find(begin_mark, at)) {
    const std::size_t from = mark + begin_mark.size(), to = markdown.find(begin_end, from);
    const std::string name = to == std::string::npos ? std::string() : markdown.substr(from, to - from);
    const auto table = tables.find(name);
    if (table == tables.end()) {
      std::vector<std::string> names;
      for (const auto& [known, text] : tables) names.push_back(known);
      throw InputError(fmt::format("there is no table \"{}\" for a {};{} known: {}", name, kind,
                                   did_you_mean(name, names), listed(names)));
    }
    const std::size_t end = markdown.find(end_mark, to);
    if (end == std::string::npos || markdown.find(begin_mark, to) < end)
      throw InputError(fmt::format("the table \"{}\" has no end: expected a line {}", name, end_mark));
    if (table->second) {
      result += markdown.substr(at, to + begin_end.size() - at) + '\n' + *table->second;
    } else {
      result += markdown.substr(at, end - at);
    }
    at = end;
  }
  return result + markdown.substr(at);
}

}  // namespace talus
