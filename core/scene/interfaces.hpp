#pragma once

#include "scene/contact.hpp"
#include "scene/reading.hpp"

namespace talus {

/// "interfaces": numbers the surfaces, reads the rows in the order the law declared its parameters, and gives
/// each pair of surface classes that can meet its most specific row.
void read_interfaces(Reading& reading, Section& root, const ContactSection& contact);

}  // namespace talus
