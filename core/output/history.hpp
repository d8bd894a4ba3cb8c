#pragma once

#include "files/hash.hpp"
#include "output/series.hpp"
#include "simulation/simulation.hpp"

#include <cstdint>
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

/// Columns of energy.csv, J/m since t = 0, and their values.
std::vector<std::string> energy_columns();
std::vector<double> energies(const EnergyLedger& ledger);

/// A file like history.csv: "t [s]" and the columns, numbers as short as they can be and still read back to
/// the same bits. Each row is with the operating system when add() returns.
class HistoryWriter {
 public:
  HistoryWriter(const std::filesystem::path& file, std::span<const std::string> columns);
  /// Goes on after the first `size` bytes of a file that a writer left, and cuts off what is behind.
  HistoryWriter(const std::filesystem::path& file, std::uint64_t size);

  /// Throw InputError unless a writer left the file with these columns, or beginning with `size` bytes of
  /// this hash.
  static void refuse_other(const std::filesystem::path& file, std::span<const std::string> columns);
  static void refuse_changed(const std::filesystem::path& file, std::uint64_t size, const std::string& hash);

  void add(double time, std::span<const double> values);

  std::uint64_t size() const { return size_; }       ///< bytes written
  std::string hash() const { return hash_.text(); }  ///< of these

 private:
  void write(const std::string& line);

  std::filesystem::path file_;
  std::ofstream stream_;
  std::uint64_t size_ = 0;
  RunningHash hash_;  ///< of what stands in the file, which may be too long to read for each checkpoint
};

}  // namespace talus
