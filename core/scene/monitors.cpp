#include "scene/monitors.hpp"

#include "scene/quantity.hpp"
#include "scene/tables.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus {
namespace {

std::vector<std::string> known_quantities() {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities()) names.emplace_back(quantity.name);
  return names;
}

void check_quantity(Mistakes& mistakes, const std::string& pointer, const std::string& name,
                    const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  mistakes.add(pointer, fmt::format("there is no quantity \"{}\" here;{} allowed here: {}", name,
                                    did_you_mean(name, known), listed(known)));
}

std::vector<std::string> read_quantities(Reading& reading, Section& section) {
  std::vector<std::string> unasked{"ux", "uy", "vx", "vy", "speed", "rotation"};
  const Json* written = section.child("quantities");
  section.resolved["quantities"] = unasked;
  if (written == nullptr) return unasked;
  section.resolved["quantities"] = *written;
  std::vector<std::string> names;
  section.list(
      "quantities", "a list of names of quantities", [&](const Json& value, const std::string& pointer) {
        if (!value.is_string()) {
          reading.mistakes.add(pointer, fmt::format("{} is not allowed here: expected one of {}",
                                                    shown(value), listed(known_quantities())));
          return;
        }
        const std::string name = value.get<std::string>();
        check_quantity(reading.mistakes, pointer, name, known_quantities());
        if (std::find(names.begin(), names.end(), name) != names.end()) {
          reading.mistakes.add(pointer, fmt::format("\"{}\" stands twice in the list: once is enough", name));
        }
        names.push_back(name);
      });
  if (written->is_array() && written->empty()) {
    reading.mistakes.add(section.pointer_to("quantities"),
                         fmt::format("[] records nothing: expected some of {}", listed(known_quantities())));
  }
  return names;
}

Monitor read_monitor(Reading& reading, Section& section) {
  Monitor monitor{};
  if (const auto name = take_name(section, "the name of the monitor")) {
    monitor.name = *name;
    const auto number = static_cast<std::uint32_t>(reading.scene.monitors.size());
    const auto [known, is_new] = reading.monitor_index.emplace(monitor.name, number);
    if (!is_new) {
      reading.mistakes.add(section.pointer_to("name"),
                           fmt::format("\"{}\" is the name of /monitors/{} already: names must differ",
                                       monitor.name, known->second));
    }
  }
  const auto body = take_body(reading, section);
  monitor.body = body.value_or(0);
  monitor.point = take_point(reading, section, body);
  monitor.quantities = read_quantities(reading, section);
  section.finish();
  return monitor;
}

Tolerance read_tolerance(Reading& reading, Section& section) {
  Tolerance tolerance{};
  const auto monitor = take_reference(section, "monitor", "monitor", reading.monitor_index);
  tolerance.quantity = section.text("quantity", "the name of a quantity of the monitor");
  if (monitor) {
    tolerance.monitor = reading.scene.monitors[*monitor].name;
    if (!tolerance.quantity.empty()) {
      check_quantity(reading.mistakes, section.pointer_to("quantity"), tolerance.quantity,
                     reading.scene.monitors[*monitor].quantities);
    }
  }
  tolerance.against_reference = section.value(table::of(table::tolerance, "against")) == 1;
  tolerance.largest = section.optional_value(table::of(table::tolerance, "largest"));
  tolerance.rms = section.optional_value(table::of(table::tolerance, "rms"));
  tolerance.final = section.optional_value(table::of(table::tolerance, "final"));
  if (!tolerance.largest && !tolerance.rms && !tolerance.final) {
    reading.mistakes.add(section.pointer(),
                         "nothing is bounded: expected \"largest\", \"rms\" or \"final\", a number in the "
                         "unit of the quantity");
  }
  section.finish();
  return tolerance;
}

}  // namespace

void read_monitors(Reading& reading, Section& root) {
  OrderedJson resolved = OrderedJson::array();
  root.list("monitors", "a list of monitors [{\"name\": ..., \"body\": ...}]",
            [&](const Json& value, const std::string& pointer) {
              Section section(&value, pointer, reading.mistakes);
              reading.scene.monitors.push_back(read_monitor(reading, section));
              resolved.push_back(section.resolved);
            });
  root.resolved["monitors"] = std::move(resolved);
}

void read_tolerances(Reading& reading, Section& root) {
  OrderedJson resolved = OrderedJson::array();
  root.list("tolerances", "a list of tolerances [{\"monitor\": ..., \"quantity\": ..., \"largest\": ...}]",
            [&](const Json& value, const std::string& pointer) {
              Section section(&value, pointer, reading.mistakes);
              reading.scene.tolerances.push_back(read_tolerance(reading, section));
              resolved.push_back(section.resolved);
            });
  root.resolved["tolerances"] = std::move(resolved);
}

}  // namespace talus
