#pragma once

#include <filesystem>

namespace talus {

/// Makes the folder that results go to. One that holds results already, or that another run writes into, is
/// refused (InputError); with `overwrite` it is cleared of results: of files that talus writes, never of
/// others.
void prepare_output_folder(const std::filesystem::path& folder, bool overwrite);

}  // namespace talus
