#include "log.hpp"

#include "terminal.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>

namespace talus {

namespace {

namespace po = boost::program_options;

std::string present_time() {
  const auto now = std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now());
  const auto second = std::chrono::floor<std::chrono::seconds>(now);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(second)),
                     (now - second).count());
}

}  // namespace

void Log::error(const std::string& words, const Fields& fields) const {
  if (in_json()) return write("error", "error", words, fields);
  print_error(words);
}

void Log::warning(const std::string& words) const {
  if (!shows(LogLevel::warning)) return;
  if (in_json()) return write("warning", "warning", words, {});
  print_warning(words);
}

void Log::info(const std::string& event, const std::string& words, const Fields& fields) const {
  if (!shows(LogLevel::info)) return;
  if (in_json()) return write("info", event, words, fields);
  if (!words.empty()) tell(fmt::format("{}\n", words));
}

void Log::write(const char* level, const std::string& event, const std::string& words,
                const Fields& fields) const {
  Fields line{{"time", present_time()}, {"level", level}, {"event", event}};
  if (!words.empty()) line["message"] = words;
  if (fields.is_object()) line.update(fields);
  tell(fmt::format("{}\n", line.dump(-1, ' ', false, Fields::error_handler_t::replace)));
  std::fflush(stderr);
}

void add_log_options(Usage& usage) {
  usage.options.add_options()("log-level", po::value<std::string>()->value_name("error|warning|info"),
                              "what to tell on stderr (default: info, all)")(
      "log-format", po::value<std::string>()->value_name("text|json"),
      "how: as text (default), or as a JSON object on each line, for programs");
}

Log log_of(const Usage& usage, const po::variables_map& given) {
  const std::string level = text_option(given, "log-level"), format = text_option(given, "log-format");
  if (!level.empty() && level != "error" && level != "warning" && level != "info")
    throw UsageError(usage.command, fmt::format("--log-level {}: allowed are error, warning, info", level));
  if (!format.empty() && format != "text" && format != "json")
    throw UsageError(usage.command, fmt::format("--log-format {}: allowed are text, json", format));
  return {level == "error"     ? LogLevel::error
          : level == "warning" ? LogLevel::warning
                               : LogLevel::info,
          format == "json" ? LogFormat::json : LogFormat::text};
}

Log log_of_words(const std::vector<std::string>& words) {
  bool json = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--log-format=json") json = true;
    if (words[i] == "--log-format" && i + 1 < words.size() && words[i + 1] == "json") json = true;
  }
  return {LogLevel::info, json ? LogFormat::json : LogFormat::text};
}

}  // namespace talus
