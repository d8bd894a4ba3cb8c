#pragma once

#include <string>

namespace talus {

/// A word of a command line, in quotes where a shell would take it for something else.
std::string shell_word(const std::string& word);

/// The same of a file or folder: one that begins with a dash is no option.
std::string shell_file(const std::string& file);

}  // namespace talus
