#pragma once

#include "plugin/registry.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace talus {

/// "contact law", "material", "cover".
std::string_view kind_in_words(ComponentKind kind);

/// The refusal of a file, led by its name. Reasons say what was found, what was wanted and what to do.
PluginError refusal(const std::filesystem::path& file, std::string_view reason);

/// Words for what is wrong with the numbers of a descriptor (magic, ABI, sizes, instruction sets), or
/// nothing. Reads no pointer of it, so it can judge the bytes in a file.
std::optional<std::string> reason_in_numbers(const Library& library);

/// Words for the first component of `library` whose name another library has taken, or nothing.
std::optional<std::string> reason_of_clash(const Registry& registry, const Library& library);

/// Words for what is wrong with a component's tables, functions or names, or nothing.
std::optional<std::string> reason_to_refuse(const Component& component);

}  // namespace talus
