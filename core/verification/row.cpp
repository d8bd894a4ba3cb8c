#include "verification/row.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace talus::verification {
namespace {

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + ' ' + unit;
}

/// Seven digits of a figure, two of what is next to nothing: its others are rounding.
std::string figure(double value) {
  return std::abs(value) < 1e-8 && value != 0 ? fmt::format("{:.1e}", value) : fmt::format("{:.7g}", value);
}

std::string as_share(double share) {
  return share >= 1e-5 ? fmt::format("{:g} %", 100 * share) : fmt::format("{:g} of it", share);
}

}  // namespace

const char* in_words(Kind kind) {
  switch (kind) {
    case Kind::analytic:
      return "analytic";
    case Kind::exact:
      return "exact";
    case Kind::bound:
      return "bound";
    case Kind::published:
      return "published";
    case Kind::non_regression:
      return "non-regression";
    case Kind::shown:
      return "shown";
  }
  return "";
}

void Rows::add(Kind kind, const std::string& what, const std::string& reference, const std::string& tolerance,
               double measured, const std::string& unit, std::optional<bool> held) {
  rows.push_back({what, kind, reference, tolerance, with_unit(figure(measured), unit), measured, held});
}

void Rows::near(Kind kind, const std::string& what, double measured, double reference, double share,
                const std::string& unit) {
  add(kind, what, with_unit(figure(reference), unit), as_share(share), measured, unit,
      std::abs(measured - reference) <= share * std::abs(reference));
}

void Rows::about(Kind kind, const std::string& what, double measured, double reference, double off,
                 const std::string& unit) {
  add(kind, what, with_unit(figure(reference), unit), with_unit(fmt::format("{:g}", off), unit), measured,
      unit, std::abs(measured - reference) <= off);
}

void Rows::between(Kind kind, const std::string& what, double measured, double low, double high,
                   const std::string& unit) {
  add(kind, what, with_unit(fmt::format("{:g} to {:g}", low, high), unit), "", measured, unit,
      measured >= low && measured <= high);
}

void Rows::below(Kind kind, const std::string& what, double measured, double limit, const std::string& unit) {
  add(kind, what, with_unit(fmt::format("< {:.3g}", limit), unit), "", measured, unit, measured < limit);
}

void Rows::above(Kind kind, const std::string& what, double measured, double limit, const std::string& unit) {
  add(kind, what, with_unit(fmt::format("> {:.3g}", limit), unit), "", measured, unit, measured > limit);
}

void Rows::same(const std::string& what, const std::vector<std::string>& differing,
                const std::string& reference) {
  const bool all = differing.empty();
  rows.push_back({what, Kind::exact, "same " + reference, "",
                  all ? "same" : fmt::format("differs: {}", fmt::join(differing, "; ")), std::nullopt, all});
}

void Rows::same(const std::string& what, bool same, const std::string& reference) {
  this->same(what, same ? std::vector<std::string>{} : std::vector<std::string>{what}, reference);
}

void Rows::says(const std::string& what, const std::string& words, std::initializer_list<std::string> parts) {
  bool all = true;
  std::string wanted;
  for (const std::string& part : parts) {
    all = all && words.find(part) != std::string::npos;
    wanted += fmt::format("{}\"{}\"", wanted.empty() ? "" : ", ", part);
  }
  constexpr std::size_t room = 100;
  std::string printed = words.empty() ? "nothing" : words;
  if (printed.size() > room) {
    std::size_t end = room;
    while (end > 0 && (static_cast<unsigned char>(printed[end]) & 0xC0) == 0x80) --end;  // whole letters
    printed = printed.substr(0, end) + " …";
  }
  for (char& letter : printed) {
    if (letter == '\n' || letter == '|') letter = ' ';
  }
  rows.push_back({what, Kind::exact, "says " + wanted, "", printed, std::nullopt, all});
}

void Rows::shown(const std::string& what, double measured, const std::string& unit) {
  add(Kind::shown, what, "", "", measured, unit, std::nullopt);
}

}  // namespace talus::verification
