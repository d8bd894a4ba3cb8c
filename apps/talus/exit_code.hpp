#pragma once

namespace talus {

/// What the program tells its caller; stated in `talus --help`.
namespace exit_code {
inline constexpr int ok = 0;
inline constexpr int internal_error = 1;
inline constexpr int check_failed = 1;  ///< of check-plugin and verify
inline constexpr int bad_input = 2;
inline constexpr int plugin_refused = 3;
inline constexpr int numerical_trouble = 4;
inline constexpr int file_trouble = 5;
inline constexpr int tolerance_broken = 6;
inline constexpr int interrupted = 130;
}  // namespace exit_code

}  // namespace talus
