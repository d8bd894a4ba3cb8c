#pragma once

#include "scene/reading.hpp"

#include <vector>

namespace talus {

/// What "contact" says, before it is known whether any two bodies can meet.
struct ContactSection {
  bool given = false;
  Choice law;                                ///< component is nullptr if unknown or not given
  std::vector<const Component*> other_laws;  ///< with a section of their own, but not chosen
};

/// "contact": the law, the roles, and a section of parameters for each law that the scene may be varied over.
ContactSection read_contact(Reading& reading, Section& root);

}  // namespace talus
