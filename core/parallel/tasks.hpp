#pragma once

#include <cstddef>
#include <functional>

namespace talus {

/// Calls task(i) for all i below `count`, on up to `threads` threads, each of which takes the next one when
/// it has done one. What a task throws keeps no other from being done; of several the one of the lowest i is
/// thrown in the end.
void do_tasks(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

}  // namespace talus
