#pragma once

#include "output/recorded_run.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// A library whose components a scene uses.
struct UsedLibrary {
  const Library* library;
  std::filesystem::path file, opened;   ///< see RegisteredComponent
  std::vector<std::string> components;  ///< those in use
};

/// In the order contact law, materials, covers, each library once.
std::vector<UsedLibrary> used_libraries(const Scene& scene);

/// The same for a checkpoint, to know them again.
std::vector<Checkpoint::UsedLibrary> hashed_libraries(const Scene& scene);

const char* name_of(RunEnd end);  ///< "finished" and so on

/// Text of run.json: all that is needed to say how a result came about.
std::string run_record(const Scene& scene, const RunOrder& order, const RunResult& result);

}  // namespace talus
