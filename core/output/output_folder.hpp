#pragma once

#include <filesystem>

namespace talus {

/// Makes the folder that results go to. One that holds results already is refused (InputError), or with
/// `overwrite` cleared of them: of files that talus writes, never of others.
void prepare_output_folder(const std::filesystem::path& folder, bool overwrite);

}  // namespace talus
