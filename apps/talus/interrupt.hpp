#pragma once

#include <atomic>

namespace talus {

/// From now on Ctrl-C, SIGTERM and, where it is not ignored, a closed terminal raise the returned flag; a
/// second one ends the program at once. What is printed to a pipe that nobody reads is lost, no more.
const std::atomic<bool>* watch_for_interrupts();

}  // namespace talus
