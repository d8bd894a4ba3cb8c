#include "report/figures.hpp"

#include "files/whole_file.hpp"
#include "output/records.hpp"
#include "output/series.hpp"
#include "picture/chart.hpp"
#include "picture/palette.hpp"
#include "picture/section.hpp"
#include "report/frames.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace talus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double picture_width = 1000;

/// The results of one run.
struct Results {
  std::string name;  ///< "" where there is one run only
  fs::path folder;
};

std::vector<Results> results_in(const fs::path& folder) {
  if (!holds_comparison(folder)) return {{"", folder}};
  std::vector<Results> runs;
  const Json comparison = read_comparison_record(folder);
  for (const Json& run : comparison.at("runs"))
    runs.push_back({run.at("value"), folder / run.at("folder").get<std::string>()});
  return runs;
}

/// "speed" and "m/s" of "monitor.speed [m/s]", and the monitor.
struct Column {
  std::string monitor, quantity, unit;
};

Column column_of(const std::string& name) {
  const std::size_t open = name.rfind(" ["), dot = name.rfind('.', open);
  if (dot == std::string::npos || open == std::string::npos) return {"", name, ""};
  return {name.substr(0, dot), name.substr(dot + 1, open - dot - 1),
          name.substr(open + 2, name.size() - open - 3)};
}

/// Draws one after the other into a folder.
class Figures {
 public:
  explicit Figures(fs::path folder) : folder_(std::move(folder)) { fs::create_directories(folder_); }

  void add(const std::string& name, const std::string& svg) {
    files_.push_back(folder_ / (name + ".svg"));
    write_whole_file(files_.back(), svg);
  }
  std::vector<fs::path> files() const { return files_; }

 private:
  fs::path folder_;
  std::vector<fs::path> files_;
};

const char* dashes(std::size_t index) {
  constexpr const char* kinds[] = {"", "7 3", "2 2", "9 3 2 3", "4 4", "1 3"};
  return kinds[index % std::size(kinds)];
}

/// The folder of a value has a name that any file may have.
std::string suffix(const Results& run) {
  return run.name.empty() ? "" : fmt::format("_{}", run.folder.filename().string());
}

void draw_monitors(const std::vector<Results>& runs, Figures& figures) {
  struct Group {
    std::string unit;
    std::vector<Curve> curves;
    std::vector<std::string> monitors;
  };
  std::vector<std::string> order;
  std::map<std::string, Group> groups;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const Series series = read_series(runs[run].folder / "history.csv");
    for (std::size_t i = 0; i < series.names.size(); ++i) {
      const Column column = column_of(series.names[i]);
      if (!groups.contains(column.quantity)) order.push_back(column.quantity);
      Group& group = groups[column.quantity];
      group.unit = column.unit;
      auto monitor = std::find(group.monitors.begin(), group.monitors.end(), column.monitor);
      if (monitor == group.monitors.end()) monitor = group.monitors.insert(monitor, column.monitor);
      const auto number = static_cast<std::size_t>(monitor - group.monitors.begin());
      const bool several = runs.size() > 1;
      group.curves.push_back({several ? runs[run].name + " " + column.monitor : column.monitor, series.time,
                              series.values[i], several ? run : number, several ? dashes(number) : ""});
    }
  }
  for (const std::string& quantity : order) {
    const Group& group = groups[quantity];
    figures.add(quantity,
                chart_svg(quantity, "t [s]", fmt::format("{} [{}]", quantity, group.unit), group.curves));
  }
}

void draw_energies(const Results& run, Figures& figures) {
  const Series series = read_series(run.folder / "energy.csv");
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < series.names.size(); ++i) {
    const std::string name = series.names[i].substr(0, series.names[i].rfind(" ["));
    const std::vector<double>& values = series.values[i];
    if (name == "throughput" || std::all_of(values.begin(), values.end(), [](double v) { return v == 0; }))
      continue;
    curves.push_back(
        {name, series.time, values, curves.size(), dashes(curves.size() / std::size(palette::lines))});
  }
  figures.add("energy" + suffix(run), chart_svg("energy " + run.name, "t [s]", "energy [J/m]", curves));
}

