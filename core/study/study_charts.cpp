#include "study/study_charts.hpp"

#include "picture/marks.hpp"
#include "picture/palette.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

constexpr std::size_t most_labels = 12;  ///< of marks that are not on the front
constexpr const char* cost_label = "CPU in the steps [s]";

std::string_view colour_of_family(std::size_t number) {
  return palette::lines[number % std::size(palette::lines)];
}

/// What the members of a family have in common: "model=overlap_area", or nothing.
std::string common_words(const StudyPlan& plan, const StudyFamily& family) {
  StudyPlan others = plan;
  StudyPoint point = plan.points[family.runs.front()];
  const auto at = static_cast<std::ptrdiff_t>(family.variation);
  others.pointers.erase(others.pointers.begin() + at);
  point.values.erase(point.values.begin() + at);
  return others.words(point);
}

/// `of` of each run in `families` against the number they vary, with the labels of their lines.
std::string family_chart(const StudyPlan& plan, const std::string& title, const std::string& y_label,
                         const std::vector<StudyFamily>& families, const std::vector<std::string>& labels,
                         const std::vector<double>& of) {
  std::vector<Mark> marks;
  std::vector<MarkLine> lines;
  for (std::size_t f = 0; f < families.size(); ++f) {
    MarkLine& line = lines.emplace_back(MarkLine{{}, colour_of_family(f), "", labels[f]});
    for (const std::size_t run : families[f].runs) {
      line.marks.push_back(marks.size());
      marks.push_back({number_of(plan, families[f].variation, run), of[run], "",
                       fmt::format("{}: {:.4g}", plan.words(plan.points[run]), of[run]), line.colour});
    }
  }
  return marks_svg(title, plan.pointers[families.front().variation], y_label, marks, lines);
}

/// A figure of all runs that finished.
std::string figure_svg(const StudyPlan& plan, const std::vector<StudyRun>& runs, const std::string& title,
                       const std::string& y_label, const std::vector<double>& of) {
  std::vector<StudyFamily> shown = families(plan, runs);
  if (shown.empty()) {
    std::vector<Mark> marks;
    for (const std::size_t i : by_cost(runs)) {
      const std::string words = plan.words(plan.points[i]);
      if (finished(runs[i]))
        marks.push_back(
            {runs[i].cpu, of[i], words, fmt::format("{}: {:.4g}", words, of[i]), palette::lines[0]});
    }
    return marks_svg(title, cost_label, y_label, marks, {});
  }
  std::erase_if(shown, [first = shown.front().variation](const StudyFamily& family) {
    return family.variation != first;
  });
  std::vector<std::string> labels;
  for (const StudyFamily& family : shown) labels.push_back(common_words(plan, family));
  return family_chart(plan, title, y_label, shown, labels, of);
}

}  // namespace

std::string study_svg(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                      const StudyFindings& findings) {
  std::vector<Mark> marks;
  MarkLine front{{}, palette::lines[2], "6 3", "none is both cheaper and nearer"};
  for (const std::size_t i : by_cost(runs)) {
    const StudyFinding& found = findings.runs[i];
    if (!found.error) continue;
    const std::string words = plan.words(plan.points[i]);
    if (found.on_front) front.marks.push_back(marks.size());
    marks.push_back({runs[i].cpu, 100 * *found.error, words,
                     fmt::format("{}: {:.3g} %, {:.3g} s", words, 100 * *found.error, runs[i].cpu),
                     found.on_front ? palette::lines[0] : palette::faint});
  }
  if (marks.size() > most_labels) {
    for (Mark& mark : marks) {
      if (mark.colour == palette::faint) mark.label.clear();
    }
  }
  return marks_svg("Error of " + findings.column + " against cost", cost_label, "error [%]", marks, {front});
}

std::vector<std::string> order_charts(const StudyPlan& plan, const std::vector<StudyRun>& runs,
                                      const StudyFindings& findings) {
  std::vector<double> errors(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) errors[i] = 100 * findings.runs[i].error.value_or(0);
  std::vector<std::string> charts;
  for (std::size_t v = 0; v < plan.pointers.size(); ++v) {
    std::vector<StudyFamily> shown;
    std::vector<std::string> labels;
    for (const ObservedOrder& order : findings.orders) {
      if (order.variation != v) continue;
      shown.push_back(order);
      const std::string common = common_words(plan, order);
      labels.push_back(fmt::format("{}{}order {:.2f}", common, common.empty() ? "" : ": ", order.fit));
    }
    if (!shown.empty())
      charts.push_back(family_chart(plan, "Error of " + findings.column + " against " + plan.pointers[v],
                                    "error [%]", shown, labels, errors));
  }
  return charts;
}

std::string residual_svg(const StudyPlan& plan, const std::vector<StudyRun>& runs) {
  std::vector<double> residual;
  for (const StudyRun& run : runs) residual.push_back(100 * run.residual);
  return figure_svg(plan, runs, "Largest energy residual", "% of the throughput", residual);
}

std::string overlap_svg(const StudyPlan& plan, const std::vector<StudyRun>& runs) {
  std::vector<double> overlap;
  for (const StudyRun& run : runs) overlap.push_back(run.penetration);
  return figure_svg(plan, runs, "Largest overlap", "overlap [m]", overlap);
}

}  // namespace talus
