#pragma once

#include "output/series.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace talus {

/// How one curve parts from another. Signed: this minus the other.
struct Deviation {
  double largest = 0;         ///< the one of largest magnitude
  double largest_time = 0;    ///< s
  double rms = 0;             ///< over the compared times
  double final = 0;           ///< at the last compared time
  double final_time = 0;      ///< s
  std::size_t times = 0;      ///< how many were compared
  bool between_rows = false;  ///< as Difference
};

/// What `other` is between its rows: a line, as a reference file is by definition; or another run, of which
/// nothing is known there.
enum class Between { line, unknown };

/// `column` of `series` less `other_column` of `other`, as far as both reach. From a line: at the times of
/// `series`. From another run: at the times of which both have a row; where they share no more than one, at
/// the times of the one with fewer rows, the other interpolated linearly.
struct Difference {
  std::vector<double> time, value;
  bool between_rows = false;  ///< whether a run was interpolated
};
Difference difference(const Series& series, std::size_t column, const Series& other, std::size_t other_column,
                      Between between);

/// How far two curves part at the times at which their difference is known. Nothing if there are none.
std::optional<Deviation> deviation(const Series& series, std::size_t column, const Series& other,
                                   std::size_t other_column, Between between);

/// At one time: on the line between the differences beside it.
std::optional<double> deviation_at(const Series& series, std::size_t column, const Series& other,
                                   std::size_t other_column, Between between, double time);

/// Of a run that was cut short, or has a baseline that was, no limit is known to be held.
/// `unchecked`: there was nothing to compare with.
enum class ToleranceVerdict { held, broken, cut_short, unchecked };

const char* name_of(ToleranceVerdict verdict);  ///< in words

/// One limit of a tolerance.
struct ToleranceCheck {
  std::string measure;  ///< "largest", "rms" or "final"
  double allowed, found;
  ToleranceVerdict verdict;
};

/// One check for each limit that the tolerance states, whether there is a deviation or not. A deviation that
/// is no number breaks it; one of runs that were cut short can only be too large already.
std::vector<ToleranceCheck> check(const Tolerance& tolerance, const std::optional<Deviation>& deviation,
                                  bool cut_short = false);

}  // namespace talus
