#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace talus::conformance {

enum class Verdict : unsigned {
  passed,
  failed,
  not_claimed,  ///< the component does not claim what would be checked, or has no parameter for it
  not_run,      ///< it cannot be asked: what comes before failed
  figure,       ///< information, neither right nor wrong
};

/// What became of a check. Of a failed one: what was fed, what came out, what was due.
struct Outcome {
  std::string check;
  Verdict verdict = Verdict::passed;
  std::string fed, found, due;  ///< found: also why nothing is claimed, a figure, a remark
  std::size_t cases = 0;        ///< how much was compared
  double seconds = 0;
};

/// Takes notes in memory that outlives the process which writes them: a check may die half-way.
class Trial {
 public:
  struct Notes {
    Verdict verdict;
    std::size_t cases;
    bool finished;
    char fed[1024], found[2048], due[1024];
  };
  explicit Trial(Notes& notes) : notes_(&notes) {}

  /// What is fed from here on.
  void feed(std::string_view words);
  /// The first that does not hold is kept; nan never holds.
  void at_most(double value, double bound, std::string_view what);
  void due(bool holds, std::string_view found, std::string_view due);
  bool failed() const { return notes_->verdict == Verdict::failed; }

  bool compared() const { return notes_->cases > 0; }

  void not_claimed(std::string_view why);
  void remark(std::string_view words);  ///< beside a check that passes
  void figure(std::string_view words);

 private:
  Notes* notes_;
};

}  // namespace talus::conformance
