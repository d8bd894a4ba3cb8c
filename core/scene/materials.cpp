#include "scene/materials.hpp"

#include "scene/components.hpp"
#include "scene/tables.hpp"

namespace talus {
namespace {

SceneMaterial read_material(Reading& reading, const std::string& name, Section& section) {
  SceneMaterial material{name, section.value(table::of(table::material, "density")), {}};
  const std::size_t mistakes_before = reading.mistakes.count();
  const Json* model = section.child("model");
  if (model != nullptr) {
    const std::string chosen = section.text("model", "the name of a material model");
    if (model->is_string()) {
      material.model = read_choice(reading, section, ComponentKind::material, chosen);
    } else {
      accept_all(section);
    }
  }
  section.finish();
  if (material.model.component != nullptr && reading.mistakes.count() == mistakes_before)
    check_constructor(reading, material.model, section.pointer());
  return material;
}

}  // namespace

void read_materials(Reading& reading, Section& root) {
  const std::string what = "an object of named materials {\"rock\": {\"density\": ...}}";
  if (root.required_child("materials", what) == nullptr) return;
  OrderedJson& resolved = root.resolved["materials"] = OrderedJson::object();
  root.members("materials", what,
               [&](const std::string& name, const Json& value, const std::string& pointer) {
                 check_name(name, pointer, reading.mistakes);
                 Section section(&value, pointer, reading.mistakes);
                 reading.material_index[name] = static_cast<std::uint32_t>(reading.scene.materials.size());
                 reading.material_has_model.push_back(section.has("model"));
                 reading.scene.materials.push_back(read_material(reading, name, section));
                 resolved[name] = section.resolved;
               });
}

}  // namespace talus
