#include "progress.hpp"

#include "terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace talus {

namespace {

/// After `done` of the work, on which `elapsed` seconds went.
std::string left_text(double share, double done, double elapsed) {
  return done > 0 ? clock_text(elapsed * (1 - share) / done) : std::string("-:--");
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
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  share = std::clamp(share, 0.0, 1.0);
  if (style_ == Style::lines) print_line(share, words, elapsed);
  if (style_ != Style::bar || (drawn_ && now - last_drawn_ < std::chrono::milliseconds(200))) return;
  last_drawn_ = now;
  draw_bar(share, words, elapsed);
}

void Progress::clear() {
  if (!drawn_) return;
  tell("\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

void Progress::draw_bar(double share, const std::string& words, double elapsed) {
  constexpr int width = 30;
  const int filled = static_cast<int>(share * width);
  tell(fmt::format("\r[{:#<{}}{:.<{}}] {:3.0f} %  {}  {} left\033[K", "", filled, "", width - filled,
                   std::floor(100 * share), words, left_text(share, share - begin_, elapsed)));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::print_line(double share, const std::string& words, double elapsed) {
  const int tenths = static_cast<int>(std::floor(share * 10 + 1e-9));
  if (tenths <= tenths_) return;
  tenths_ = tenths;
  const std::string text = fmt::format("{} %  {}  {} passed, {} left", tenths * 10, words,
                                       clock_text(elapsed), left_text(share, share - begin_, elapsed));
  log_.info("progress", text, {{"share", share}, {"elapsed [s]", elapsed}});
}

std::string clock_text(double seconds) {
  const long whole = std::lround(std::min(seconds, 1e9));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace talus
