#pragma once

#include <boost/program_options.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus {

/// The command line is wrong: what, and what was probably meant.
class UsageError : public std::runtime_error {
 public:
  UsageError(std::string command_name, const std::string& words)
      : std::runtime_error(words), command(std::move(command_name)) {}
  std::string command;  ///< "" for the program itself
};

/// How a command is called, for parsing and for its help.
struct Usage {
  std::string command;   ///< "run"
  std::string synopsis;  ///< "SCENE [options]"
  std::string sentence;  ///< what it does
  std::string argument;  ///< names of what is given without an option, separated by spaces, "" if nothing; in
                         ///< [] if it need not be given; one that ends in ... takes all that follow
  std::string examples;
  boost::program_options::options_description options{"Options"};
};

/// Reads the words after a command. Nothing if --help was asked for and printed. Throws UsageError.
std::optional<boost::program_options::variables_map> read_arguments(const Usage& usage,
                                                                    const std::vector<std::string>& words);

/// ": did you mean 'run'?", or nothing if no name resembles the word.
std::string guess(const std::string& word, const std::vector<std::string>& names);

/// "" if the option was not given.
std::string text_option(const boost::program_options::variables_map& given, const std::string& name);

std::vector<std::string> list_option(const boost::program_options::variables_map& given,
                                     const std::string& name);

}  // namespace talus
