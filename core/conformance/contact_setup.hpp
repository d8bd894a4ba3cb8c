#pragma once

#include "conformance/check.hpp"
#include "conformance/driven_law.hpp"
#include "conformance/pairs.hpp"

#include <optional>
#include <vector>

namespace talus::conformance {

/// A block of 1 x 1 m on a wide base, 1 mm deep.
std::vector<HeldBody> flat_on_flat();
/// A corner of 60 degrees, 2 mm deep in a flat: its contact length is proportional to its depth.
std::vector<HeldBody> corner_in_flat();

/// Bodies that meet, and what they are called.
struct Setup {
  const char* name;
  std::vector<HeldBody> bodies;
};
/// The flat and the corner above.
std::vector<Setup> setups();

/// Undamped, with the friction angle in degrees and the coefficient that goes with it.
Values undamped_with_friction(double angle);

/// Force per depth of the flat contact, N/m per metre of thickness: the measure of all round-off. A
/// coordinate that is rounded by 1e-15 m is worth 1e-15 of it in force.
double scale_of(const Subject& subject, Trial& trial);

/// Pairs that can be turned and mirrored: no exact ties.
std::vector<HeldPair> pairs_without_ties(std::uint32_t random);
void at_rest(std::vector<HeldBody>& bodies);

/// Largest difference of a component of force or moment.
double difference(const BodyForce& p, const BodyForce& q);

/// "law vertex_edge, corner on flat 3, master share 0.5": what is fed.
std::string fed_pair(const HeldPair& pair, double master_share);

/// The coefficient that goes with a friction angle in degrees, where the law has a parameter for it.
bool has_interface_parameter(const Subject& subject, std::string_view key);

/// 24 pairs of bodies far from each other, in motion, each with history of two steps.
void fill_with_pairs(DrivenLaw& law);

}  // namespace talus::conformance
