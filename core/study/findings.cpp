#include "study/findings.hpp"

#include "compare/deviation.hpp"
#include "files/input_error.hpp"
#include "simulation/simulation.hpp"
#include "study/orders.hpp"
#include "text/plain_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace talus {
namespace {

std::optional<std::size_t> most_work(const std::vector<StudyRun>& runs) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (finished(runs[i]) && (!best || runs[i].work > runs[*best].work)) best = i;
  }
  return best;
}

/// Of a column, the line between its rows, as far as another history goes: what comes later must not make its
/// errors small.
double largest_magnitude(const Series& series, std::size_t column, const Series& as_far_as) {
  double largest = 0;
  if (as_far_as.time.empty()) return 0;
  for (const double end : {as_far_as.time.front(), as_far_as.time.back()}) {
    const std::optional<double> value = interpolate(series.time, series.values[column], end);
    if (value && std::isfinite(*value)) largest = std::max(largest, std::abs(*value));
  }
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    const bool within =
        series.time[i] >= as_far_as.time.front() && series.time[i] <= as_far_as.time.back() * (1 + 1e-9);
    const double value = series.values[column][i];
    if (within && std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

void mark_front(const std::vector<StudyRun>& runs, std::vector<StudyFinding>& findings) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!findings[i].error) continue;
    findings[i].on_front = true;
    for (std::size_t j = 0; j < runs.size(); ++j) {
      if (!findings[j].error) continue;
      const bool no_worse = runs[j].cpu <= runs[i].cpu && *findings[j].error <= *findings[i].error;
      const bool better = runs[j].cpu < runs[i].cpu || *findings[j].error < *findings[i].error;
      if (no_worse && better) findings[i].on_front = false;
    }
  }
}

std::optional<double> number_in(const std::string& text) {
  const std::optional<double> value = plain_number(text);
  return value && *value > 0 ? value : std::nullopt;
}

std::string words_of_nothing(const StudyPlan& plan, const std::vector<StudyRun>& runs) {
  std::string words = "no run of the study finished: there is nothing to measure";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].trouble.empty())
      return fmt::format("{}; that with {}: {}", words, plan.words(plan.points[i]), runs[i].trouble);
  }
  return words;
}

/// Of errors: what rounding makes in a run says nothing of its steps.
constexpr double round_off = 1e-11;
/// Share by which one and the same run may cost more or less from time to time.
constexpr double clock_noise = 0.05;

/// A step that is stated is rounded to whole steps per output, and one that is voted may be bound by more
/// than its safety: its order is in those that ran.
double h_of(const StudyPlan& plan, std::size_t variation, std::size_t number, const StudyRun& run) {
  const std::string& pointer = plan.pointers[variation];
  return pointer == "/time/dt" || pointer == "/time/safety" ? run.dt : number_of(plan, variation, number);
}

/// Whether it says how finely a run resolves what it computes: errors have an order in nothing else.
bool is_resolution(const std::string& pointer) {
  const std::string key = pointer.substr(pointer.rfind('/') + 1);
  return key == "dt" || key == "safety" || key == "size" || key.ends_with("_stiffness") ||
         key.ends_with("_spring");
}

