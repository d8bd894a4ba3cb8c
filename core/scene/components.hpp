#pragma once

#include "scene/reading.hpp"

#include <string>

namespace talus {

/// Cover of bodies that move as one piece and need no material model.
inline constexpr const char* rigid_cover = "rigid";
inline constexpr const char* default_cover = "block";

/// The component that the text at `pointer` names. Notes a mistake with what is installed otherwise, and
/// whether a library of that name was refused.
const RegisteredComponent* find_component(Reading& reading, ComponentKind kind, const std::string& name,
                                          const std::string& pointer);

/// "model" and the parameters that the model declares, all in one section.
Choice read_choice(Reading& reading, Section& section, ComponentKind kind, const std::string& name);

/// Makes the component once and drops it: what its constructor refuses is a mistake at `pointer`. Call it
/// where all values of the choice are good.
void check_constructor(Reading& reading, const Choice& choice, const std::string& pointer);

/// Takes whatever else the section holds: after an unknown model nobody can tell which keys are right.
void accept_all(Section& section);

}  // namespace talus
