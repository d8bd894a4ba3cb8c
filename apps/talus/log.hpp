#pragma once

#include "arguments.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace talus {

enum class LogLevel { error, warning, info };
enum class LogFormat { text, json };

/// What a command says on stderr beside its results: lines for people, or for programs a JSON object on each
/// line with time (UTC), level, event, message and further fields.
class Log {
 public:
  using Fields = nlohmann::ordered_json;

  Log() = default;
  Log(LogLevel level, LogFormat format) : level_(level), format_(format) {}

  bool shows(LogLevel level) const { return level <= level_; }
  bool in_json() const { return format_ == LogFormat::json; }

  void error(const std::string& words, const Fields& fields = Fields::object()) const;
  void warning(const std::string& words) const;
  /// What is no trouble. Events without words are for programs alone.
  void info(const std::string& event, const std::string& words,
            const Fields& fields = Fields::object()) const;

 private:
  void write(const char* level, const std::string& event, const std::string& words,
             const Fields& fields) const;

  LogLevel level_ = LogLevel::info;
  LogFormat format_ = LogFormat::text;
};

/// --log-level and --log-format.
void add_log_options(Usage& usage);
Log log_of(const Usage& usage, const boost::program_options::variables_map& given);

/// The log that the words of a command ask for, whether or not they can be understood otherwise.
Log log_of_words(const std::vector<std::string>& words);

}  // namespace talus
