#pragma once

#include <string>
#include <vector>

namespace talus {

using Words = std::vector<std::string>;

// Each command takes the words after its name, writes results to stdout, and returns the exit code.
int run_command(const Words& words);
int compare_command(const Words& words);
int validate_command(const Words& words);
int blocks_command(const Words& words);
int plugins_command(const Words& words);
int describe_command(const Words& words);

}  // namespace talus
