#include "text/nearest.hpp"

#include "text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace talus {
namespace {

/// What begins a word, and may be all that somebody cared to type.
constexpr std::size_t few_letters = 3;

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Insertions, deletions, replacements and swaps of neighbours that lead from a to b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& names) {
  if (word.size() > 200) return {};
  std::string best;
  std::size_t best_distance = 0;
  for (const std::string& name : names) {
    if (name.size() > 2 * word.size()) continue;  // more than half of its letters are missing
    const bool goes_on = word.size() >= few_letters && name.starts_with(word);
    const std::size_t distance = goes_on ? 1 : edit_distance(word, name);
    // More than half of the letters changed is another word.
    if (distance > std::max(word.size(), name.size()) / 2) continue;
    if (best.empty() || distance < best_distance) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string guess = nearest(word, names);
  return guess.empty() ? std::string() : fmt::format(" did you mean \"{}\"?", guess);
}

std::string clipped(const std::string& text, std::size_t longest) {
  return text.size() <= longest ? text : std::string(beginning_of(text, longest)) + "...";
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t readable = 60;
  if (names.empty()) return "(none)";
  std::string all;
  for (std::size_t i = 0; i < std::min(names.size(), readable); ++i) {
    if (i > 0) all += ", ";
    all += clipped(names[i]);
  }
  if (names.size() > readable) all += fmt::format(", and {} more", names.size() - readable);
  return all;
}

}  // namespace talus
