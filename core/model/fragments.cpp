#include "model/fragments.hpp"

#include <map>

namespace talus {

std::vector<std::uint32_t> fragments_of(const Model& model, std::uint32_t body) {
  const Body& b = model.bodies[body];
  const auto element = [&](std::uint32_t i) -> const Element& {
    return model.elements[model.body_element[i]];
  };
  Fragments fragments(model.ranges(b));
  for (std::uint32_t i = b.element_begin; i < b.element_end; ++i) fragments.add(element(i));
  std::vector<std::uint32_t> numbers;
  std::map<std::size_t, std::uint32_t> number_of;
  for (std::uint32_t i = b.element_begin; i < b.element_end; ++i) {
    const auto next = static_cast<std::uint32_t>(number_of.size());
    numbers.push_back(number_of.emplace(fragments.of(element(i).patch[0]), next).first->second);
  }
  return numbers;
}

}  // namespace talus
