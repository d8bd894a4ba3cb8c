#pragma once

#include <string>
#include <vector>

namespace talus {

/// The name that `word` was probably meant to be, or "" if none resembles it.
std::string nearest(const std::string& word, const std::vector<std::string>& names);

/// " did you mean "fix"?", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

/// The beginning of what a user wrote where it is too long to be shown.
std::string clipped(const std::string& text, std::size_t longest = 100);

/// "a, b, c", or "(none)"; of very many the first ones and how many more.
std::string listed(const std::vector<std::string>& names);

}  // namespace talus
