#pragma once

#include <optional>
#include <vector>

namespace talus {

/// Errors over sizes h of steps, elements, springs. Against an exact answer e = C h^p. Against a run of the
/// family itself, of size r, e = C |h^p − r^p|: with r half of the smallest h a plain slope says 2.32 for 2.
class Convergence {
 public:
  /// `size` and `error` above 0, one each for every run; `reference` is the size of the run that errors are
  /// measured against, where that is of the family and at one end of it.
  Convergence(std::vector<double> size, std::vector<double> error, std::optional<double> reference);

  /// Between neighbours; of two of one size nothing.
  std::vector<double> between_neighbours() const;
  /// That which fits all best, by least squares of the logarithms. Nothing where all are of one size.
  std::optional<double> fit() const;
  /// What the reference itself misses, by the run that is next to it in size and the order that fits, that of
  /// the last two or 2, whichever is lowest; nothing where there is no such run or errors do not fall towards
  /// it.
  std::optional<double> error_of_reference() const;

 private:
  double scaled(std::size_t run, double order) const;
  double order_between(std::size_t p, std::size_t q) const;
  double misfit(double order) const;

  std::vector<double> size_, error_;  ///< logarithms
  std::optional<double> reference_;
};

}  // namespace talus
