#include "report/report.hpp"

#include "files/input_error.hpp"
#include "files/whole_file.hpp"
#include "output/records.hpp"
#include "output/vtu.hpp"
#include "plugin/registry.hpp"
#include "report/assets.hpp"
#include "report/curves.hpp"
#include "report/film.hpp"
#include "report/html_page.hpp"
#include "text/escaped.hpp"
#include "text/shell_word.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace talus {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json json_in(const fs::path& file) {
  Json json = Json::parse(read_whole_file(file), nullptr, false);
  if (json.is_discarded()) throw InputError(fmt::format("'{}' is no whole JSON", file.string()));
  return json;
}

template <class Number>
void append_bytes(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

std::string packed(const std::string& bytes) {
  std::vector<unsigned char> deflated(compressBound(bytes.size()));
  uLongf room = deflated.size();
  if (compress2(deflated.data(), &room, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib could not compress the frames of a report");
  std::string text;
  append_base64(text, deflated.data(), room);
  return text;
}

Json contacts_json(const Film& film) {
  Json count = Json::array(), slipping = Json::array();
  std::vector<double> normal, tangential;
  for (const ContactSums& sums : film.contacts) {
    count.push_back(sums.count);
    slipping.push_back(sums.slipping);
    normal.push_back(sums.normal);
    tangential.push_back(sums.tangential);
  }
  return {{"count", count},
          {"slipping", slipping},
          {"normal", short_numbers(normal)},
          {"tangential", short_numbers(tangential)}};
}

/// Shapes as numbers of fixed width, in the order the page takes them out; then the motion.
Json film_json(const Film& film) {
  if (film.time.empty()) return {{"frames", film.frames}, {"time", Json::array()}};
  std::string bytes;
  append_bytes(bytes, film.part_start);
  append_bytes(bytes, film.part_body);
  append_bytes(bytes, std::vector<float>(film.x.begin(), film.x.end()));
  append_bytes(bytes, std::vector<float>(film.y.begin(), film.y.end()));
  append_bytes(bytes, film.rigid);
  bytes += film.motion;
  return {{"frames", film.frames},
          {"every", film.every},
          {"time", short_numbers(film.time)},
          {"parts", film.part_body.size()},
          {"corners", film.x.size()},
          {"origin", {film.origin_x, film.origin_y}},
          {"quantum", film.quantum},
          {"speed", film.largest_speed},
          {"shear", film.largest_shear},
          {"contacts", contacts_json(film)},
          {"bytes", packed(bytes)}};
}

/// Which bodies stand, and what they are called.
Json bodies_json(const Json& resolved) {
  Json list = Json::array();
  if (!resolved.contains("bodies")) return list;
  for (const Json& body : resolved["bodies"])
    list.push_back({{"name", body.value("name", "")}, {"fixed", body.value("fixed", false)}});
  return list;
}

/// Names, bodies, and points where frames have them.
Json monitors_json(const Json& resolved) {
  Json list = Json::array();
  const std::vector<double> origin = resolved.value("origin", std::vector<double>{0, 0});
  for (const Json& monitor : resolved.value("monitors", Json::array())) {
    Json entry{{"name", monitor.at("name")}, {"body", monitor.at("body")}};
    if (monitor.contains("point"))
      entry["point"] = {origin.at(0) + monitor["point"].at(0).get<double>(),
                        origin.at(1) + monitor["point"].at(1).get<double>()};
    list.push_back(entry);
  }
  return list;
}

std::optional<Series> series_in(const fs::path& file) {
  return fs::exists(file) ? std::optional(read_series(file)) : std::nullopt;
}

Json curves_or_null(const std::optional<Series>& series) {
  return series ? curves_of(*series) : Json(nullptr);
}

Json difference_json(const std::optional<Series>& series, const std::optional<Series>& from,
                     Between between) {
  return series && from ? curves_of(difference(*series, *from, between)) : Json(nullptr);
}

Json run_json(const fs::path& folder, const std::string& name, const std::optional<Series>& history) {
  const Json resolved = json_in(folder / "resolved.json");
  return {{"name", name},
          {"record", read_run_record(folder)},
          {"bodies", bodies_json(resolved)},
          {"monitors", monitors_json(resolved)},
          {"names_libraries", resolved.contains("plugins") && !resolved["plugins"].empty()},
          {"history", curves_or_null(history)},
          {"energy", curves_or_null(series_in(folder / "energy.csv"))},
          {"film", film_json(read_film(folder))}};
}

std::string settings_words(const Json& record, const std::string& but) {
  std::string words;
  for (const Json& change : record.at("settings").at("set")) {
    const std::string pointer = change.at("pointer");
    if (pointer != but)
      words += " --set " + shell_word(pointer + "=" + change.at("value").get<std::string>());
  }
  return words;
}

/// What a shell must say for the libraries of all runs to be found again.
std::string plugin_words(const Json& runs) {
  if (runs.at(0).at("names_libraries")) return " --allow-plugins";
  const std::vector<fs::path> known = search_path({});
  std::set<std::string> folders;
  for (const Json& run : runs) {
    for (const Json& plugin : run.at("record").at("plugins")) {
      const fs::path folder = fs::path(plugin.at("path").get<std::string>()).lexically_normal().parent_path();
      if (std::find(known.begin(), known.end(), folder) == known.end()) folders.insert(folder.string());
    }
  }
  std::string words;
  for (const std::string& folder : folders) words += " --plugin-path " + shell_word(folder);
  return words;
}

std::string command_of(const Json& page) {
  const Json& record = page.at("runs").at(0).at("record");
  const std::string scene = shell_file(record.at("scene").at("file"));
  if (page["comparison"].is_null())
    return "talus run " + scene + settings_words(record, "") + plugin_words(page.at("runs"));
  const Json& comparison = page["comparison"];
  std::string varied = comparison.at("varied");
  for (const Json& run : comparison.at("runs"))
    varied += (varied.find('=') == std::string::npos ? '=' : ',') + run.at("value").get<std::string>();
  std::string command = "talus compare " + scene + " --vary " + shell_word(varied);
  if (comparison.contains("reference"))
    command += " --reference " + shell_file(comparison.at("reference").at("file").get<std::string>());
  for (const Json& moment : comparison.value("moments [s]", Json::array()))
    command += fmt::format(" --at {}", moment.get<double>());
  return command + settings_words(record, comparison.at("varied")) + plugin_words(page.at("runs"));
}

/// The runs of a comparison: each with its deviation from the first, and from a reference.
void add_compared_runs(const fs::path& folder, Json& page) {
  const Json& comparison = page["comparison"] = read_comparison_record(folder);
  std::optional<Series> reference, baseline;
  if (comparison.contains("reference")) {
    const Json& file = comparison.at("reference");
    // Folders of before have no copy.
    reference = read_series(file.contains("copy") ? folder / file.at("copy").get<std::string>()
                                                  : fs::path(file.at("file").get<std::string>()));
  }
  page["reference"] = curves_or_null(reference);
  for (const Json& run : comparison.at("runs")) {
    const fs::path in = folder / run.at("folder").get<std::string>();
    const std::optional<Series> history = series_in(in / "history.csv");
    Json entry = run_json(in, run.at("value"), history);
    entry["from_baseline"] = difference_json(history, baseline, Between::unknown);
    entry["from_reference"] = difference_json(history, reference, Between::line);
    page["runs"].push_back(std::move(entry));
    if (page["runs"].size() == 1) baseline = history;
  }
}

Json page_json(const fs::path& folder) {
  Json page{{"comparison", nullptr}, {"reference", nullptr}, {"runs", Json::array()}};
  if (holds_comparison(folder)) {
    add_compared_runs(folder, page);
  } else {
    page["runs"].push_back(
        run_json(folder, read_run_record(folder).at("scene").at("title"), series_in(folder / "history.csv")));
  }
  page["command"] = command_of(page);
  return page;
}

/// JSON within a page must not end its element.
std::string embedded(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  for (const char letter : text) {
    if (letter == '<') {
      safe += "\\u003c";
    } else {
      safe += letter;
    }
  }
  return safe;
}

}  // namespace

std::string report_page(const fs::path& folder) {
  Json data;
  try {
    data = page_json(folder);
  } catch (const Json::exception& problem) {
    throw InputError(
        fmt::format("'{}' does not hold what a run writes: {}", folder.string(), problem.what()));
  }
  std::string title = data["runs"][0]["record"]["scene"].value("title", "");
  if (title.empty()) title = data["runs"][0]["record"]["scene"].value("file", "talus");
  std::string script = "'use strict';\n(async () => {\n";
  for (const std::string_view part : {assets::words_js, assets::charts_js, assets::film_js, assets::stage_js,
                                      assets::motion_js, assets::tables_js, assets::start_js})
    script += part;
  script += "})();\n";
  return filled(assets::page_html, {{"title", escaped(title)},
                                    {"chart style", assets::dygraph_css},
                                    {"style", assets::page_css},
                                    {"chart script", assets::dygraph_js},
                                    {"script", script},
                                    {"data", embedded(data)}});
}

void write_report(const fs::path& folder) {
  write_whole_file(folder / "report.html", report_page(folder));
}

}  // namespace talus
