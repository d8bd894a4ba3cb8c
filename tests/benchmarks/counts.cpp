#include "counts.hpp"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace talus::benchmarks {
namespace {

constexpr double margin_share = 0.05;  ///< of the mean size of a moving block

struct Box {
  double low_x, low_y, high_x, high_y;
  bool moves;
};

Box box_of(const Simulation& simulation, std::size_t body) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{far, far, -far, -far, !simulation.scene().bodies[body].fixed};
  for (const BodyPart& part : simulation.parts(body)) {
    for (const PartPoint& point : part.loops.at(0)) {
      box.low_x = std::min(box.low_x, point.position.x);
      box.low_y = std::min(box.low_y, point.position.y);
      box.high_x = std::max(box.high_x, point.position.x);
      box.high_y = std::max(box.high_y, point.position.y);
    }
  }
  return box;
}

/// Square root of the mean area of the moving bodies' outlines at the start, m.
double mean_size(const Scene& scene) {
  double area = 0;
  std::size_t moving = 0;
  for (const SceneBody& body : scene.bodies) {
    if (body.fixed) continue;
    const std::vector<Vec2>& ring = body.outer.vertices;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      area += (a.x * b.y - a.y * b.x) / 2;
    }
    ++moving;
  }
  return moving > 0 ? std::sqrt(area / static_cast<double>(moving)) : 0;
}

/// A sweep along x; boxes must be sorted by their left ends.
std::size_t meeting_boxes(const std::vector<Box>& boxes) {
  std::size_t meeting = 0;
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    std::erase_if(active, [&](std::size_t j) { return boxes[j].high_x < box.low_x; });
    for (const std::size_t j : active) {
      const bool meet = boxes[j].low_y <= box.high_y && box.low_y <= boxes[j].high_y;
      meeting += meet && (box.moves || boxes[j].moves) ? 1 : 0;
    }
    active.push_back(i);
  }
  return meeting;
}

std::size_t status_entry(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kilobytes = 0;
    if (word == key && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

}  // namespace

PairCounts count_pairs(const Simulation& simulation) {
  PairCounts counts;
  counts.overlapping = simulation.touching_pair_count();

  const double margin = margin_share * mean_size(simulation.scene());
  std::vector<Box> boxes;
  for (std::size_t body = 0; body < simulation.body_count(); ++body) {
    const Box box = box_of(simulation, body);
    boxes.push_back(
        {box.low_x - margin, box.low_y - margin, box.high_x + margin, box.high_y + margin, box.moves});
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.low_x < b.low_x; });
  counts.candidates = meeting_boxes(boxes);
  return counts;
}

double mean_speed(const Simulation& simulation) {
  double sum = 0;
  for (std::size_t body = 0; body < simulation.body_count(); ++body) {
    if (simulation.scene().bodies[body].fixed) continue;
    const Vec2 velocity = simulation.body_motion(body).velocity;
    sum += std::hypot(velocity.x, velocity.y);
  }
  return sum / static_cast<double>(simulation.block_count());
}

std::size_t resident_memory() {
  return status_entry("VmRSS:");
}

std::size_t peak_memory() {
  return status_entry("VmHWM:");
}

void forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace talus::benchmarks
