#include "scene/mistakes.hpp"

#include "scene/positions.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace talus {
namespace {

std::string all_lines(const std::vector<Mistake>& mistakes) {
  std::string lines;
  for (const Mistake& mistake : mistakes) {
    if (!lines.empty()) lines += '\n';
    lines += mistake.text();
  }
  return lines;
}

/// The root for what is no pointer at all: an override may be anything.
std::string parent_of(const std::string& pointer) {
  const std::size_t slash = pointer.rfind('/');
  return slash == std::string::npos ? std::string() : pointer.substr(0, slash);
}

/// The place of a value, or that of the nearest one around it that the text holds.
Place nearest_place(const std::map<std::string, Places>& places, std::string pointer, bool at_key) {
  while (true) {
    if (const auto found = places.find(pointer); found != places.end()) {
      return at_key ? found->second.key : found->second.value;
    }
    if (pointer.empty()) return {1, 1};
    pointer = parent_of(pointer);
  }
}

}  // namespace

std::string Mistake::text() const {
  const std::string place = line == 0 ? file : fmt::format("{}:{}:{}", file, line, column);
  return pointer.empty() ? fmt::format("{}: {}", place, message)
                         : fmt::format("{}: {}: {}", place, pointer, message);
}

SceneError::SceneError(std::vector<Mistake> all, std::size_t unlisted)
    : std::runtime_error(all_lines(all)), mistakes(std::move(all)), more(unlisted) {}

std::string command_of(const Override& override_) {
  return fmt::format("--set {}={}", override_.pointer, override_.value);
}

void Mistakes::keep(Found found) {
  constexpr std::size_t most_kept = 100'000, longest_message = 4000;
  found.message = clipped(found.message, longest_message);
  if (found_.size() < most_kept) {
    found_.push_back(std::move(found));
  } else {
    ++untold_;
  }
}

void Mistakes::add(std::string pointer, std::string message) {
  keep({std::move(pointer), std::move(message), {}, false});
}

void Mistakes::add_at_key(std::string pointer, std::string message) {
  keep({std::move(pointer), std::move(message), {}, true});
}

void Mistakes::add_to_command(std::string command, std::string pointer, std::string message) {
  keep({std::move(pointer), std::move(message), std::move(command), false});
}

void Mistakes::move(const std::function<std::string(const std::string&)>& to) {
  std::set<std::pair<std::string, std::string>> told;
  std::vector<Found> all = std::move(found_);
  found_.clear();
  for (Found& found : all) {
    std::string pointer = to(found.pointer);
    const bool moved = pointer != found.pointer;
    found.pointer = std::move(pointer);
    if (!moved || told.emplace(found.pointer, found.message).second) found_.push_back(std::move(found));
  }
}

SceneError Mistakes::placed(const std::string& text, const std::string& file,
                            const std::vector<Override>& overrides, std::vector<Mistake> parsed) const {
  std::set<std::string> wanted;
  for (const Found& found : found_) {
    for (std::string pointer = found.pointer;; pointer = parent_of(pointer)) {
      wanted.insert(pointer);
      if (pointer.empty()) break;
    }
  }
  const std::map<std::string, Places> places = find_places(text, wanted);
  std::vector<Mistake> placed = std::move(parsed);
  for (const Found& found : found_) {
    std::string command;
    const bool in_text = found.pointer.empty() || places.contains(found.pointer);
    for (const Override& override_ : overrides) {  // the last one that wrote the value, or made its section
      const bool made = !in_text && is_within(override_.pointer, found.pointer);
      if (made || is_within(found.pointer, override_.pointer)) command = command_of(override_);
    }
    if (!found.command.empty()) command = found.command;
    if (!command.empty()) {
      placed.push_back({command, 0, 0, found.pointer, found.message});
      continue;
    }
    const Place place = nearest_place(places, found.pointer, found.at_key);
    placed.push_back({file, place.line, place.column, found.pointer, found.message});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Mistake& a, const Mistake& b) {
    return std::tuple(a.line == 0, a.line, a.column) < std::tuple(b.line == 0, b.line, b.column);
  });
  const std::size_t listed = std::min(placed.size(), many_), more = untold_ + placed.size() - listed;
  if (more > 0) {
    placed.resize(listed);
    placed.push_back({file, 0, 0, {}, fmt::format("and {} more mistakes", more)});
  }
  for (Mistake& mistake : placed) mistake.pointer = clipped(mistake.pointer, longest_pointer);
  return SceneError(std::move(placed), more);
}

}  // namespace talus
