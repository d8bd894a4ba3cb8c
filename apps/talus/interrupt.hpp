#pragma once

#include <atomic>

namespace talus {

/// From now on Ctrl-C and SIGTERM raise the returned flag; a second one ends the program at once.
const std::atomic<bool>* watch_for_interrupts();

}  // namespace talus
