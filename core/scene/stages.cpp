#include "scene/stages.hpp"

#include "scene/loads.hpp"
#include "scene/overrides.hpp"
#include "scene/tables.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

namespace talus {
namespace {

constexpr const char* settable[] = {"/gravity",      "/damping",       "/base_acceleration", "/interfaces",
                                    "/loads",        "/surface_loads", "/prescribed",        "/absorbing",
                                    "/bodies/*/fix", "/bodies/*/drive"};

/// Whether a stage may write there.
bool can_be_set(const std::vector<std::string>& parts) {
  std::string section = '/' + parts[0];
  if (parts[0] == "bodies" && parts.size() >= 3) section += "/*/" + parts[2];
  return std::find(std::begin(settable), std::end(settable), section) != std::end(settable);
}

/// Tells the mistakes of the scene as it is changed where the stages changed it.
class StageReader {
 public:
  StageReader(Reading& reading, const Json& scene, const ReadAgain& read_again)
      : reading_(reading), read_again_(read_again), scene_(scene), sound_(reading.mistakes.count() == 0) {
    for (const Mistakes::Found& found : reading.mistakes.found()) told_.emplace(found.pointer, found.message);
    scene_.erase("stages");
    forget_start();
  }

  void take(Section& section) {
    Stage stage;
    stage.name = section.text("name", "a name for the stage");
    stage.from = section.value(table::of(table::stage, "from"));
    check_time(section, stage.from);
    write(section);
    stage.settings = read(section);
    section.finish();
    const std::vector<Stage>& stages = reading_.scene.stages;
    continue_prescribed(stage.settings.prescribed,
                        stages.empty() ? reading_.scene.prescribed : stages.back().settings.prescribed,
                        stage.from);
    reading_.scene.stages.push_back(std::move(stage));
  }

 private:
  /// A value that a stage wrote, and where the stage says so.
  struct Written {
    std::string pointer, place;
  };

  /// Velocities at the start contradict no support that comes later.
  void forget_start() {
    const auto bodies = scene_.find("bodies");
    if (bodies == scene_.end() || !bodies->is_array()) return;
    for (Json& body : *bodies) {
      if (!body.is_object()) continue;
      body.erase("velocity");
      body.erase("angular_velocity");
    }
  }

  void check_time(Section& section, double from) {
    const double end = reading_.scene.time.end;
    if (from >= end) {
      section.mistakes().add(section.pointer_to("from"),
                             fmt::format("{} s is not before the end of the run at {} s", from, end));
    }
    if (from <= last_) {
      section.mistakes().add(
          section.pointer_to("from"),
          fmt::format("{} s is not after {} s, where the stage before begins: stages stand in the order of "
                      "their times",
                      from, last_));
    }
    last_ = std::max(last_, from);
  }

  void write(Section& section) {
    written_by_this_ = written_.size();
    section.required_child("set", "an object of pointers and values {\"/gravity\": [0, -9.81]}");
    section.members("set", "an object of pointers and values {\"/gravity\": [0, -9.81]}",
                    [&](const std::string& pointer, const Json& value, const std::string& place) {
                      write_one(pointer, value, place);
                    });
  }

  void write_one(const std::string& pointer, const Json& value, const std::string& place) {
    const auto parts = split_pointer(pointer);
    if (!parts || !can_be_set(*parts)) {
      reading_.mistakes.add_at_key(
          place, fmt::format("{}: a stage can set what is at or below {}",
                             parts ? "this does not change during a run" : "this is no JSON pointer",
                             listed({std::begin(settable), std::end(settable)})));
      return;
    }
    std::string missing, problem;
    if (write_value(scene_, *parts, value, missing, problem)) {
      written_.push_back({pointer, place});
    } else {
      reading_.mistakes.add_at_key(place, fmt::format("{}: {}", missing, problem));
    }
  }

