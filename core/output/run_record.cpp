#include "output/run_record.hpp"

#include "files/hash.hpp"
#include "machine/processor.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <thread>

namespace talus {

namespace {

using Json = nlohmann::ordered_json;

void add_component(std::vector<UsedLibrary>& used, const RegisteredComponent* component) {
  if (component == nullptr) return;
  const auto same_file = [&](const UsedLibrary& entry) { return entry.file == component->file; };
  auto entry = std::find_if(used.begin(), used.end(), same_file);
  if (entry == used.end())
    entry = used.insert(used.end(), {component->library, component->file, component->opened, {}});
  const std::string name = component->component->name;
  if (std::find(entry->components.begin(), entry->components.end(), name) == entry->components.end()) {
    entry->components.push_back(name);
  }
}

/// A plugin may leave a text out.
std::string text_of(const char* text) {
  return text == nullptr ? "" : text;
}

Json libraries_json(const Scene& scene) {
  Json list = Json::array();
  for (const UsedLibrary& used : used_libraries(scene)) {
    list.push_back({{"name", text_of(used.library->name)},
                    {"version", text_of(used.library->version)},
                    {"author", text_of(used.library->author)},
                    {"components", used.components},
                    {"file", used.file.filename().string()},
                    {"path", used.file.string()},
                    {"xxh3_128", hash_of_file(used.file)},
                    {"opened", used.opened.string()},
                    {"opened_xxh3_128", hash_of_file(used.opened)}});
  }
  return list;
}

Json settings_json(const RunOrder& order, const Scene& scene) {
  Json overrides = Json::array();
  for (const Override& change : order.overrides) {
    overrides.push_back({{"pointer", change.pointer}, {"value", change.value}});
  }
  Json settings{{"threads", order.settings.threads},
                {"neighbour_skin", order.settings.neighbour_skin},
                {"simd", std::string(name_of(scene.simd))}};
  settings["largest_dt [s]"] =
      order.settings.largest_dt > 0 ? Json(order.settings.largest_dt) : Json(nullptr);
  settings["set"] = overrides;
  return settings;
}

Json time_json(Elapsed elapsed) {
  return {{"wall [s]", elapsed.wall}, {"cpu [s]", elapsed.cpu}};
}

Json cost_json(const RunResult& result) {
  Elapsed all = result.settling;
  all += result.stepping;
  all += result.writing;
  return {{"wall [s]", all.wall},
          {"cpu [s]", all.cpu},
          {"settling", time_json(result.settling)},
          {"stepping", time_json(result.stepping)},
          {"writing", time_json(result.writing)},
          {"block_steps_per_second", result.block_steps_per_second}};
}

Json ledger_json(const EnergyLedger& ledger) {
  Json json;
  for (const LedgerEntry& entry : ledger_entries)
    json[fmt::format("{} [J/m]", entry.name)] = ledger.*entry.value;
  return json;
}

Json sleep_json(const SleepReport& sleep) {
  return {{"islands", sleep.islands},
          {"woken", sleep.woken},
          {"bodies_asleep", sleep.bodies_asleep},
          {"longest [s]", sleep.longest},
          {"body_time [s]", sleep.body_time},
          {"speed [m/s]", sleep.speed},
          {"acceleration [m/s2]", sleep.acceleration},
          {"velocity_bound [m/s]", sleep.velocity_bound},
          {"displacement_bound [m]", sleep.displacement_bound},
          {"kinetic_energy [J/m]", sleep.kinetic_energy}};
}

}  // namespace

const char* name_of(RunEnd end) {
  switch (end) {
    case RunEnd::finished:
      return "finished";
    case RunEnd::interrupted:
      return "interrupted";
    case RunEnd::stopped:
      return "stopped";
  }
  return "";
}

std::vector<UsedLibrary> used_libraries(const Scene& scene) {
  std::vector<UsedLibrary> used;
  add_component(used, scene.contact.component);
  for (const SceneMaterial& material : scene.materials) add_component(used, material.model.component);
  for (const SceneBody& body : scene.bodies) add_component(used, body.cover.component);
  return used;
}

std::vector<Checkpoint::UsedLibrary> hashed_libraries(const Scene& scene) {
  std::vector<Checkpoint::UsedLibrary> hashed;
  for (const UsedLibrary& used : used_libraries(scene))
    hashed.push_back({used.file.filename().string(), hash_of_file(used.opened)});
  return hashed;
}

std::string run_record(const Scene& scene, const RunOrder& order, const RunResult& result) {
  const RunSummary& summary = result.summary;
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), summary.warnings.begin(), summary.warnings.end());
  Json record;
  record["talus"] = TALUS_VERSION;
  record["end"] = name_of(result.end);
  if (result.end == RunEnd::stopped) record["trouble"] = result.trouble;
  record["t [s]"] = result.never_settled ? 0 : result.time;
  if (result.never_settled) record["settling_t [s]"] = result.time;
  if (order.from != nullptr) record["continued [s]"] = order.checkpoints->run.continued;
  record["scene"] = {
      {"file", scene.file}, {"title", scene.title}, {"xxh3_128", order.scene_hash}, {"files", scene.files}};
  record["plugins"] = libraries_json(scene);
  record["settings"] = settings_json(order, scene);
  record["machine"] = {{"processor", processor_name()}, {"cores", std::thread::hardware_concurrency()}};
  record["bodies"] = scene.bodies.size();
  record["blocks"] = result.blocks;
  record["elements"] = result.elements;
  record["steps"] = summary.steps;
  record["settle_steps"] = summary.settle_steps;
  record["pair_searches"] = summary.pair_searches;
  record["cost"] = cost_json(result);
  record["dt [s]"] = summary.dt;
  record["dt_limiter"] = summary.dt_limiter;
  record["critical_dt [s]"] = summary.critical_dt;
  record["largest_penetration [m]"] = summary.largest_penetration;
  record["largest_penetration_pair"] = summary.largest_penetration_pair;
  if (summary.sleep) record["sleep"] = sleep_json(*summary.sleep);
  record["ledger"] = ledger_json(result.ledger);
  record["largest_residual_share"] = summary.largest_residual_share;
  record["warnings"] = warnings;
  record["state_hash"] = result.state_hash;
  return record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace talus
