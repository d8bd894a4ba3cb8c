#include "commands.hpp"

namespace talus {

namespace {

constexpr Command known_commands[] = {
    {usage_of_run, "run a scene, write history, frames and a record of the run", run_command},
    {usage_of_compare, "run a scene once per value, side by side, and measure how the results part",
     compare_command},
    {usage_of_resume, "go on with a run that was broken off, to the same bits", resume_command},
    {usage_of_info, "say what a checkpoint holds", info_command},
    {usage_of_doctor, "explain a run that was stopped or gained energy", doctor_command},
    {usage_of_report, "write the page of a run or a comparison anew", report_command},
    {usage_of_study, "run a scene with every combination of values, measure error against cost",
     study_command},
    {usage_of_advise, "propose the cheapest settings that keep an error", advise_command},
    {usage_of_safety, "factor of safety by strength reduction", safety_command},
    {usage_of_validate, "say all mistakes of a scene, or what a run of it would be", validate_command},
    {usage_of_blocks, "write a scene with its generated blocks as plain bodies", blocks_command},
    {usage_of_verify, "hold what the program gives against answers known beforehand", verify_command},
    {usage_of_view, "draw a scene, or figures of results, as SVG", view_command},
    {usage_of_plugins, "list the libraries found, what they bring, and which were refused and why",
     plugins_command},
    {usage_of_describe, "explain a component or a section of a scene with all its parameters",
     describe_command},
    {usage_of_check_plugin, "hold the components of a library to what is due of them", check_plugin_command},
    {usage_of_new_plugin, "write a plugin of your own that builds and passes its tests", new_plugin_command},
    {usage_of_schema, "write a JSON Schema of scenes, for editors", schema_command},
    {usage_of_completion, "write what completes commands and options in a shell", completion_command},
    {usage_of_help, "explain a command, or write the manual page", help_command},
};

}  // namespace

std::span<const Command> commands() {
  return known_commands;
}

}  // namespace talus
