#pragma once

#include "preview/preview.hpp"

#include <string>

namespace talus {

/// "  label      words"
void print_row(const std::string& label, const std::string& words);

/// What a run would be, without the warnings.
void print_preview(const Scene& scene, const Preview& foreseen);

}  // namespace talus
