#pragma once

#include "preview/preview.hpp"

#include <string>

namespace talus {

/// "  label      words"
void print_row(const std::string& label, const std::string& words);

/// What a damping_time would still, and which one; "" where nothing of it is foreseen.
std::string words_of_flutter(const Scene& scene, const Preview& foreseen);

/// What a run would be, without the warnings.
void print_preview(const Scene& scene, const Preview& foreseen);

}  // namespace talus
