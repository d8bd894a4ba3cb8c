#include "study/study_page.hpp"

#include "report/html_page.hpp"
#include "study/study_charts.hpp"
#include "text/escaped.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

constexpr double widest_bar = 6;  ///< em

std::string cell(const std::string& text) {
  return fmt::format("<td>{}</td>", escaped(text));
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

/// Of one run, or of a run that the others are measured against.
std::string error_cell(const StudyFindings& findings, std::size_t run, double largest) {
  if (findings.reference == run) return "<td>reference</td>";
  const std::optional<double>& error = findings.runs[run].error;
  if (!error) return "<td>–</td>";
  return fmt::format("<td><span class=\"bar\" style=\"width:{:.2f}em\"></span>{}</td>",
                     largest > 0 ? widest_bar * *error / largest : 0.0, percent(*error));
}

std::string row(const StudyPlan& plan, const std::vector<StudyRun>& runs, const StudyFindings& findings,
                std::size_t i, double largest) {
  const StudyRun& run = runs[i];
  std::string text = "<tr>";
  text += cell((findings.runs[i].on_front ? "★ " : "") + run.folder.filename().string());
  for (const std::string& value : plan.points[i].values) text += cell(value);
  if (!finished(run)) {
    text += fmt::format("<td class=\"bad\">{}</td><td class=\"bad words\" colspan=\"6\">{}</td></tr>\n",
                        escaped(run.done ? run.end : "not run"), escaped(run.trouble));
    return text;
  }
  text += cell(run.end) + error_cell(findings, i, largest);
  text += cell(fmt::format("{:.3g}", run.cpu)) + cell(fmt::format("{:.4g}", run.work));
  text += cell(fmt::format("{:.4g}", run.dt)) + cell(percent(run.residual));
  text += cell(fmt::format("{:.3g}", run.penetration));
  return text + "</tr>\n";
}

std::string table_of_runs(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                          const StudyFindings& findings) {
  double largest = 0;
  for (const StudyFinding& found : findings.runs) largest = std::max(largest, found.error.value_or(0));
  std::string text = "<div class=\"scroll\"><table>\n<tr><th>run</th>";
  for (const std::string& pointer : plan.pointers) text += fmt::format("<th>{}</th>", escaped(pointer));
  for (const char* name : {"end", "error", "CPU [s]", "element steps", "Δt [s]", "residual", "overlap [m]"})
    text += fmt::format("<th>{}</th>", name);
  text += "</tr>\n";
  // What failed comes last: it cost next to nothing and says nothing of errors.
  for (const bool good : {true, false}) {
    for (const std::size_t i : by_cost(runs)) {
      if (finished(runs[i]) == good) text += row(plan, runs, findings, i, largest);
    }
  }
  return text + "</table></div>\n";
}

std::string table_of_orders(const StudyPlan& plan, const StudyFindings& findings) {
  std::string text =
      "<table>\n<tr><th>varied</th><th>finest</th><th>between neighbours</th><th>of all</th></tr>\n";
  for (const ObservedOrder& order : findings.orders) {
    std::string between;
    for (const double each : order.orders) between += fmt::format("{:.2f} ", each);
    text += "<tr>" + cell(plan.pointers[order.variation]) + cell(plan.words(plan.points[order.runs.back()])) +
            fmt::format("<td class=\"words\">{}</td>", between) + cell(fmt::format("{:.2f}", order.fit)) +
            "</tr>\n";
  }
  return text + "</table>\n";
}

std::string tiles_of(const std::vector<StudyRun>& runs, const StudyFindings& findings) {
  const auto failed = std::count_if(runs.begin(), runs.end(), [](const StudyRun& r) { return !finished(r); });
  std::string text = tile("Runs", fmt::format("{}", runs.size()),
                          failed > 0 ? fmt::format("{} of them failed", failed) : "all finished");
  std::optional<std::size_t> nearest, cheapest;
  double residual = 0, overlap = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!finished(runs[i])) continue;
    residual = std::max(residual, runs[i].residual);
    overlap = std::max(overlap, runs[i].penetration);
    if (!findings.runs[i].error) continue;
    if (!nearest || *findings.runs[i].error < *findings.runs[*nearest].error) nearest = i;
    if (!cheapest || runs[i].cpu < runs[*cheapest].cpu) cheapest = i;
  }
  const auto add = [&](const char* heading, std::size_t run) {
    text += tile(heading, percent(*findings.runs[run].error),
                 fmt::format("at {:.3g} s of CPU, {}", runs[run].cpu, runs[run].folder.filename().string()));
  };
  if (nearest) add("Nearest", *nearest);
  if (cheapest) add("Cheapest", *cheapest);
  text += tile("Largest energy residual", percent(residual), "of the throughput, over all runs");
  text += tile("Largest overlap", fmt::format("{:.3g} m", overlap), "over all runs");
  return "<section class=\"tiles\">\n" + text + "</section>\n";
}

std::string cost_note(const std::vector<StudyRun>& runs) {
  std::size_t times = 1;
  for (const StudyRun& run : runs) times = std::max(times, run.cpu_of_each.size());
  return times > 1 ? fmt::format("cost is the median of {} times", times)
                   : "cost is that of one time: --repeat takes a median";
}

}  // namespace

std::string study_page(const std::string& title, const std::string& command, const StudyPlan& plan,
                       const std::vector<StudyRun>& runs, const StudyFindings& findings) {
  const std::string against = words_of_reference(plan, findings);
  std::string main = tiles_of(runs, findings);
  main += card("Error against cost", cost_note(runs), drawing(study_svg(plan, runs, findings)), false);
  for (const std::string& chart : order_charts(plan, runs, findings))
    main +=
        card("Observed order", "errors over sizes, and the order that fits all best", drawing(chart), false);
  main += card("Energy residual", "what the ledger misses at most", drawing(residual_svg(plan, runs)), false);
  main += card("Overlap", "the deepest of the run", drawing(overlap_svg(plan, runs)), false);
  if (!findings.orders.empty())
    main += card("Orders", "p of C |hᵖ − rᵖ|, r being the size of the reference run; of C hᵖ against a file",
                 table_of_orders(plan, findings), true);
  main += card("All runs", "from the cheapest; ★ none is both cheaper and nearer",
               table_of_runs(plan, runs, findings), true);
  main +=
      card("To repeat", "",
           fmt::format("<p><code>{}</code></p>\n<p>talus {}; the figures are in study.csv and study.json, "
                       "each run's own in its folder.</p>\n",
                       escaped(command), TALUS_VERSION),
           true);
  return plain_page(title,
                    fmt::format("A study of {}: error of {} against {}; RMS over the largest magnitude",
                                fmt::join(plan.pointers, " and "), findings.column, against),
                    main);
}

}  // namespace talus
