#pragma once

#include "compare/variation.hpp"
#include "scene/read.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace talus {

/// One run of a study: what it sets, in the order of the variations.
struct StudyPoint {
  std::vector<std::string> values;  ///< [variation]
};

/// Every run that a study makes.
struct StudyPlan {
  std::vector<std::string> pointers;  ///< [variation]
  std::vector<StudyPoint> points;

  std::vector<Override> overrides(const StudyPoint& point) const;
  /// "dt=1e-5 model=overlap_area": the last part of each pointer says enough.
  std::string words(const StudyPoint& point) const;
};

/// All combinations of the values; the last variation changes fastest. Throws InputError where there are more
/// than 10,000.
StudyPlan grid(const std::vector<Variation>& variations);

/// `count` combinations by Latin hypercube sampling: each variation is divided into `count` strata and each
/// of them is met once. A variation "low:high" is a range of numbers, divided evenly, or by ratios if both
/// ends are positive and a factor of ten or more apart; of others the values take turns. Throws InputError.
StudyPlan latin_hypercube(const std::vector<Variation>& variations, std::size_t count, std::uint64_t seed);

}  // namespace talus