/// Against a run, of those families that it belongs to: in others it differs by more than their number, and
/// errors need not vanish towards it.
void find_orders(const StudyPlan& plan, const std::vector<StudyRun>& runs, StudyFindings& findings) {
  for (const StudyFamily& family : families(plan, runs)) {
    if (!is_resolution(plan.pointers[family.variation])) continue;
    const auto has = [&](std::size_t run) { return std::ranges::count(family.runs, run) != 0; };
    if (findings.reference && !has(*findings.reference)) continue;
    // Where that did no more work than others of the family, nothing says which end of it is the finer.
    const auto as_much = [&](std::size_t run) { return runs[run].work == runs[*findings.reference].work; };
    if (findings.reference && std::ranges::count_if(family.runs, as_much) > 1) continue;
    ObservedOrder order{{family.variation, {}}, {}};
    std::vector<double> sizes, errors;
    for (const std::size_t run : family.runs) {
      if (!findings.runs[run].error || !(*findings.runs[run].error > round_off)) continue;
      const double size = h_of(plan, family.variation, run, runs[run]);
      if (!sizes.empty() && std::abs(size - sizes.back()) <= 1e-9 * size) continue;  // the same once more
      order.runs.push_back(run);
      sizes.push_back(size);
      errors.push_back(*findings.runs[run].error);
    }
    if (order.runs.size() < 2) continue;
    std::optional<double> of_reference;
    if (findings.reference)
      of_reference = h_of(plan, family.variation, *findings.reference, runs[*findings.reference]);
    const Convergence convergence(sizes, errors, of_reference);
    order.orders = convergence.between_neighbours();
    const std::optional<double> fit = convergence.fit();
    if (!fit) continue;
    order.fit = *fit;
    if (const auto missed = convergence.error_of_reference())
      findings.error_of_reference = findings.error_of_reference.value_or(0) + *missed;
    findings.orders.push_back(std::move(order));
  }
}

}  // namespace

std::vector<StudyFamily> families(const StudyPlan& plan, const std::vector<StudyRun>& runs) {
  std::vector<StudyFamily> found;
  for (std::size_t v = 0; v < plan.pointers.size(); ++v) {
    std::map<std::vector<std::string>, std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < plan.points.size(); ++i) {
      std::vector<std::string> others = plan.points[i].values;
      others[v].clear();
      if (number_in(plan.points[i].values[v]) && finished(runs[i])) alike[others].push_back(i);
    }
    for (auto& [others, members] : alike) {
      if (members.size() < 2) continue;
      std::sort(members.begin(), members.end(),
                [&](std::size_t p, std::size_t q) { return number_of(plan, v, p) > number_of(plan, v, q); });
      found.push_back({v, members});
    }
  }
  return found;
}

double number_of(const StudyPlan& plan, std::size_t variation, std::size_t run) {
  return number_in(plan.points[run].values[variation]).value_or(0);
}

std::string words_of_reference(const StudyPlan& plan, const StudyFindings& findings) {
  if (!findings.reference) {
    return findings.part.empty() ? "the reference file"
                                 : fmt::format("the reference file, which goes {}", findings.part);
  }
  const std::string run = plan.words(plan.points[*findings.reference]);
  if (!findings.reference_is_one_of_many) {
    if (!findings.error_of_reference) return run + " (most work)";
    return fmt::format("{} (most work; misses about {:.2g} % itself)", run,
                       100 * *findings.error_of_reference);
  }
  return run + " (first of several that did the most work, and no better than they are: give a --reference)";
}

namespace {

/// Whether one curve goes on for as long as another, as the error of all of that asks.
bool covers(const Series& due, const Series& history) {
  if (due.time.empty() || history.time.empty()) return false;
  const double little = time_tolerance(history.time);
  return due.time.front() <= history.time.front() + little && due.time.back() >= history.time.back() - little;
}

/// What errors are measured against: a column of the reference, or of the run with the most work.
struct Due {
  const Series& curves;
  const std::string& name;
  std::size_t column;
  bool of_a_run;
};

std::string words_of_other_times(const Series& history, const Series& due) {
  return fmt::format(
      "it goes from {:.6g} to {:.6g} s, and the run with the most work from {:.6g} to {:.6g}; a "
      "--reference may do",
      history.time.empty() ? 0 : history.time.front(), history.time.empty() ? 0 : history.time.back(),
      due.time.front(), due.time.back());
}

/// What stands in the way of any run's error where it does so in all of them.
enum class Found { no_column, no_common_time, something };

Found find_error(const Series& history, const Due& due, StudyFinding& of_run) {
  const auto own = history.column(due.name);
  if (!own) {
    of_run.why_none = "it has no such column";
    return Found::no_column;
  }
  if (due.of_a_run && !(covers(due.curves, history) && covers(history, due.curves))) {
    of_run.why_none = words_of_other_times(history, due.curves);
    return Found::something;
  }
  const auto found =
      deviation(history, *own, due.curves, due.column, due.of_a_run ? Between::unknown : Between::line);
  const double scale = largest_magnitude(due.curves, due.column, history);
  if (!found || !std::isfinite(found->rms) || !(scale > 0)) {
    of_run.why_none = !found      ? "it has no time in common with the reference"
                      : scale > 0 ? "its values are no finite numbers"
                                  : "it and the reference are 0 wherever both are";
    return found ? Found::something : Found::no_common_time;
  }
  of_run.rms = found->rms;
  of_run.largest = found->largest;
  of_run.error = found->rms / scale;
  return Found::something;
}

/// Refuses what no error can be a share of.
void check_size(const Due& due, double rounding) {
  const double largest = largest_magnitude(due.curves, due.column, due.curves);
  if (largest > rounding) return;
  throw InputError(fmt::format(
      "'{}' is {} all along in the reference, so that no error is a share of it; choose another --metric",
      due.name, largest == 0 ? "0" : fmt::format("rounding, {:.2g} at most,", largest)));
}

}  // namespace

