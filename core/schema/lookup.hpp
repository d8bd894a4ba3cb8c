#pragma once

#include "plugin/registry.hpp"
#include "schema/parts.hpp"

#include <string>
#include <vector>

namespace talus {

/// Keys of one section or component, for a reader.
struct KeysFound {
  std::string of;  ///< "/bodies/*", "/contact/overlap_area" or "/materials/* of linear_elastic"
  std::vector<Key> keys;
};

/// The section at a pointer as messages have it ("/time", "/bodies/3/drive"), or of the entries of a list
/// ("/bodies"). Null if there is none.
const Part* section_at(const std::vector<Part>& parts, const std::string& pointer);
/// That of the entry at a pointer: "/bodies/3", "/materials/rock". Null if there is none.
const Part* entry_at(const std::vector<Part>& parts, const std::string& pointer);

/// All that has a key of this name: a bare word anywhere, a pointer ("/bodies/3/velocity", "/time/end") in
/// the section that it leads to. What components declare is among it.
std::vector<KeysFound> keys_named(const std::vector<Part>& parts, const Registry& registry,
                                  const std::string& name);

/// What might have been meant by a pointer into a section: "/time/end".
std::vector<std::string> pointers_beside(const std::vector<Part>& parts, const Registry& registry,
                                         const std::string& pointer);

}  // namespace talus
