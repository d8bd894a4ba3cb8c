#pragma once

#include <string>

namespace talus {

/// A word of a command line, in quotes where a shell would take it for something else.
std::string shell_word(const std::string& word);

}  // namespace talus
