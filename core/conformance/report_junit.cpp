#include "conformance/check_components.hpp"

#include "text/escaped.hpp"

#include <fmt/format.h>

namespace talus::conformance {

std::string junit_of(const std::vector<ComponentReport>& reports) {
  std::size_t tests = 0, failures = 0;
  std::string suites;
  for (const ComponentReport& report : reports) {
    const std::string name = escaped(report.component.component->name);
    tests += report.outcomes.size();
    failures += report.count(Verdict::failed);
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" "
        "time=\"{:.3f}\">\n",
        name, report.outcomes.size(), report.count(Verdict::failed),
        report.count(Verdict::not_claimed) + report.count(Verdict::not_run), report.seconds());
    for (const Outcome& outcome : report.outcomes) {
      suites += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", name,
                            escaped(outcome.check), outcome.seconds);
      switch (outcome.verdict) {
        case Verdict::passed:
          suites += "/>\n";
          break;
        case Verdict::failed:
          suites += fmt::format(
              ">\n      <failure message=\"{1}\">fed: {0}\nfound: {1}\ndue: {2}</failure>\n    "
              "</testcase>\n",
              escaped(outcome.fed), escaped(outcome.found), escaped(outcome.due));
          break;
        case Verdict::not_claimed:
        case Verdict::not_run:
          suites += fmt::format(">\n      <skipped message=\"{}: {}\"/>\n    </testcase>\n",
                                verdict_in_words(outcome.verdict), escaped(outcome.found));
          break;
        case Verdict::figure:
          suites +=
              fmt::format(">\n      <system-out>{}</system-out>\n    </testcase>\n", escaped(outcome.found));
          break;
      }
    }
    suites += "  </testsuite>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"talus check-plugin\" tests=\"{}\" "
      "failures=\"{}\">\n{}</testsuites>\n",
      tests, failures, suites);
}

}  // namespace talus::conformance
