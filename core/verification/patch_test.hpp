#pragma once

#include "scene/scene.hpp"

namespace talus::verification {

struct PatchTest {
  double stress = 0, force = 0;  ///< largest errors, relative
};

/// An exact linear field on all patches of a scene's only body, of E and ν in plane strain: the stress, and
/// what is left of the forces when the field's tractions act on all sides of the boundary.
PatchTest patch_test(const Scene& scene, double modulus, double ratio);

/// The largest strain (stress over E) that 100 rigid turns in steps of 4° leave.
double strain_of_turns(const Scene& scene, double modulus);

}  // namespace talus::verification