void check_reference(const Series& reference, const std::string& column, const char* called) {
  if (reference.column(column)) return;
  throw InputError(fmt::format("{} has no column '{}'; it has '{}': choose one of these by --metric", called,
                               column, fmt::join(reference.names, "', '")));
}

StudyFindings find_out(const StudyPlan& plan, const std::vector<StudyRun>& runs, const std::string& column,
                       const std::optional<Series>& reference, double rounding) {
  StudyFindings findings;
  findings.column = column;
  findings.runs.resize(runs.size());
  const std::optional<std::size_t> finest = most_work(runs);
  if (!finest) {
    if (std::all_of(runs.begin(), runs.end(), [](const StudyRun& run) { return run.end == "refused"; }))
      throw InputError(words_of_nothing(plan, runs));
    throw NumericalTrouble(words_of_nothing(plan, runs));
  }
  if (!reference) {
    findings.reference = finest;
    findings.reference_is_one_of_many = std::count_if(runs.begin(), runs.end(), [&](const StudyRun& run) {
                                          return finished(run) && run.work == runs[*finest].work;
                                        }) > 1;
  }
  const Series& curves = reference ? *reference : runs[*finest].history;
  check_reference(curves, column, reference ? "the reference" : "the run with the most work");
  const Due due{curves, column, *curves.column(column), !reference};
  check_size(due, rounding);
  bool any = false, any_in_common = false, any_column = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!finished(runs[i]) || findings.reference == i) continue;
    const Series& history = runs[i].history;
    if (reference && history.column(column) && !covers(curves, history))
      findings.part = fmt::format("from {:.6g} to {:.6g} s", curves.time.front(), curves.time.back());
    const Found found = find_error(history, due, findings.runs[i]);
    any = true;
    any_column = any_column || found != Found::no_column;
    any_in_common = any_in_common || found == Found::something;
  }
  if (reference && any && !any_column)
    throw InputError(fmt::format("no run that finished has a column '{}', which the reference has", column));
  if (reference && !any_in_common) {
    throw InputError(
        fmt::format("the reference goes from {:.6g} to {:.6g} s and has no time in common with a run",
                    curves.time.front(), curves.time.back()));
  }
  mark_front(runs, findings.runs);
  find_orders(plan, runs, findings);
  return findings;
}

std::optional<std::size_t> cheapest_within(const StudyFindings& findings, const std::vector<StudyRun>& runs,
                                           double error) {
  const auto error_of = [&](std::size_t i) {
    return findings.runs[i].error.value_or(0) + findings.error_of_reference.value_or(0);
  };
  std::vector<std::size_t> within;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool is_reference = findings.reference == i && findings.error_of_reference;
    if ((findings.runs[i].error || is_reference) && error_of(i) <= error) within.push_back(i);
  }
  if (within.empty()) return std::nullopt;
  const auto cpu_of = [&](std::size_t i) { return runs[i].cpu; };
  const double least = cpu_of(*std::ranges::min_element(within, {}, cpu_of));
  std::erase_if(within, [&](std::size_t i) { return cpu_of(i) > (1 + clock_noise) * least; });
  return *std::ranges::min_element(within, {}, error_of);
}

}  // namespace talus
