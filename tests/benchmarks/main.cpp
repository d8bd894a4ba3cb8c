// Time per block and step of whole runs, as users meet them. See README.md beside.

#include "interface.hpp"
#include "lattice.hpp"
#include "setup.hpp"
#include "step.hpp"
#include "whole_program.hpp"

#include <benchmark/benchmark.h>

#include <string>

int main(int argc, char** argv) {
  using namespace talus::benchmarks;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  register_steps();
  register_interface();
  register_lattices();
  register_setups();
  register_whole_programs();
  const std::string filter = benchmark::GetBenchmarkFilter();
  const bool asked = !filter.empty() && filter != ".";
  benchmark::RunSpecifiedBenchmarks(asked ? filter : std::string("-^") + large);
  benchmark::Shutdown();
  return 0;
}
