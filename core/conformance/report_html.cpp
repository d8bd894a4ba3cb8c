#include "conformance/check_components.hpp"

#include "plugin/refusal.hpp"
#include "report/html_page.hpp"
#include "text/escaped.hpp"

#include <fmt/format.h>

namespace talus::conformance {
namespace {

const char* class_of(Verdict verdict) {
  return verdict == Verdict::passed ? "passed" : verdict == Verdict::failed ? "failed" : "other";
}

std::string row_of(const Check& check, const Outcome& outcome) {
  std::string more;
  if (outcome.verdict == Verdict::failed) {
    more = fmt::format("<dl><dt>fed</dt><dd>{}</dd><dt>found</dt><dd>{}</dd><dt>due</dt><dd>{}</dd></dl>",
                       escaped(outcome.fed), escaped(outcome.found), escaped(outcome.due));
  } else if (!outcome.found.empty()) {
    more = fmt::format("<div class=\"other\">{}</div>", escaped(outcome.found));
  }
  return fmt::format("<tr><td class=\"{}\">{}</td><td><code>{}</code></td><td>{}{}</td><td>{}</td></tr>\n",
                     class_of(outcome.verdict), verdict_in_words(outcome.verdict), escaped(outcome.check),
                     escaped(check.sentence), more, outcome.cases == 0 ? "" : std::to_string(outcome.cases));
}

}  // namespace

std::string html_of(const std::vector<ComponentReport>& reports) {
  std::string main;
  for (const ComponentReport& report : reports) {
    const Component& component = *report.component.component;
    std::string content = fmt::format(
        "<p>{}<br>from <code>{}</code></p>\n<p>{} passed, {} failed, {} not claimed, {} not run</p>\n",
        escaped(component.sentence), escaped(report.component.file.filename().string()),
        report.count(Verdict::passed), report.count(Verdict::failed), report.count(Verdict::not_claimed),
        report.count(Verdict::not_run));
    content += "<div class=\"scroll whole\"><table class=\"prose\">\n";
    const std::span<const Check> checks = checks_of(component.kind);
    for (std::size_t i = 0; i < report.outcomes.size(); ++i) content += row_of(checks[i], report.outcomes[i]);
    content += "</table></div>\n";
    main += card(fmt::format("{} {}", kind_in_words(component.kind), component.name), "", content, true);
  }
  return plain_page("talus " TALUS_VERSION " check-plugin", "", main);
}

}  // namespace talus::conformance
