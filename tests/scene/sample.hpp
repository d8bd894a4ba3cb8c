#pragma once

#include "scene/read.hpp"

#include <string>

namespace talus::sample {

/// Descriptors of two laws, a material and two covers, as libraries would bring them. Their
/// constructors refuse some values, and what they make is only good to be dropped.
Registry registry();

/// A scene that passes: a block on a fixed ramp.
extern const char* const good;

/// `good` with the only occurrence of `old_text` replaced.
std::string good_but(const std::string& old_text, const std::string& new_text);

/// `good` with surfaces "base" (edge 0) and "side" (edges 1 and 3) of the block, and with `part` before
/// "time".
std::string good_with(const std::string& part);

/// A row of "interfaces" for the law of shear; the angle is in degrees.
std::string interface_row(const std::string& first, const std::string& second, int friction_angle);

Scene read(const std::string& text, const ReadOptions& options = {});

/// The mistakes of a scene; empty if it passes.
std::vector<Mistake> mistakes(const std::string& text, const ReadOptions& options = {});

}  // namespace talus::sample
