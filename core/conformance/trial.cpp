#include "conformance/trial.hpp"

#include "text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace talus::conformance {
namespace {

template <std::size_t size>
void note(char (&to)[size], std::string_view words) {
  const std::string_view start = beginning_of(words, size - 1);
  std::memcpy(to, start.data(), start.size());
  to[start.size()] = '\0';
}

}  // namespace

void Trial::feed(std::string_view words) {
  if (!failed()) note(notes_->fed, words);
}

void Trial::at_most(double value, double bound, std::string_view what) {
  ++notes_->cases;
  if (value <= bound || failed()) return;
  const std::string found = fmt::format("{}: {:.9g}", what, value);
  if (std::isnan(bound)) {  // it was measured by what is no number
    due(false, found + ", against what is no number", "finite numbers");
    return;
  }
  due(false, found, fmt::format("at most {:.9g}", bound));
}

void Trial::due(bool holds, std::string_view found, std::string_view due) {
  ++notes_->cases;
  if (holds || failed()) return;
  note(notes_->found, found);
  note(notes_->due, due);
  notes_->verdict = Verdict::failed;
}

void Trial::not_claimed(std::string_view why) {
  note(notes_->found, why);
  notes_->verdict = Verdict::not_claimed;
}

void Trial::remark(std::string_view words) {
  if (!failed()) note(notes_->found, words);
}

void Trial::figure(std::string_view words) {
  note(notes_->found, words);
  notes_->verdict = Verdict::figure;
}

}  // namespace talus::conformance
