#include "scene/read.hpp"

#include "files/whole_file.hpp"
#include "scene/blocks.hpp"
#include "scene/bodies.hpp"
#include "scene/contact.hpp"
#include "scene/interfaces.hpp"
#include "scene/libraries.hpp"
#include "scene/loads.hpp"
#include "scene/materials.hpp"
#include "scene/monitors.hpp"
#include "scene/overrides.hpp"
#include "scene/source.hpp"
#include "scene/stages.hpp"
#include "scene/tables.hpp"
#include "scene/take_function.hpp"
#include "scene/timing.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace talus {
namespace {

constexpr int format_number = 1;

void read_format(Section& root) {
  const Json* written =
      root.required_child("talus", fmt::format("the number of the format, {}", format_number));
  root.resolved["talus"] = format_number;
  if (written == nullptr || *written == format_number) return;
  root.mistakes().add(root.pointer_to("talus"), fmt::format("format {} is unknown: this program reads {}",
                                                            shown(*written), format_number));
}

void read_world(Reading& reading, Section& root) {
  reading.scene.title = root.text("title", "a text", "");
  reading.scene.origin = root.pair(table::of(table::world, "origin"));
  reading.scene.gravity = root.pair(table::of(table::world, "gravity"));
  reading.scene.base_acceleration =
      vector_function(reading, root, table::of(table::world, "base_acceleration"), Varies::in_time);
  read_damping(reading, root);
}

/// A quake that begins with a jump has shaken the scene for as long as it settled.
void warn_of_ground_while_settling(Scene& scene) {
  const auto at_start_of = [](const Function& ground) {  // without what always acts
    double sum = 0;
    for (const Product& term : ground.terms) sum += term.time ? term.scale * (*term.time)(0) : 0;
    return sum;
  };
  const Vec2 at_start{at_start_of(scene.base_acceleration[0]), at_start_of(scene.base_acceleration[1])};
  if (!scene.settle || (at_start.x == 0 && at_start.y == 0)) return;
  scene.warnings.push_back(fmt::format(
      "while the scene settles, tables of base_acceleration act with ({:.3g}, {:.3g}) m/s², as at t = 0; "
      "begin the table of what sets in then with [0, 0]",
      at_start.x, at_start.y));
}

/// All but the stages.
void read_sections(Reading& reading, Section& root, bool allow_plugins) {
  read_format(root);
  read_libraries(reading, root, reading.folder, allow_plugins);
  read_world(reading, root);
  read_materials(reading, root);
  root.child("blocks");  // became bodies before
  read_bodies(reading, root);
  const ContactSection contact = read_contact(reading, root);
  read_interfaces(reading, root, contact);
  read_loads(reading, root);
  read_surface_loads(reading, root);
  read_prescribed(reading, root);
  read_absorbing(reading, root);
  read_settle(reading, root);
  read_monitors(reading, root);
  read_time(reading, root);
  read_sleep(reading, root);
  read_output(reading, root);
  read_limits(reading, root);
  read_tolerances(reading, root);
  root.child("stages");
  root.text("$schema", "the path of a JSON Schema", "");  // for editors
  root.resolved.erase("$schema");
  root.finish();
  warn_of_ground_while_settling(reading.scene);
}

struct ReadText {
  Scene scene;
  Expansion expansion;
};

ReadText read_text(const std::string& text, const std::string& name, Registry& registry,
                   const ReadOptions& options) {
  ParsedText parsed = parse_json(text, name);
  if (!parsed.complete) throw SceneError(std::move(parsed.mistakes));

  Mistakes mistakes;
  apply_overrides(parsed.value, options.overrides, mistakes);
  Reading reading{registry, mistakes};
  reading.folder = std::filesystem::path(name).parent_path();
  reading.scene.file = name;
  reading.scene.simd = registry.simd;
  Expansion expansion;
  if (parsed.value.is_object())
    expansion = expand_blocks(parsed.value, reading.folder, options.most_blocks, mistakes);
  reading.unmade = expansion.unmade;
  reading.scene.warnings = expansion.warnings;
  reading.scene.files = expansion.files;
  const ReadAgain read_again = [&](const Json& scene, Mistakes& mistakes_again) {
    Reading again{registry, mistakes_again, reading.folder};
    again.unmade = expansion.unmade;
    Section root(&scene, "", mistakes_again);
    read_sections(again, root, options.allow_plugins);
    reading.scene.files.insert(again.scene.files.begin(), again.scene.files.end());
    return Reread{std::move(again.scene), std::move(root.resolved)};
  };
  Section root(&parsed.value, "", mistakes);
  if (parsed.value.is_object()) {
    read_sections(reading, root, options.allow_plugins);
    read_stages(reading, root, parsed.value, read_again);
  }
  mistakes.move([&](const std::string& pointer) { return expansion.origin_of(pointer); });
  if (mistakes.count() != 0 || !parsed.mistakes.empty()) {
    SceneError error = mistakes.placed(text, name, options.overrides, std::move(parsed.mistakes));
    error.warnings = std::move(expansion.warnings);
    throw error;
  }
  reading.scene.resolved = root.resolved.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
  return {std::move(reading.scene), std::move(expansion)};
}

}  // namespace

Scene read_scene_text(const std::string& text, const std::string& name, Registry& registry,
                      const ReadOptions& options) {
  return read_text(text, name, registry, options).scene;
}

Scene read_scene(const std::filesystem::path& file, Registry& registry, const ReadOptions& options) {
  return read_scene(file, read_whole_file(file), registry, options);
}

Scene read_scene(const std::filesystem::path& file, const std::string& text, Registry& registry,
                 const ReadOptions& options) {
  ReadText read = read_text(text, file.string(), registry, options);
  read.scene.source =
      std::make_shared<SceneSource>(SceneSource{options.overrides, std::move(read.expansion)});
  return std::move(read.scene);
}

}  // namespace talus
