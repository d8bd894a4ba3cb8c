#include "scene/components.hpp"

#include "plugin/refusal.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <span>

namespace talus {

const RegisteredComponent* find_component(Reading& reading, ComponentKind kind, const std::string& name,
                                          const std::string& pointer) {
  if (const RegisteredComponent* found = demand(reading.registry, kind, name)) return found;
  load_offered(reading.registry);
  const std::vector<std::string> names = reading.registry.names(kind);
  std::string message = fmt::format("there is no {} \"{}\";{} installed: {}", kind_in_words(kind), name,
                                    did_you_mean(name, names), listed(names));
  for (const RefusedLibrary& refused : reading.registry.refused) {
    const std::string stem = refused.file.stem().string();
    if (stem == name || stem == "lib" + name) {
      message += fmt::format("; the library {} was refused: {}", refused.file.string(), refused.reason);
    }
  }
  reading.mistakes.add(pointer, message);
  return nullptr;
}

Choice read_choice(Reading& reading, Section& section, ComponentKind kind, const std::string& name) {
  const RegisteredComponent* entry = find_component(reading, kind, name, section.pointer_to("model"));
  if (entry == nullptr) {
    accept_all(section);
    return {};
  }
  return {entry, section.values(std::span(entry->component->parameters, entry->component->parameter_count))};
}

void check_constructor(Reading& reading, const Choice& choice, const std::string& pointer) {
  const Component& component = *choice.component->component;
  // Not by make(), whose error names the library's file first: here the scene is at fault.
  char error[room_for_words] = "";
  if (void* made = component.create(choice.values.data(), error, sizeof error)) {
    component.destroy(made);
  } else {
    reading.mistakes.add(pointer,
                         fmt::format("{} \"{}\" refuses its parameters: {}", kind_in_words(component.kind),
                                     component.name, words_of_plugin(error)));
  }
}

void accept_all(Section& section) {
  for (const std::string& key : section.keys()) section.child(key);
}

}  // namespace talus
