#include "conformance/given_elements.hpp"

#include <algorithm>
#include <cstddef>

namespace talus::conformance {

GivenElements::GivenElements(const Material& law, std::span<const Tensor> path)
    : state((path.size() - 1) * law.doubles_per_element()),
      count(static_cast<std::uint32_t>(path.size() - 1)),
      doubles_per_element(law.doubles_per_element()),
      viscous(law.viscous_time() > 0) {
  DrivenElement element(law);
  for (std::size_t k = 0; k < 4; ++k) deformation[k].resize(count, 0), previous[k].resize(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    element.to(path[i], dt);
    std::copy(element.state().begin(), element.state().end(), state.data() + i * doubles_per_element);
    for (std::size_t k = 0; k < 4; ++k) previous[k][i] = path[i][k], deformation[k][i] = path[i + 1][k];
  }
}

MaterialBatch GivenElements::view(std::uint32_t first, std::uint32_t number) const {
  MaterialBatch batch{};
  for (std::size_t k = 0; k < 4; ++k) {
    batch.deformation[k] = deformation[k].data() + first;
    batch.previous_deformation[k] = previous[k].data() + first;
  }
  batch.state = state.data() + std::size_t{first} * doubles_per_element;
  batch.dt = dt;
  batch.count = number;
  return batch;
}

void GivenElements::surround(unsigned char value) {
  for (std::size_t k = 0; k < 4; ++k) deformation[k].surround(value), previous[k].surround(value);
  state.surround(value);
}

bool GivenElements::differs_from(const GivenElements& other) const {
  bool same = state.same_bytes(other.state);
  for (std::size_t k = 0; k < 4; ++k) {
    same =
        same && deformation[k].same_bytes(other.deformation[k]) && previous[k].same_bytes(other.previous[k]);
  }
  return !same;
}

TakenResponse::TakenResponse(const GivenElements& elements, unsigned char value)
    : energy(elements.count, value),
      dissipated(elements.count, value),
      state(std::size_t{elements.count} * elements.doubles_per_element, value) {
  for (auto* four : {&stress, &viscous_stress}) {
    for (Guarded<double>& one : *four) {
      one.resize(elements.count, value);
      one.surround(value);
    }
  }
  for (Guarded<double>* one : {&energy, &dissipated, &state}) one->surround(value);
}

MaterialResponse TakenResponse::view(const GivenElements& elements, std::uint32_t first) {
  MaterialResponse response{};
  for (std::size_t k = 0; k < 4; ++k) {
    response.stress[k] = stress[k].data() + first;
    response.viscous_stress[k] = viscous_stress[k].data() + first;
  }
  response.energy = energy.data() + first;
  response.dissipated = dissipated.data() + first;
  response.state = state.data() + std::size_t{first} * elements.doubles_per_element;
  return response;
}

bool TakenResponse::surrounded_by(unsigned char value) const {
  const auto within = [&](const Guarded<double>& one) { return one.surrounded_by(value); };
  return std::ranges::all_of(stress, within) && std::ranges::all_of(viscous_stress, within) &&
         within(energy) && within(dissipated) && within(state);
}

}  // namespace talus::conformance
