#include "arguments.hpp"

#include "text/nearest.hpp"

#include <fmt/format.h>
#include <boost/any.hpp>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace talus {

namespace po = boost::program_options;

namespace {

void print_help(const Usage& usage) {
  std::ostringstream options;
  options << usage.options;
  fmt::print("Usage: talus {} {}\n\n{}\n\n{}", usage.command, usage.synopsis, usage.sentence, options.str());
  if (!usage.examples.empty()) fmt::print("\nExamples:\n{}", usage.examples);
}

/// ": did you mean '--out'?", or nothing. The dashes, which all have, make no name alike.
std::string guess_option(const std::string& word, const po::options_description& options) {
  std::vector<std::string> names{"help"};
  for (const auto& option : options.options()) names.push_back(option->long_name());
  const std::string name = nearest(word.substr(std::min(word.find_first_not_of('-'), word.size())), names);
  return name.empty() ? "" : fmt::format(": did you mean '--{}'?", name);
}

}  // namespace

std::optional<po::variables_map> read_arguments(const Usage& usage, const std::vector<std::string>& words) {
  po::options_description all;
  all.add(usage.options);
  all.add_options()("help,h", "");
  po::positional_options_description positional;
  const bool optional = usage.argument.starts_with('[');
  std::istringstream arguments(optional ? usage.argument.substr(1, usage.argument.size() - 2)
                                        : usage.argument);
  const std::vector<std::string> wanted{std::istream_iterator<std::string>(arguments), {}};
  for (const std::string& argument : wanted) {
    if (argument.ends_with("...")) {
      const std::string name = argument.substr(0, argument.size() - 3);
      all.add_options()(name.c_str(), po::value<std::vector<std::string>>());
      positional.add(name.c_str(), -1);
    } else {
      all.add_options()(argument.c_str(), po::value<std::string>());
      positional.add(argument.c_str(), 1);
    }
  }
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  po::variables_map given;
  try {
    po::store(po::command_line_parser(words).options(all).positional(positional).style(style).run(), given);
    po::notify(given);
  } catch (const po::unknown_option& problem) {
    const std::string name = problem.get_option_name();
    throw UsageError(usage.command,
                     fmt::format("unknown option '{}'{}", name, guess_option(name, usage.options)));
  } catch (const po::too_many_positional_options_error&) {
    throw UsageError(usage.command, usage.argument.empty() ? std::string("it takes options only")
                                                           : fmt::format("it takes one {} only",
                                                                         fmt::join(wanted, " and one ")));
  } catch (const po::error& problem) {
    throw UsageError(usage.command, problem.what());
  }
  if (given.count("help") != 0) {
    print_help(usage);
    return std::nullopt;
  }
  for (const auto& [name, value] : given) {
    const po::option_description* const option = usage.options.find_nothrow(name, false);
    const auto* const text = boost::any_cast<std::string>(&value.value());
    if (option != nullptr && option->semantic()->min_tokens() > 0 && text != nullptr && text->empty())
      throw UsageError(usage.command, fmt::format("--{} is empty", name));
  }
  for (const std::string& argument : wanted) {
    if (!optional && given.count(argument) == 0)
      throw UsageError(usage.command, fmt::format("{} is missing", argument));
  }
  return given;
}

std::string guess(const std::string& word, const std::vector<std::string>& names) {
  const std::string name = nearest(word, names);
  return name.empty() ? "" : fmt::format(": did you mean '{}'?", name);
}

std::string text_option(const po::variables_map& given, const std::string& name) {
  return given.count(name) == 0 ? "" : given[name].as<std::string>();
}

std::vector<std::string> list_option(const po::variables_map& given, const std::string& name) {
  return given.count(name) == 0 ? std::vector<std::string>{} : given[name].as<std::vector<std::string>>();
}

}  // namespace talus
