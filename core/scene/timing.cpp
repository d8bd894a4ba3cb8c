#include "scene/timing.hpp"

#include "scene/tables.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr double most_outputs = 1e7;  // rows of a history; more is a slip of the pen

std::optional<double> read_dt(Section& time) {
  const Parameter& dt = table::of(table::time, "dt");
  const Json* written = time.child("dt");
  if (written == nullptr || *written == "auto") {
    time.resolved["dt"] = "auto";
    return std::nullopt;
  }
  if (written->is_number()) return time.value(dt);
  time.mistakes().add(time.pointer_to("dt"), fmt::format("{} is not allowed here: expected \"auto\" or {}",
                                                         shown(*written), expectation(dt)));
  return std::nullopt;
}

Damping take_damping(Section& section, const Parameter& parameter) {
  Damping damping;
  const Json* written = section.child(parameter.key);
  if (written == nullptr || written->is_number()) {
    damping.constant = section.value(parameter);
    return damping;
  }
  section.resolved[parameter.key] = *written;
  if (*written == "adaptive") {
    damping.kind = Damping::Kind::adaptive;
  } else if (*written == "kinetic") {
    damping.kind = Damping::Kind::kinetic;
  } else {
    const std::string guess =
        written->is_string() ? did_you_mean(written->get<std::string>(), {"adaptive", "kinetic"}) : "";
    section.mistakes().add(
        section.pointer_to(parameter.key),
        fmt::format("{} is not allowed here{}{} expected \"adaptive\", \"kinetic\" or {}", shown(*written),
                    guess.empty() ? ":" : ";", guess, expectation(parameter)));
  }
  return damping;
}

void check_safety(Reading& reading, Section& time) {
  const bool meets = reading.scene.contact.component != nullptr;
  if (!meets || !(reading.scene.time.safety > table::safety_with_contact)) return;
  time.mistakes().add(
      time.pointer_to("safety"),
      fmt::format("{} is out of range: expected a number [-] greater than 0 and at most {} where "
                  "bodies can meet",
                  shown(Json(reading.scene.time.safety)), table::safety_with_contact));
}

/// A 500th of the run, shortened where needed so that frames fall on rows of the history.
double unasked_history(double end, const std::optional<double>& frames) {
  const double share = end / 500;
  if (!frames || !(*frames > 0)) return share;
  return *frames / std::max(1.0, std::ceil(*frames / share - 1e-9));
}

void check_output(Section& output, const OutputSettings& settings, double end) {
  if (end / settings.history > most_outputs) {
    output.mistakes().add(
        output.pointer_to("history"),
        fmt::format("{} s would give {:.3g} rows up to the end at {} s: expected a longer interval, "
                    "at least {} s",
                    settings.history, end / settings.history, end, end / most_outputs));
  }
  if (!settings.frames) return;
  const double ratio = *settings.frames / settings.history, whole = std::round(ratio);
  if (whole < 1 || std::abs(ratio - whole) > 1e-9 * whole) {
    output.mistakes().add(
        output.pointer_to("frames"),
        fmt::format("{} s is no whole multiple of \"history\", {} s: expected one, such as {} s",
                    *settings.frames, settings.history, std::max(1.0, whole) * settings.history));
  }
}

}  // namespace

void read_damping(Reading& reading, Section& root) {
  reading.scene.damping = take_damping(root, table::of(table::world, "damping"));
}

void read_settle(Reading& reading, Section& root) {
  const Json* written = root.child("settle");
  if (written == nullptr) return;
  Section settle(written, root.pointer_to("settle"), reading.mistakes);
  Settle read{};
  read.duration = settle.value(table::of(table::settle, "duration"));
  read.damping = take_damping(settle, table::of(table::settle, "damping"));
  read.until = settle.optional_value(table::of(table::settle, "until"));
  read.hold_stick = settle.value(table::of(table::settle, "hold_stick")) == 1;
  reading.scene.settle = read;
  settle.finish();
  root.resolved["settle"] = settle.resolved;
}

void read_time(Reading& reading, Section& root) {
  const Json* written = root.required_child("time", "{\"end\": ...}, when the run ends [s]");
  if (written == nullptr) {
    reading.scene.time.end = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  Section time(written, root.pointer_to("time"), reading.mistakes);
  reading.scene.time.end = time.value(table::of(table::time, "end"));
  reading.scene.time.dt = read_dt(time);
  reading.scene.time.safety = time.value(table::of(table::time, "safety"));
  check_safety(reading, time);
  time.finish();
  root.resolved["time"] = time.resolved;
}

void read_sleep(Reading& reading, Section& root) {
  const Json* written = root.child("sleep");
  if (written == nullptr) return;
  Section sleep(written, root.pointer_to("sleep"), reading.mistakes);
  SleepSettings read{};
  read.speed = sleep.value(table::of(table::sleep, "speed"));
  read.acceleration = sleep.value(table::of(table::sleep, "acceleration"));
  read.after = sleep.value(table::of(table::sleep, "after"));
  reading.scene.sleep = read;
  sleep.finish();
  root.resolved["sleep"] = sleep.resolved;
}

void read_output(Reading& reading, Section& root) {
  Section output(root.child("output"), root.pointer_to("output"), reading.mistakes);
  OutputSettings& settings = reading.scene.output;
  output.resolved["history"] = nullptr;  // stands first, though its default waits for the frames
  const std::optional<double> history = output.optional_value(table::of(table::output, "history"));
  settings.frames = output.optional_value(table::of(table::output, "frames"));
  settings.history = history ? *history : unasked_history(reading.scene.time.end, settings.frames);
  if (!history && std::isfinite(settings.history)) output.resolved["history"] = settings.history;
  check_output(output, settings, reading.scene.time.end);
  output.finish();
  root.resolved["output"] = output.resolved;
}

void read_limits(Reading& reading, Section& root) {
  Section limits(root.child("limits"), root.pointer_to("limits"), reading.mistakes);
  reading.scene.limits.energy_residual = limits.value(table::of(table::limits, "energy_residual"));
  reading.scene.limits.penetration = limits.value(table::of(table::limits, "penetration"));
  limits.finish();
  root.resolved["limits"] = limits.resolved;
}

}  // namespace talus
