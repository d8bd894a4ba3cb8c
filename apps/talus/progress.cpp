#include "progress.hpp"

#include "terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace talus {

namespace {

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

}  // namespace

Progress::Progress(const Log& log, bool quiet)
    : log_(log),
      style_(quiet || !log.shows(LogLevel::info)      ? Style::none
             : !log.in_json() && stderr_is_terminal() ? Style::bar
                                                      : Style::lines) {}

Progress::~Progress() {
  clear();
}

void Progress::show(double share, const std::string& words) {
  const Clock::time_point now = Clock::now();
  share = std::clamp(share, 0.0, 1.0);
  if (style_ == Style::lines) print_line(share, words);
  if (style_ != Style::bar || (drawn_ && now - last_drawn_ < std::chrono::milliseconds(200))) return;
  last_drawn_ = now;
  draw_bar(share, words);
}

std::string Progress::left_text(double share) const {
  const double done = share - begin_;
  return done > 0 ? clock_text(seconds_since(begun_) * (1 - share) / done) : std::string("-:--");
}

void Progress::clear() {
  if (!drawn_) return;
  tell("\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

void Progress::draw_bar(double share, const std::string& words) {
  constexpr int width = 30;
  const int filled = static_cast<int>(share * width);
  tell(fmt::format("\r[{:#<{}}{:.<{}}] {:3.0f} %  {}  {} left\033[K", "", filled, "", width - filled,
                   std::floor(100 * share), words, left_text(share)));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::print_line(double share, const std::string& words) {
  const int tenths = static_cast<int>(std::floor(share * 10 + 1e-9));
  if (tenths <= tenths_) return;
  tenths_ = tenths;
  const double elapsed = seconds_since(start_);
  const std::string text =
      fmt::format("{} %  {}  {} passed, {} left", tenths * 10, words, clock_text(elapsed), left_text(share));
  log_.info("progress", text, {{"share", share}, {"elapsed [s]", elapsed}});
}

std::string clock_text(double seconds) {
  const long whole = std::lround(std::min(seconds, 1e9));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace talus
