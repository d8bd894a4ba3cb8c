#include "conformance/apart.hpp"

#include "plugin/registry.hpp"
#include "text/thrown.hpp"

#include <fmt/format.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <system_error>
#include <thread>

namespace talus::conformance {
namespace {

using Clock = std::chrono::steady_clock;

/// Memory that parent and child see.
class SharedNotes {
 public:
  SharedNotes()
      : memory_(
            mmap(nullptr, sizeof(Trial::Notes), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "cannot share memory");
  }
  ~SharedNotes() { munmap(memory_, sizeof(Trial::Notes)); }
  SharedNotes(const SharedNotes&) = delete;
  SharedNotes& operator=(const SharedNotes&) = delete;

  Trial::Notes& operator*() const { return *static_cast<Trial::Notes*>(memory_); }
  Trial::Notes* operator->() const { return static_cast<Trial::Notes*>(memory_); }

 private:
  void* memory_;
};

/// Of a child, which does one check: what std::terminate() calls is given nothing.
Trial::Notes* notes_of_child = nullptr;

[[noreturn]] void end_with_what_was_thrown() {
  const std::string thrown = words_of_plugin(words_of_thrown());
  Trial(*notes_of_child).due(false, fmt::format("'{}' thrown where nothing may be", thrown), "an answer");
  notes_of_child->finished = true;
  _exit(1);
}

[[noreturn]] void work(Trial::Notes& notes, const std::function<void(Trial&)>& body) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  // What a library prints must not get into the report.
  dup2(STDERR_FILENO, STDOUT_FILENO);
  notes_of_child = &notes;
  std::set_terminate(end_with_what_was_thrown);
  Trial trial(notes);
  try {
    body(trial);
    notes.finished = true;
  } catch (const std::exception& problem) {
    trial.due(false, problem.what(), "an answer that the program can work with");
    notes.finished = true;
  }
  _exit(0);
}

/// s, what a process has taken of the processors; 0 when it is gone.
double processor_seconds(pid_t process) {
  clockid_t clock = 0;
  timespec taken{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &taken) != 0) return 0;
  return static_cast<double>(taken.tv_sec) + 1e-9 * static_cast<double>(taken.tv_nsec);
}

/// How the child ended. It is killed when it has worked for `seconds`, or has come to nothing for ten times
/// as long: how busy others keep the machine is no fault of a component.
std::string words_of_end(pid_t child, double seconds) {
  constexpr double patience = 10;
  const Clock::time_point start = Clock::now();
  auto pause = std::chrono::microseconds(50);
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "lost a process");
    const double passed = std::chrono::duration<double>(Clock::now() - start).count();
    if (passed > patience * seconds || (passed > seconds && processor_seconds(child) > seconds)) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return fmt::format("no answer after {:g} s", seconds);
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(5000));
  }
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return fmt::format("a crash: signal {} ({})", signal, strsignal(signal));
  }
  return fmt::format("the end of the process, exit code {}", WEXITSTATUS(status));
}

}  // namespace

Outcome run_apart(const std::string& check, double seconds, const std::function<void(Trial&)>& body) {
  const SharedNotes notes;
  std::fflush(nullptr);
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child < 0)
    throw std::system_error(errno, std::generic_category(), "cannot start a process for a check");
  if (child == 0) work(*notes, body);
  const std::string end = words_of_end(child, seconds);
  if (!notes->finished) Trial(*notes).due(false, end, "an answer");
  Outcome outcome{check, notes->verdict, notes->fed, notes->found, notes->due, notes->cases, 0};
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

}  // namespace talus::conformance
