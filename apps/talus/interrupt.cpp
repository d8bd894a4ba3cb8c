#include "interrupt.hpp"

#include <atomic>
#include <csignal>

namespace talus {

namespace {

bool interrupted = false;

extern "C" void raise_flag(int) {
  std::atomic_ref<bool>(interrupted).store(true, std::memory_order_relaxed);
}

}  // namespace

const bool* watch_for_interrupts() {
  struct sigaction action {};
  action.sa_handler = raise_flag;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return &interrupted;
}

}  // namespace talus
