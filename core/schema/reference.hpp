#pragma once

#include "plugin/registry.hpp"
#include "schema/parts.hpp"

#include <string>

namespace talus {

/// A table of keys in Markdown.
std::string reference_table(const std::vector<Key>& keys);

/// The text with the tables between its markers as they are for these components. A marker is a line
/// <!-- reference: NAME --> and the next line <!-- end of reference --> ends the table; NAME is the pointer
/// of a section, a component, "NAME of an interface" for what a contact law reads there, or "quantities".
/// Throws InputError where there is no such name or no end.
std::string with_reference(const std::string& markdown, const Registry& registry);

}  // namespace talus
