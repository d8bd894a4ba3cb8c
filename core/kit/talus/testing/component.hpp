#pragma once

#include <talus/library.hpp>

#include <cstring>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus::testing {

template <class Interface>
using Made = std::unique_ptr<Interface, void (*)(void*) noexcept>;

/// Makes a component of a library as the program does, from the values of its parameters in declared order
/// and SI (angles in radians); their defaults, where none are given. Throws std::runtime_error when there is
/// none by that name, or with its constructor's words.
template <class Interface>
Made<Interface> make(const Library& library, const char* name, std::vector<double> values = {}) {
  for (std::uint32_t i = 0; i < library.component_count; ++i) {
    const Component& component = library.components[i];
    if (std::strcmp(component.name, name) != 0) continue;
    for (std::size_t p = values.size(); p < component.parameter_count; ++p) {
      const Parameter& parameter = component.parameters[p];
      const bool degrees = std::strcmp(parameter.unit, "deg") == 0;
      values.push_back(parameter.default_value * (degrees ? std::numbers::pi / 180 : 1));
    }
    char error[512] = "";
    void* object = component.create(values.data(), error, sizeof error);
    if (object == nullptr) throw std::runtime_error(error);
    return Made<Interface>(static_cast<Interface*>(object), component.destroy);
  }
  throw std::runtime_error(std::string("the library has no component ") + name);
}

}  // namespace talus::testing
