#include "study/plan.hpp"

#include "files/input_error.hpp"
#include "random/random.hpp"
#include "text/plain_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

namespace talus {
namespace {

constexpr std::size_t most_points_of_study = 10000;
constexpr double by_ratio = 10;  ///< of the ends of a range, from which on it is divided by ratios

struct Span {
  double low, high;

  double at(double share) const {
    if (low > 0 && high / low >= by_ratio) return low * std::pow(high / low, share);
    return low + share * (high - low);
  }

  /// With six digits, and as many more as a narrow range takes; all where rounding would leave the range.
  std::string text(double share) const {
    const double value = at(share), narrow = std::max(std::abs(low), std::abs(high)) / (high - low);
    const int digits = 6 + static_cast<int>(std::clamp(std::floor(std::log10(narrow)), 0.0, 11.0));
    const std::string rounded = fmt::format("{:.{}g}", value, digits);
    const double taken = plain_number(rounded).value_or(value);
    return low <= taken && taken <= high ? rounded : fmt::format("{}", value);
  }
};

std::optional<Span> span_of(const Variation& variation) {
  const std::size_t colon = variation.values[0].find(':');
  if (variation.values.size() != 1 || colon == std::string::npos) return std::nullopt;
  const std::string low = variation.values[0].substr(0, colon), high = variation.values[0].substr(colon + 1);
  const std::optional<double> from = plain_number(low), to = plain_number(high);
  const auto endless = [](const std::string& end) { return end == "inf" || end == "nan"; };
  if (!(from || endless(low)) || !(to || endless(high))) return std::nullopt;
  if (!from || !to || !(*from < *to))
    throw InputError(fmt::format("--vary {}={}: a range is low:high, two numbers", variation.pointer,
                                 variation.values[0]));
  if (!std::isfinite(*to - *from) || (*from > 0 && !std::isfinite(*to / *from)))
    throw InputError(fmt::format("--vary {}={}: the range is too wide to be divided", variation.pointer,
                                 variation.values[0]));
  return Span{*from, *to};
}

std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

StudyPlan empty_plan(const std::vector<Variation>& variations) {
  StudyPlan plan;
  for (const Variation& variation : variations) plan.pointers.push_back(variation.pointer);
  return plan;
}

}  // namespace

std::vector<Override> StudyPlan::overrides(const StudyPoint& point) const {
  std::vector<Override> all;
  for (std::size_t i = 0; i < pointers.size(); ++i) all.push_back({pointers[i], point.values[i]});
  return all;
}

std::string StudyPlan::words(const StudyPoint& point) const {
  std::string words;
  for (std::size_t i = 0; i < pointers.size(); ++i) {
    if (i > 0) words += ' ';
    words += pointers[i].substr(pointers[i].rfind('/') + 1) + "=" + point.values[i];
  }
  return words;
}

StudyPlan grid(const std::vector<Variation>& variations) {
  StudyPlan plan = empty_plan(variations);
  std::size_t count = 1;
  for (const Variation& variation : variations) {
    if (span_of(variation))
      throw InputError(
          fmt::format("--vary {}={}: a range needs --sample N", variation.pointer, variation.values[0]));
    count *= variation.values.size();
    if (count > most_points_of_study)
      throw InputError(fmt::format("the study would make more than {} runs: give fewer values, or --sample N",
                                   most_points_of_study));
  }
  for (std::size_t i = 0; i < count; ++i) {
    StudyPoint& point = plan.points.emplace_back();
    std::size_t rest = i, left = count;
    for (const Variation& variation : variations) {
      left /= variation.values.size();
      point.values.push_back(variation.values[rest / left]);
      rest %= left;
    }
  }
  return plan;
}

StudyPlan latin_hypercube(const std::vector<Variation>& variations, std::size_t count, std::uint64_t seed) {
  if (count < 1 || count > most_points_of_study)
    throw InputError(fmt::format("--sample {}: allowed are 1 to {}", count, most_points_of_study));
  StudyPlan plan = empty_plan(variations);
  plan.points.resize(count);
  Random random(seed);
  for (const Variation& variation : variations) {
    const std::optional<Span> span = span_of(variation);
    const std::vector<std::size_t> strata = shuffled(count, random);
    for (std::size_t i = 0; i < count; ++i) {
      if (span) {
        const double share = (static_cast<double>(strata[i]) + random.share()) / static_cast<double>(count);
        plan.points[i].values.push_back(span->text(share));
      } else {
        plan.points[i].values.push_back(variation.values[strata[i] * variation.values.size() / count]);
      }
    }
  }
  // Of listed values alone a point may come more than once.
  std::set<std::vector<std::string>> made;
  std::erase_if(plan.points, [&](const StudyPoint& point) { return !made.insert(point.values).second; });
  return plan;
}

}  // namespace talus
