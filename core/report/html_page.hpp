#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// A page with each {{mark}} replaced by what goes there, in this order: what is put in last may hold what
/// looks like a mark. Throws std::logic_error where the page has no such mark.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string_view>>& marks);

/// A page in the look of the reports that holds all it shows and runs nothing. `main` is HTML.
std::string plain_page(const std::string& title, const std::string& sentence, const std::string& main);

/// A card of a page; `wide` takes its whole width. `content` is HTML.
std::string card(const std::string& heading, const std::string& note, const std::string& content, bool wide);

/// A figure at the top of a page.
std::string tile(const std::string& heading, const std::string& figure, const std::string& note);

/// An SVG of core/picture in the colours of the page, light or dark.
std::string drawing(const std::string& svg);

}  // namespace talus
