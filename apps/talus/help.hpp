#pragma once

#include <span>
#include <string>

namespace talus {

/// What `talus --help` prints.
std::string help_text();

/// An exit code and what it means, or an environment variable and what it does.
struct Explained {
  const char *name, *meaning;
};
std::span<const Explained> exit_codes();
std::span<const Explained> environment();

/// The examples of `talus --help`, a line each.
std::span<const char* const> examples();

/// The manual page as roff.
std::string manual_page();

}  // namespace talus
