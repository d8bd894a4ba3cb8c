#include "picture/legend.hpp"

#include "picture/palette.hpp"

#include <utility>

namespace talus {
namespace {

constexpr double sample = 22, gap = 6, letter_width = 7.2, apart = 12;

}  // namespace

Legend::Legend(std::vector<LegendEntry> entries, double begin, double end, double first_row)
    : entries_(std::move(entries)) {
  Spot at{begin, first_row};
  for (const LegendEntry& entry : entries_) {
    const double wide = sample + gap + letter_width * static_cast<double>(entry.label.size()) + apart;
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
    svg.text({at.x + sample + gap, at.y + 4}, entries_[i].label, Svg::Anchor::start);
  }
}

}  // namespace talus
