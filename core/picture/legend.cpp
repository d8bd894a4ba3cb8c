#include "picture/legend.hpp"

#include "picture/palette.hpp"

#include <utility>

namespace talus {
namespace {

constexpr double sample = 22, before_label = 6, letter_width = 7.2, after_label = 12;

}  // namespace

Legend::Legend(std::vector<LegendEntry> entries, double begin, double end, double first_row)
    : entries_(std::move(entries)) {
  Spot at{begin, first_row};
  for (const LegendEntry& entry : entries_) {
    const double wide =
        sample + before_label + letter_width * static_cast<double>(entry.label.size()) + after_label;
    if (at.x > begin && at.x + wide > end) at = {begin, at.y + row};
    places_.push_back(at);
    at.x += wide;
  }
  height_ = at.y + below;
}

void Legend::draw(Svg& svg) const {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Spot at = places_[i];
    svg.line({at, {at.x + sample, at.y}}, {entries_[i].colour, 2, entries_[i].dashes});
    svg.text({at.x + sample + before_label, at.y + 4}, entries_[i].label, Svg::Anchor::start);
  }
}

}  // namespace talus
