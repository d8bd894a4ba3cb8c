#include "apps/program.hpp"
#include "output/scratch.hpp"
#include "plugin/registry.hpp"
#include "scene/read.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <link.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <string>

using namespace talus;
namespace fs = std::filesystem;

namespace {

/// The files of the libraries in this process that lie in a folder.
std::set<std::string> loaded_from(const fs::path& folder) {
  struct Search {
    fs::path folder;
    std::set<std::string> found;
  } search{fs::canonical(folder), {}};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        auto& here = *static_cast<Search*>(data);
        const fs::path file(info->dlpi_name);
        if (file.parent_path() == here.folder) here.found.insert(file.filename().string());
        return 0;
      },
      &search);
  return search.found;
}

/// Libraries of its own for a process that has loaded all of them elsewhere.
void copy_plugins(const Scratch& scratch) {
  for (const char* name : {"overlap_area", "vertex_edge", "block", "rigid", "linear_elastic"}) {
    const std::string file = "lib" + std::string(name) + ".so";
    fs::copy_file(fs::path(TALUS_PLUGINS) / file, scratch / file);
  }
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

std::size_t threads_of_this_process() {
  const fs::directory_iterator tasks("/proc/self/task");
  return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

}  // namespace

TEST_CASE("A library that a scene does not name is not loaded", "[costs][plugin]") {
  const Scratch scratch;
  copy_plugins(scratch);
  Registry registry;
  registry.simd = SimdLevel::scalar;
  offer_folders(registry, std::array{fs::canonical(scratch.folder())});
  CHECK(registry.refused.empty());
  CHECK(registry.offered.size() == 5);
  CHECK(loaded_from(scratch.folder()).empty());

  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1) + "," + box("b", 2, 0, 3, 1);
  const Scene scene = text.read(registry);
  CHECK(loaded_from(scratch.folder()) ==
        std::set<std::string>{"liblinear_elastic.so", "liboverlap_area.so", "librigid.so"});
  CHECK(scene.contact.component == registry.find(ComponentKind::contact_model, "overlap_area"));
}

TEST_CASE("A scene without contact or deformation loads no law and no material", "[costs][plugin]") {
  const Scratch scratch;
  copy_plugins(scratch);
  Registry registry;
  registry.simd = SimdLevel::scalar;
  offer_folders(registry, std::array{fs::canonical(scratch.folder())});
  read_scene_text(R"({"talus": 1, "materials": {"rock": {"density": 1}}, "cover": {"model": "rigid"},
                      "bodies": [{"name": "a", "material": "rock", "polygon": [[0, 0], [1, 0], [0, 1]]}],
                      "time": {"end": 1}})",
                  "free.json", registry);
  CHECK(loaded_from(scratch.folder()) == std::set<std::string>{"librigid.so"});
}

TEST_CASE("A run writes what the scene asks for and nothing else", "[costs][apps]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const std::set<std::string> always{"energy.csv", "history.csv", "resolved.json", "run.json"};
  const auto files_of = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", "small.json", "--quiet", "--overwrite", "--out", "out"});
    const Call call = call_talus(scratch.folder(), words);
    INFO(call.err);
    CHECK(call.code == 0);
    return files_in(scratch / "out");
  };
  CHECK(files_of({"--no-report", "--set", "/output/frames=null"}) == always);
  CHECK(files_of({"--no-report", "--set", "/output/frames=null", "--set", "/monitors=[]"}) == always);
  std::set<std::string> with_page = always;
  with_page.insert("report.html");
  CHECK(files_of({"--set", "/output/frames=null"}) == with_page);
  CHECK(files_of({"--no-report", "--set", "/output/frames=0.05"}).contains("frames.pvd"));
}

TEST_CASE("One thread is the one that is there", "[costs]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1);
  const std::size_t before = threads_of_this_process();
  {
    const Simulation alone(text.read(), {});
    CHECK(threads_of_this_process() == before);
    RunSettings two;
    two.threads = 2;
    const Simulation shared(text.read(), two);
    CHECK(threads_of_this_process() == before + 1);
  }
  CHECK(threads_of_this_process() == before);
}
