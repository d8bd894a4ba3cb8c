#pragma once

#include "geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace talus {

/// A time and the half steps around it, s: what is read at that time acts over them.
struct StepSpan {
  double begin, time, end;
  double middle;  ///< of the span, and the very time where the steps beside it are alike

  StepSpan(double time_, double dt_behind, double dt_ahead)
      : begin(time_ - dt_behind / 2),
        time(time_),
        end(time_ + dt_ahead / 2),
        middle(time_ + (dt_ahead - dt_behind) / 4) {}
};

/// Piecewise linear between points, constant beyond the first and the last.
class Table {
 public:
  /// `at` rises strictly; as many values, at least one.
  Table(std::vector<double> at, std::vector<double> value);

  double operator()(double where) const;
  /// The mean over the span, so that nothing shorter than a step is lost. Where no point lies within it that
  /// is the value in its middle.
  double over(const StepSpan& span) const;
  /// ∫ from 0 to `where`, exact but for rounding.
  double integral(double where) const;
  /// The same up to there, and from there on what it is there.
  Table held_from(double where) const;
  /// From where on it is constant; −∞ where it is everywhere.
  double last_change() const;
  bool zero_within(double low, double high) const;
  const std::vector<double>& points() const { return at_; }
  bool operator==(const Table&) const = default;

 private:
  double antiderivative(double where) const;  ///< zero at the first point
  std::size_t piece(double where) const;      ///< number of its left end; `where` lies between the ends

  std::vector<double> at_, value_;
  std::vector<double> area_;  ///< ∫ from the first point to each
  double area_at_zero_;
};

/// scale · time(t) · x(X) · y(Y), without the factors that are left out.
struct Product {
  double scale = 0;
  std::optional<Table> time, x, y;

  bool operator==(const Product&) const = default;
};

/// A number that may depend on time and on the position at the start in the scene's coordinates: a sum of
/// products. Zero where empty.
struct Function {
  std::vector<Product> terms;

  double operator()(double time, Vec2 at) const;
  double over(const StepSpan& span, Vec2 at) const;  ///< see Table::over()
  /// ∫ over time from 0 to `time`, exact for the pieces of the tables.
  double integral(double time, Vec2 at) const;
  Function frozen(double time) const;              ///< what it is then, at any time
  Function integrated(double time) const;          ///< its integral from 0 to then, at any time
  Function held_from(double time) const;           ///< from then on what it is then
  bool zero_within(Vec2 low, Vec2 high) const;     ///< of a box of positions, at any time
  bool zero_during(double from, double to) const;  ///< anywhere, s
  double last_change() const;  ///< s, from when on it is constant; −∞ where it always is
  bool zero() const { return terms.empty(); }
  bool operator==(const Function&) const = default;
  bool varies_in_time() const {
    return std::any_of(terms.begin(), terms.end(), [](const Product& term) { return term.time.has_value(); });
  }
  /// Adds the shares of the way from one place to another at which a table over place has a point.
  void add_kinks(Vec2 from, Vec2 to, std::vector<double>& shares) const;
};

Function operator+(Function p, const Function& q);
Function operator*(double factor, Function function);

using VectorFunction = std::array<Function, 2>;

inline bool varies_in_time(const VectorFunction& functions) {
  return functions[0].varies_in_time() || functions[1].varies_in_time();
}

}  // namespace talus
