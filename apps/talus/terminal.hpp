#pragma once

#include <string_view>

namespace talus {

bool stderr_is_terminal();

/// To stderr. Where it cannot be written there is nobody to tell.
void tell(std::string_view text);

/// "error: ..." and "warning: ..." on stderr; coloured on a terminal unless NO_COLOR is set.
void print_error(std::string_view words);
void print_warning(std::string_view words);

}  // namespace talus
