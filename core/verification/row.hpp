#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace talus::verification {

/// What a figure is held against.
enum class Kind {
  analytic,        ///< a formula
  exact,           ///< equality, to round-off or to the bit
  bound,           ///< an inequality that the method must keep
  published,       ///< what others published, to the digits that they gave
  non_regression,  ///< what the program gave before, so that a change is noticed
  shown,           ///< no right answer is known: reported as it is
};
const char* in_words(Kind kind);

/// One figure and what it is held against, as it is printed.
struct Row {
  std::string what;
  Kind kind;
  std::string reference, tolerance, measured;
  std::optional<double> value;  ///< the measured one, in the unit printed; none where it is words
  std::optional<bool> held;     ///< none where the figure is only shown
};

/// What a case measures, row by row. A value that is not a number holds nothing.
class Rows {
 public:
  /// |measured − reference| ≤ share · |reference|.
  void near(Kind kind, const std::string& what, double measured, double reference, double share,
            const std::string& unit);
  /// |measured − reference| ≤ off, in the same unit.
  void about(Kind kind, const std::string& what, double measured, double reference, double off,
             const std::string& unit);
  void between(Kind kind, const std::string& what, double measured, double low, double high,
               const std::string& unit);
  void below(Kind kind, const std::string& what, double measured, double limit, const std::string& unit);
  void above(Kind kind, const std::string& what, double measured, double limit, const std::string& unit);
  /// Equality to the bit with what `reference` names, of all but what is in `differing`.
  void same(const std::string& what, const std::vector<std::string>& differing, const std::string& reference);
  void same(const std::string& what, bool same, const std::string& reference);
  /// Words of a diagnosis, which must hold all of `parts`; only the first 100 letters are printed.
  void says(const std::string& what, const std::string& words, std::initializer_list<std::string> parts);
  void shown(const std::string& what, double measured, const std::string& unit);

  std::vector<Row> rows;

 private:
  void add(Kind kind, const std::string& what, const std::string& reference, const std::string& tolerance,
           double measured, const std::string& unit, std::optional<bool> held);
};

}  // namespace talus::verification