  /// Reads the scene as it is now.
  StageSettings read(Section& section) {
    Mistakes mistakes;
    Reread again = read_again_(scene_, mistakes);
    for (const Mistakes::Found& found : mistakes.found()) {
      if (told_.emplace(found.pointer, found.message).second)
        tell(section, found.pointer, found.message, found.at_key);
    }
    if (mistakes.count() == 0 && sound_) check_interfaces(section, again.scene);
    for (const std::string& warning : again.scene.warnings) {
      std::vector<std::string>& warnings = reading_.scene.warnings;
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
    }
    OrderedJson& set = section.resolved["set"] = OrderedJson::object();
    for (std::size_t i = written_by_this_; i < written_.size(); ++i) {
      const OrderedJson::json_pointer pointer(written_[i].pointer);
      if (again.resolved.contains(pointer)) set[written_[i].pointer] = again.resolved[pointer];
    }
    return settings_of(again.scene);
  }

  /// At the entry that wrote the value, or at one that wrote within it.
  void tell(Section& section, const std::string& pointer, const std::string& message, bool at_key) {
    for (std::size_t i = written_.size(); i-- > 0;) {
      if (!is_within(pointer, written_[i].pointer)) continue;
      const std::string place = written_[i].place + pointer.substr(written_[i].pointer.size());
      at_key ? reading_.mistakes.add_at_key(place, message) : reading_.mistakes.add(place, message);
      return;
    }
    std::string place = section.pointer_to("set");
    for (std::size_t i = written_by_this_; i < written_.size(); ++i) {
      if (is_within(written_[i].pointer, pointer)) place = written_[i].place;
    }
    reading_.mistakes.add(place, pointer.empty() ? message : fmt::format("{}: {}", pointer, message));
  }

  /// Contact keeps its history by rows.
  void check_interfaces(Section& section, const Scene& scene) {
    const Scene& first = reading_.scene;
    if (scene.interface_values.size() == first.interface_values.size() &&
        scene.surfaces.size() == first.surfaces.size() && scene.interface_row == first.interface_row)
      return;
    tell(section, "/interfaces",
         "the rows match other surfaces than at the start: a stage may change their values alone; keep their "
         "number and each \"between\"",
         false);
  }

  Reading& reading_;
  const ReadAgain& read_again_;
  Json scene_;  ///< with the values of the stages so far
  bool sound_;  ///< whether the scene itself has no mistake
  std::set<std::pair<std::string, std::string>> told_;
  std::vector<Written> written_;
  std::size_t written_by_this_ = 0;  ///< first in written_ that the current stage wrote
  double last_ = 0;
};

}  // namespace

void read_stages(Reading& reading, Section& root, const Json& scene, const ReadAgain& read_again) {
  OrderedJson resolved = OrderedJson::array();
  const Json* written = root.child("stages");
  if (written != nullptr && !(written->is_array() && written->empty())) {
    StageReader reader(reading, scene, read_again);
    root.list("stages", "a list of stages [{\"name\": ..., \"from\": ..., \"set\": {...}}]",
              [&](const Json& value, const std::string& pointer) {
                Section section(&value, pointer, reading.mistakes);
                reader.take(section);
                resolved.push_back(section.resolved);
              });
  }
  root.resolved["stages"] = std::move(resolved);
}

bool may_bond(const Scene& scene) {
  if (scene.contact.component == nullptr) return false;
  const Component& law = *scene.contact.component->component;
  const auto bonds = [&](const std::vector<double>& values) {
    for (std::uint32_t i = 0; i < law.interface_parameter_count; ++i) {
      const std::string_view key = law.interface_parameters[i].key;
      if (values[i] > 0 && (key.ends_with("cohesion") || key.ends_with("tensile_strength"))) return true;
    }
    return false;
  };
  return std::ranges::any_of(scene.interface_values, bonds) ||
         std::ranges::any_of(scene.stages, [&](const Stage& stage) {
           return std::ranges::any_of(stage.settings.interface_values, bonds);
         });
}

StageSettings settings_of(const Scene& scene) {
  StageSettings settings{scene.gravity, scene.base_acceleration, scene.damping,    scene.interface_values, {},
                         scene.loads,   scene.surface_loads,     scene.prescribed, scene.absorbing};
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(),
                  [](const SceneBody& body) { return body.support.any(); })) {
    for (const SceneBody& body : scene.bodies) settings.supports.push_back(body.support);
  }
  return settings;
}

}  // namespace talus
