#include "scene/contact.hpp"

#include "scene/components.hpp"
#include "scene/tables.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <span>

namespace talus {
namespace {

std::vector<double> read_law(Section& contact, const Component& law) {
  Section section(contact.child(law.name), contact.pointer_to(law.name), contact.mistakes());
  std::vector<double> values = section.values(std::span(law.parameters, law.parameter_count));
  section.finish();
  contact.resolved[law.name] = section.resolved;
  return values;
}

/// Sections of laws that are not chosen are checked all the same: the scene may be varied over them.
void read_other_laws(Reading& reading, Section& contact, ContactSection& result) {
  for (const std::string& name : contact.keys()) {
    if (contact.knows(name)) continue;
    contact.child(name);
    if (const RegisteredComponent* law = demand(reading.registry, ComponentKind::contact_model, name)) {
      read_law(contact, *law->component);
      result.other_laws.push_back(law->component);
      continue;
    }
    load_offered(reading.registry);
    std::vector<std::string> allowed = reading.registry.names(ComponentKind::contact_model);
    allowed.insert(allowed.begin(), {"model", "roles"});
    reading.mistakes.add_at_key(
        contact.pointer_to(name),
        fmt::format("unknown key, and no contact law of that name is installed;{} allowed here: {}",
                    did_you_mean(name, allowed), listed(allowed)));
  }
}

}  // namespace

ContactSection read_contact(Reading& reading, Section& root) {
  ContactSection result;
  const Json* written = root.child("contact");
  if (written == nullptr) return result;
  result.given = true;
  Section contact(written, root.pointer_to("contact"), reading.mistakes);
  const std::string model = contact.text("model", "the name of a contact law");
  reading.scene.roles_by_priority = contact.value(table::of(table::contact, "roles")) == 1;
  if (!model.empty()) {
    result.law.component =
        find_component(reading, ComponentKind::contact_model, model, contact.pointer_to("model"));
  }
  if (result.law.component != nullptr) {
    const Component& law = *result.law.component->component;
    const std::size_t mistakes_before = reading.mistakes.count();
    result.law.values = read_law(contact, law);
    if (reading.mistakes.count() == mistakes_before)
      check_constructor(reading, result.law, contact.pointer_to(contact.has(law.name) ? law.name : "model"));
  }
  read_other_laws(reading, contact, result);
  contact.finish();
  root.resolved["contact"] = contact.resolved;
  return result;
}

}  // namespace talus
