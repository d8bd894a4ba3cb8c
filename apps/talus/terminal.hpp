#pragma once

#include <string_view>

namespace talus {

bool stderr_is_terminal();

/// "error: ..." and "warning: ..." on stderr; coloured on a terminal unless NO_COLOR is set.
void print_error(std::string_view words);
void print_warning(std::string_view words);

}  // namespace talus
