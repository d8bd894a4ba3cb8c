#include "output/history.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/sampled.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

namespace talus {
namespace {

std::string head_of(std::span<const std::string> columns) {
  std::vector<std::string> fields{"t [s]"};
  fields.insert(fields.end(), columns.begin(), columns.end());
  return csv_line(fields);
}

}  // namespace

std::vector<std::string> monitor_columns(const Scene& scene) {
  std::vector<std::string> columns;
  for (const Monitor& monitor : scene.monitors) {
    for (const std::string& name : monitor.quantities) {
      columns.push_back(fmt::format("{}.{} [{}]", monitor.name, name, find_quantity(name)->unit));
    }
  }
  return columns;
}

std::vector<double> sample_monitors(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const bool touched = std::any_of(scene.monitors.begin(), scene.monitors.end(), sees_contacts);
  const std::vector<Contact> contacts = touched ? simulation.contacts() : std::vector<Contact>{};
  std::vector<double> values;
  for (std::size_t number = 0; number < scene.monitors.size(); ++number) {
    const Monitor& monitor = scene.monitors[number];
    Sampled sampled{simulation.monitor_motion(number), scene.origin};
    if (sees_contacts(monitor))
      sampled.contact = contact_sum(contacts, monitor.body, sampled.motion.position);
    for (const std::string& name : monitor.quantities)
      values.push_back(value_of(find_quantity(name)->what, sampled));
  }
  return values;
}

std::vector<std::string> energy_columns() {
  std::vector<std::string> columns;
  for (const LedgerEntry& entry : ledger_entries) columns.push_back(fmt::format("{} [J/m]", entry.name));
  return columns;
}

std::vector<double> energies(const EnergyLedger& ledger) {
  std::vector<double> values;
  for (const LedgerEntry& entry : ledger_entries) values.push_back(ledger.*entry.value);
  return values;
}

HistoryWriter::HistoryWriter(const std::filesystem::path& file, std::span<const std::string> columns)
    : file_(file) {
  errno = 0;
  stream_.open(file, std::ios::binary | std::ios::trunc);
  write(head_of(columns));
}

HistoryWriter::HistoryWriter(const std::filesystem::path& file, std::uint64_t size)
    : file_(file), size_(size) {
  std::filesystem::resize_file(file, size);
  hash_.add(read_whole_file(file));
  errno = 0;
  stream_.open(file, std::ios::binary | std::ios::app);
}

void HistoryWriter::refuse_other(const std::filesystem::path& file, std::span<const std::string> columns) {
  if (!std::filesystem::exists(file))
    throw InputError(fmt::format("'{}', which the run left, is gone; nothing was written", file.string()));
  std::ifstream stream(file, std::ios::binary);
  std::string head;
  std::getline(stream, head);
  if (stream && head == head_of(columns)) return;
  throw InputError(
      fmt::format("'{}' is not what the run left: it should begin with the line '{}'; nothing was written",
                  file.string(), clipped(head_of(columns))));
}

void HistoryWriter::refuse_changed(const std::filesystem::path& file, std::uint64_t size,
                                   const std::string& hash) {
  std::error_code none;
  const std::uintmax_t found = std::filesystem::file_size(file, none);
  if (none || found < size) {
    throw InputError(
        fmt::format("'{}' is not what the run left: it should have {} bytes at least; nothing was written",
                    file.string(), size));
  }
  if (hash_of_bytes(std::string_view(read_whole_file(file)).substr(0, size)) != hash) {
    throw InputError(
        fmt::format("'{}' is not what the run left: its first {} bytes are others, as after another program "
                    "saved it; restore it, or run the scene anew; nothing was written",
                    file.string(), size));
  }
}

void HistoryWriter::add(double time, std::span<const double> values) {
  std::string line = fmt::format("{}", time);
  for (const double value : values) fmt::format_to(std::back_inserter(line), ",{}", value);
  write(line);
}

void HistoryWriter::write(const std::string& line) {
  stream_ << line << '\n' << std::flush;
  size_ += line.size() + 1;
  hash_.add(line);
  hash_.add("\n");
  if (!stream_) {
    const int reason = errno != 0 ? errno : EIO;
    throw std::system_error(reason, std::generic_category(),
                            fmt::format("cannot write '{}'", file_.string()));
  }
}

}  // namespace talus
