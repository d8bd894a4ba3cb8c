#pragma once

#include "conformance/check.hpp"
#include "conformance/driven_element.hpp"
#include "conformance/sample_values.hpp"

namespace talus::conformance {

/// A material with sample values for its parameters but for what is given.
Made<Material> sample_material(const Subject& subject, const Values& given = {});

/// Stress per strain along x from the undeformed state, Pa: the measure of all round-off.
double modulus_of(const Material& law);

// What stress and energy must be.
void check_power(const Subject& subject, Trial& trial);
void check_viscous_loss(const Subject& subject, Trial& trial);
void check_objectivity(const Subject& subject, Trial& trial);
void check_stress_potential(const Subject& subject, Trial& trial);
void check_tangent(const Subject& subject, Trial& trial);

// What holds between calls.
void check_material_restore(const Subject& subject, Trial& trial);
void check_material_split(const Subject& subject, Trial& trial);
void check_material_writes(const Subject& subject, Trial& trial);
void check_material_reads(const Subject& subject, Trial& trial);
void check_material_sweep(const Subject& subject, Trial& trial);
void check_material_degenerate(const Subject& subject, Trial& trial);
void measure_material_cost(const Subject& subject, Trial& trial);

}  // namespace talus::conformance