void draw_contacts(const std::vector<Results>& runs, Figures& figures) {
  std::vector<Curve> curves;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const std::string of = runs.size() > 1 ? runs[run].name + " " : "";
    Curve normal{of + "normal", {}, {}, run, ""}, tangential{of + "tangential", {}, {}, run, dashes(1)};
    for (const ListedFrame& frame : listed_frames(runs[run].folder)) {
      const ContactSums sums = contact_sums(read_grid(frame.contacts));
      normal.x.push_back(frame.time);
      tangential.x.push_back(frame.time);
      normal.y.push_back(sums.normal);
      tangential.y.push_back(sums.tangential);
    }
    if (normal.x.empty()) continue;
    curves.push_back(normal);
    curves.push_back(tangential);
  }
  if (!curves.empty())
    figures.add("contact_forces", chart_svg("contact forces", "t [s]", "sum of magnitudes [N/m]", curves));
}

std::vector<std::vector<Vec2>> polygons_of(const Grid& grid) {
  std::vector<std::vector<Vec2>> polygons;
  std::size_t corner = 0;
  for (const std::int64_t end : grid.offsets) {
    std::vector<Vec2>& polygon = polygons.emplace_back();
    for (; corner < static_cast<std::size_t>(end); ++corner) {
      const auto point = static_cast<std::size_t>(grid.connectivity[corner]);
      polygon.push_back({grid.points[3 * point], grid.points[3 * point + 1]});
    }
  }
  return polygons;
}

/// Bodies coloured by how far they have moved since the first frame, which is drawn in dashes.
std::string state_svg(const std::string& title, const Grid& first, const Grid& now) {
  const auto start = polygons_of(first), polygons = polygons_of(now);
  std::vector<Vec2> shown;
  for (const auto* all : {&start, &polygons}) {
    for (const std::vector<Vec2>& polygon : *all) shown.insert(shown.end(), polygon.begin(), polygon.end());
  }
  const SectionView view(shown, picture_width);
  std::vector<double> moved;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    double most = 0;
    for (std::size_t k = 0; k < polygons[i].size() && i < start.size() && k < start[i].size(); ++k)
      most = std::max(most, std::hypot(polygons[i][k].x - start[i][k].x, polygons[i][k].y - start[i][k].y));
    moved.push_back(most);
  }
  const double farthest = moved.empty() ? 0 : *std::max_element(moved.begin(), moved.end());
  Svg svg(picture_width, view.height() + 24, title);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::string fill = moved[i] > 0 ? palette::shade(moved[i] / farthest) : std::string(palette::fixed);
    svg.polygon({view.ring(polygons[i])}, fill, {palette::edge, 0.5});
  }
  for (std::size_t i = 0; i < polygons.size() && i < start.size(); ++i) {
    if (moved[i] * view.units_per_metre() > 2)
      svg.polygon({view.ring(start[i])}, "none", {palette::faint, 0.5, "3 3"});
  }
  view.draw_scale(svg);
  const std::string words =
      farthest > 0 ? fmt::format("{}; moved by up to {:.4g} m (yellow)", title, farthest) : title;
  svg.text({picture_width / 2, view.height() + 12}, words, Svg::Anchor::middle);
  return svg.done();
}

void draw_states(const Results& run, Figures& figures) {
  const std::vector<ListedFrame> frames = listed_frames(run.folder);
  if (frames.empty()) return;
  const Grid first = read_grid(frames.front().bodies);
  const auto title = [&](const ListedFrame& frame) {
    return fmt::format("{} t = {:.6g} s", run.name, frame.time);
  };
  figures.add("first_state" + suffix(run), state_svg(title(frames.front()), first, first));
  figures.add("last_state" + suffix(run),
              state_svg(title(frames.back()), first, read_grid(frames.back().bodies)));
}

}  // namespace

std::vector<fs::path> write_figures(const fs::path& folder) {
  const std::vector<Results> runs = results_in(folder);
  Figures figures(folder / "figures");
  draw_monitors(runs, figures);
  draw_contacts(runs, figures);
  for (const Results& run : runs) {
    draw_energies(run, figures);
    draw_states(run, figures);
  }
  return figures.files();
}

}  // namespace talus
