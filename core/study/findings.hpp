#pragma once

#include "study/study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace talus {

/// What one run of a study costs and how far it is from the reference.
struct StudyFinding {
  std::optional<double>
      error;  ///< RMS over the largest magnitude of the reference; none where the run failed
  std::optional<double> rms, largest;  ///< in the unit of the column
  bool on_front = false;               ///< no run is cheaper and nearer at once
  std::string why_none;                ///< of a run that finished and has no error
};

/// Runs that differ in one number alone.
struct StudyFamily {
  std::size_t variation;
  std::vector<std::size_t> runs;  ///< from the largest number to the smallest
};

/// Those of at least two that finished, variation after variation.
std::vector<StudyFamily> families(const StudyPlan& plan, const std::vector<StudyRun>& runs);

/// The number that a run of a family has.
double number_of(const StudyPlan& plan, std::size_t variation, std::size_t run);

/// Errors of a family, e ~ h^order (see Convergence).
struct ObservedOrder : StudyFamily {
  std::vector<double> orders;  ///< between neighbours in `runs`
  double fit = 0;              ///< of all runs, by least squares
};

struct StudyFindings {
  std::string column;                     ///< "<monitor>.<quantity> [unit]"
  std::optional<std::size_t> reference;   ///< the run that the others are measured against; none: a file
  bool reference_is_one_of_many = false;  ///< others did as much work, so it may be no better than they are
  std::vector<StudyFinding> runs;
  std::vector<ObservedOrder> orders;
  /// What the reference run itself misses by these orders, as a share like `error`, which it comes on top of.
  std::optional<double> error_of_reference;
  std::string part;  ///< where a reference file does not go on for as long as the runs: from when to when
};

/// What the errors are measured against, in words.
std::string words_of_reference(const StudyPlan& plan, const StudyFindings& findings);

/// Throws InputError where a reference, called so, has no such column.
void check_reference(const Series& reference, const std::string& column,
                     const char* called = "the reference");

/// Of `column`, from `reference` or else from the run that finished with the most work. Throws InputError
/// where the runs or the reference have no such column, or in no place more than `rounding` of it, or no run
/// finished.
StudyFindings find_out(const StudyPlan& plan, const std::vector<StudyRun>& runs, const std::string& column,
                       const std::optional<Series>& reference, double rounding = 0);

/// The cheapest run with at most this error, that of the reference included, if there is one; of those that
/// cost the same but for the noise of clocks the one with the least error, and the first of equals.
std::optional<std::size_t> cheapest_within(const StudyFindings& findings, const std::vector<StudyRun>& runs,
                                           double error);

}  // namespace talus
