#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace talus {

/// Makes the folder that results go to. One that holds results already, or that another run writes into, is
/// refused (InputError); with `overwrite` it is cleared of results: of files that talus writes, never of
/// others. Refused is, too, one that may not be written (std::system_error), and what would take away a file
/// that was `read` to make the results. Runs of a study stay; its tables do not.
void prepare_output_folder(const std::filesystem::path& folder, bool overwrite,
                           const std::vector<std::filesystem::path>& read = {});

/// The first half of it, for those who prepare several folders and would lose the results of one to what
/// another is refused for: refuses, and returns the results that would be cleared.
std::vector<std::filesystem::path> refuse_output_folder(const std::filesystem::path& folder, bool overwrite,
                                                        const std::vector<std::filesystem::path>& read = {});

/// Makes the folder that results of many runs go to, each in a folder of its own. One that holds results of a
/// single run is refused (InputError), and one where a file of results would take the place of one that was
/// `read` to make them.
void prepare_folder_of_runs(const std::filesystem::path& folder,
                            const std::vector<std::filesystem::path>& read = {});

/// Takes a run out of its folder, and that, too, where nothing else is in it. It stays where one of its files
/// was `read` to make others; does nothing where there is no such folder.
void remove_run(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& read);

/// Takes the tables of a study and its runs out of a folder: of those that do not stay what talus writes, and
/// their folders where nothing else is in them. Throws InputError, and removes nothing, where one was `read`
/// to make others.
void remove_study(const std::filesystem::path& folder,
                  const std::function<bool(const std::filesystem::path& run)>& stays,
                  const std::vector<std::filesystem::path>& read);

/// Throws InputError where a folder lies within that of a comparison or a study at work, which would take
/// what is written there for its own.
void refuse_among_runs_at_work(const std::filesystem::path& folder);

/// Whether it holds a run that came to its end, as far as its record can be read.
bool holds_finished_run(const std::filesystem::path& folder);

}  // namespace talus
