#pragma once

#include "log.hpp"

#include <chrono>
#include <string>

namespace talus {

/// How far a run is, on stderr: one line with a bar and the time left on a terminal, redrawn at most five
/// times per second; elsewhere a line of the log at every 10 %.
class Progress {
 public:
  /// Says nothing where it is quiet or the log does not show it.
  Progress(const Log& log, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` of the work is done; `words` say where it is.
  void show(double share, const std::string& words);

  /// What comes goes on from there: of the time left only the rest tells, and what is shown from now on.
  void begin_at(double share) {
    begin_ = share;
    begun_ = Clock::now();
  }

  /// Removes the bar, so that other lines can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void draw_bar(double share, const std::string& words);
  void print_line(double share, const std::string& words);
  std::string left_text(double share) const;

  Log log_;
  enum class Style { none, bar, lines } style_;
  Clock::time_point start_ = Clock::now(), begun_ = start_;
  Clock::time_point last_drawn_{};
  double begin_ = 0;  ///< share of the work that was done before
  bool drawn_ = false;
  int tenths_ = 0;  ///< last tenth that was printed
};

/// "0:07", "1:02:03".
std::string clock_text(double seconds);

}  // namespace talus
