#pragma once

namespace talus {

/// Whose processor time a stopwatch counts: the whole program's or only the calling thread's, for runs that
/// share the program with others and stay on one thread.
enum class CpuClock { process, thread };

/// Wall and processor seconds.
struct Elapsed {
  double wall = 0, cpu = 0;

  Elapsed& operator+=(Elapsed other) {
    wall += other.wall;
    cpu += other.cpu;
    return *this;
  }
};

class Stopwatch {
 public:
  explicit Stopwatch(CpuClock clock);

  Elapsed elapsed() const;  ///< since it was made

 private:
  CpuClock clock_;
  Elapsed start_;
};

/// Adds what passed while it lived to `sum`, also where that was cut short.
class Timed {
 public:
  Timed(CpuClock clock, Elapsed& sum) : watch_(clock), sum_(sum) {}
  ~Timed() { sum_ += watch_.elapsed(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  Stopwatch watch_;
  Elapsed& sum_;
};

}  // namespace talus
