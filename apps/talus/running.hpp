#pragma once

#include "arguments.hpp"
#include "log.hpp"
#include "output/recorded_run.hpp"

namespace talus {

/// What `run` and `resume` share: --checkpoint-every, --wall-time, --no-report, --profile, --quiet and those
/// of the log.
void add_running_options(Usage& usage);

/// Times at which `order.checkpoints->run` is written, from these options.
void read_running_options(const Usage& usage, const boost::program_options::variables_map& given,
                          RunOrder& order);

/// Runs to the end with progress, summary and warnings in the terminal. Returns the exit code.
int conduct(Simulation& simulation, RunOrder& order, const boost::program_options::variables_map& given,
            const Log& log);

}  // namespace talus
