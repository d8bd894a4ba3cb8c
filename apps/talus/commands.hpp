#pragma once

#include "arguments.hpp"

#include <span>
#include <string>
#include <vector>

namespace talus {

using Words = std::vector<std::string>;

struct Command {
  Usage (*usage)();
  const char* summary;
  int (*run)(const Words& words);  ///< takes the words after its name, returns the exit code
};

/// All commands, in the order of the help.
std::span<const Command> commands();

// Each command writes its results to stdout.
Usage usage_of_run();
int run_command(const Words& words);
Usage usage_of_resume();
int resume_command(const Words& words);
Usage usage_of_info();
int info_command(const Words& words);
Usage usage_of_compare();
int compare_command(const Words& words);
Usage usage_of_doctor();
int doctor_command(const Words& words);
Usage usage_of_report();
int report_command(const Words& words);
Usage usage_of_study();
int study_command(const Words& words);
Usage usage_of_advise();
int advise_command(const Words& words);
Usage usage_of_safety();
int safety_command(const Words& words);
Usage usage_of_verify();
int verify_command(const Words& words);
Usage usage_of_view();
int view_command(const Words& words);
Usage usage_of_validate();
int validate_command(const Words& words);
Usage usage_of_blocks();
int blocks_command(const Words& words);
Usage usage_of_plugins();
int plugins_command(const Words& words);
Usage usage_of_describe();
int describe_command(const Words& words);
Usage usage_of_check_plugin();
int check_plugin_command(const Words& words);
Usage usage_of_new_plugin();
int new_plugin_command(const Words& words);
Usage usage_of_schema();
int schema_command(const Words& words);
Usage usage_of_completion();
int completion_command(const Words& words);
Usage usage_of_help();
int help_command(const Words& words);

}  // namespace talus
