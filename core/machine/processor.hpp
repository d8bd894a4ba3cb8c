#pragma once

#include <string>

namespace talus {

/// The processor this program runs on, as its maker calls it; "" where the system does not say.
std::string processor_name();

}  // namespace talus
