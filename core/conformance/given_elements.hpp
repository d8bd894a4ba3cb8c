#pragma once

#include "conformance/driven_element.hpp"
#include "conformance/guarded.hpp"

#include <cstdint>
#include <span>

namespace talus::conformance {

/// All that a call gives to a material, between guard zones: elements that are each at some place of a path.
struct GivenElements {
  Guarded<double> deformation[4], previous[4], state;
  double dt = 1e-3;
  std::uint32_t count = 0, doubles_per_element = 0;
  bool viscous = false;

  /// Each element has been led to its place of the path alone, one step short of it.
  GivenElements(const Material& law, std::span<const Tensor> path);

  MaterialBatch view(std::uint32_t first, std::uint32_t number) const;
  void surround(unsigned char value);
  bool differs_from(const GivenElements& other) const;
};

/// All that a material fills in.
struct TakenResponse {
  Guarded<double> stress[4], viscous_stress[4], energy, dissipated, state;

  TakenResponse(const GivenElements& elements, unsigned char value);
  MaterialResponse view(const GivenElements& elements, std::uint32_t first);
  bool surrounded_by(unsigned char value) const;
};

}  // namespace talus::conformance
