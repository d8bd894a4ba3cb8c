#pragma once

#include "plugin/registry.hpp"

#include <cstdint>

namespace talus::tally {

/// How many contacts the law "tally" sees in every candidate pair, whatever the geometry.
extern std::uint32_t contacts;

/// The shipped components and "tally": a law without forces that keeps one double for each contact, its age
/// in steps.
Registry& registry();

}  // namespace talus::tally
