#pragma once

#include "output/series.hpp"
#include "simulation/simulation.hpp"

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// "<monitor>.<quantity> [unit]" of every monitor of a scene, in order.
std::vector<std::string> monitor_columns(const Scene& scene);

/// Present values of these columns; positions with the scene's origin.
std::vector<double> sample_monitors(const Simulation& simulation);

/// history.csv: "t [s]" and the columns, numbers as short as they can be and still read back to the same
/// bits. Each row is with the operating system when add() returns.
class HistoryWriter {
 public:
  HistoryWriter(const std::filesystem::path& file, std::span<const std::string> columns);

  void add(double time, std::span<const double> values);

 private:
  void write(const std::string& line);

  std::filesystem::path file_;
  std::ofstream stream_;
};

}  // namespace talus
