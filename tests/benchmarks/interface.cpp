// The contacts of a step through the interface of the loaded library, against the same law and the loop that
// asks it compiled as one (fused_law/). Both get the same step of the sliding blocks, in turn.

#include "interface.hpp"

#include "fused_law/fused_law.hpp"
#include "scenes.hpp"

#include "simulation/simulation.hpp"

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <algorithm>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus::benchmarks {
namespace {

constexpr int rounds = 150, steps_of_round = 20;
constexpr double settled_after = 2e-3;  ///< s, as of the other measurements of these blocks

/// What a law is given in one step, copied.
class RecordedStep {
 public:
  /// Takes the batches of a step one after the other; the first one again means that the step is over.
  void take(const ContactBatch& batch, std::uint32_t doubles) {
    if (first_ == nullptr) first_ = batch.pairs;
    complete_ = complete_ || (!batches_.empty() && batch.pairs == first_);
    if (complete_ || batch.active_count == 0) return;
    doubles_ = doubles;
    batches_.push_back({batch,
                        {batch.pairs, batch.pairs + batch.active[batch.active_count - 1] + 1},
                        {batch.active, batch.active + batch.active_count}});
    copy_arrays(batches_.back());
  }

  bool complete() const { return complete_; }

  /// The calls, as long as this object stands still.
  std::vector<LawCall> calls() {
    corner_loads_.resize(loads_);
    std::vector<LawCall> result;
    for (Batch& each : batches_) {
      each.reports.resize(each.pairs.size());
      ContactBatch batch = each.as_given;
      batch.boundaries = {corners_.data(), piece_start_.data(), is_strip_.data(), clear_depth_.data(),
                          nullptr};
      batch.interfaces.row = rows_.data();
      batch.interfaces.value = values_.data();
      batch.pairs = each.pairs.data();
      batch.piece_pairs = {piece_pairs_.data(), first_piece_.data()};
      batch.history = each.history.data();
      batch.active = each.active.data();
      result.push_back(
          {batch, {corner_loads_.data(), each.next_history.data(), nullptr, each.reports.data()}});
    }
    return result;
  }

  /// All that a law has written.
  std::vector<double> written() const {
    std::vector<double> all;
    for (const CornerLoad& load : corner_loads_) all.insert(all.end(), {load.x, load.y});
    for (const Batch& each : batches_)
      all.insert(all.end(), each.next_history.begin(), each.next_history.end());
    return all;
  }

  std::size_t active_pairs() const {
    std::size_t count = 0;
    for (const Batch& batch : batches_) count += batch.active.size();
    return count;
  }

 private:
  struct Batch {
    ContactBatch as_given;
    std::vector<BodyPair> pairs;
    std::vector<std::uint32_t> active;
    std::vector<PairReport> reports{};
    std::vector<double> history{}, next_history{};
  };

  template <class T>
  static void copy_up_to(std::vector<T>& to, const T* from, std::size_t count) {
    if (count > to.size()) to.assign(from, from + count);
  }

  /// The parts of the host's arrays that the pairs of a batch lead to.
  void copy_arrays(Batch& batch) {
    const Boundaries& shown = batch.as_given.boundaries;
    const Interfaces& interfaces = batch.as_given.interfaces;
    std::size_t bodies = 0, pieces = 0, piece_pairs = 0, slots = 0;
    for (const std::uint32_t i : batch.active) {
      const BodyPair& pair = batch.pairs[i];
      bodies = std::max<std::size_t>({bodies, pair.a + 1, pair.b + 1});
      if (!pair.plain()) piece_pairs = std::max<std::size_t>(piece_pairs, pair.piece_pair_range[1]);
      slots = std::max<std::size_t>(slots, pair.slot_start + pair.slot_capacity);
      for (const PiecePair met : batch.as_given.piece_pairs.of(pair)) {
        pieces = std::max<std::size_t>({pieces, met.a + 1, met.b + 1});
        const auto corners = [&](std::uint32_t piece) {
          return shown.piece_start[piece + 1] - shown.piece_start[piece];
        };
        loads_ = std::max<std::size_t>(loads_, met.load_start + corners(met.a) + corners(met.b));
      }
    }
    copy_up_to(piece_pairs_, batch.as_given.piece_pairs.listed, piece_pairs);
    copy_up_to(first_piece_, batch.as_given.piece_pairs.first_piece, bodies);
    copy_up_to(piece_start_, shown.piece_start, pieces + 1);
    copy_up_to(corners_, shown.corner, shown.piece_start[pieces]);
    copy_up_to(is_strip_, shown.is_strip, pieces);
    copy_up_to(clear_depth_, shown.clear_depth, pieces);
    batch.history.assign(batch.as_given.history, batch.as_given.history + slots * doubles_);
    batch.next_history.resize(slots * doubles_);
    const std::size_t surfaces = interfaces.surface_count;
    copy_up_to(rows_, interfaces.row, surfaces * surfaces);
    const std::size_t last_row = *std::max_element(rows_.begin(), rows_.end());
    copy_up_to(values_, interfaces.value, (last_row + 1) * interfaces.parameter_count);
  }

  const BodyPair* first_ = nullptr;
  bool complete_ = false;
  std::uint32_t doubles_ = 0;
  std::size_t loads_ = 0;
  std::vector<Batch> batches_;
  std::vector<BoundaryCorner> corners_;
  std::vector<PiecePair> piece_pairs_;
  std::vector<std::uint32_t> first_piece_;
  std::vector<std::uint32_t> piece_start_, rows_;
  std::vector<std::uint8_t> is_strip_;
  std::vector<double> clear_depth_, values_;
  std::vector<CornerLoad> corner_loads_;
};

RecordedStep* recorder = nullptr;                   ///< where the law under way is recorded
const RegisteredComponent* recorded_law = nullptr;  ///< the loaded one

/// The loaded law, and a copy of what it is given while there is a recorder.
class RecordedLaw final : public ContactModel {
 public:
  explicit RecordedLaw(const double* values) : law_(make<ContactModel>(*recorded_law, {values, 1})) {}

  std::uint32_t doubles_per_contact() const noexcept override { return law_->doubles_per_contact(); }
  void prepare_interface(double* values) const noexcept override { law_->prepare_interface(values); }
  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    if (recorder != nullptr) recorder->take(batch, doubles_per_contact());
    law_->evaluate(batch, loads);
  }
  ContactStiffness stiffness(const double* values, double length) const noexcept override {
    return law_->stiffness(values, length);
  }

 private:
  Made<ContactModel> law_;
};

/// A step of the scene, after the warm-up.
RecordedStep record(Scene scene) {
  recorded_law = scene.contact.component;
  Component component = *recorded_law->component;
  component.create = create_component<ContactModel, RecordedLaw>;
  component.destroy = destroy_component<ContactModel>;
  const RegisteredComponent registered{&component, recorded_law->library, recorded_law->file};
  scene.contact.component = &registered;
  Simulation simulation(scene, {});
  while (simulation.time() < settled_after) simulation.advance();
  RecordedStep step;
  recorder = &step;
  simulation.advance();
  recorder = nullptr;
  if (!step.complete()) throw std::runtime_error("no whole step was recorded");
  return step;
}

/// The two ways to ask, from the library that was built for the level of the scene.
struct FusedLibrary {
  explicit FusedLibrary(SimdLevel level) {
    const std::string file = fmt::format("{}/{}/libfused_law.so", TALUS_FUSED_LAW, name_of(level));
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    ask_law = reinterpret_cast<ContactsOfStep>(dlsym(library, through_interface));
    ask_fused = reinterpret_cast<ContactsOfStep>(dlsym(library, fused));
  }
  ContactsOfStep ask_law, ask_fused;
};

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Task>
double seconds_of(const Task& task) {
  const double before = thread_seconds();
  task();
  return thread_seconds() - before;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void measure(benchmark::State& state, const Load& load) {
  Scene scene = scene_of(load);
  scene.time.dt = Simulation(scene, {}).automatic_dt();
  scene.output.history = steps_of_round * *scene.time.dt;
  RecordedStep step = record(scene);
  const std::vector<LawCall> calls = step.calls();
  const Made<ContactModel> law = make<ContactModel>(*scene.contact.component, scene.contact.values);
  const FusedLibrary library(scene.simd);
  const auto ask = [&](ContactsOfStep way) {
    benchmark::DoNotOptimize(way(*law, calls.data(), calls.size()));
  };
  ask(library.ask_law);
  const std::vector<double> due = step.written();
  ask(library.ask_fused);
  if (step.written() != due) state.SkipWithError("the two do not give the same bits");

  Simulation simulation(scene, {});
  while (simulation.time() < settled_after) simulation.advance();
  std::vector<double> ratios, shares, interface_times, fused_times, step_times;
  for (auto round : state) {
    (void)round;
    double through = 0, at_once = 0;
    for (int i = 0; i < steps_of_round; ++i) {
      through += seconds_of([&] { ask(library.ask_law); });
      at_once += seconds_of([&] { ask(library.ask_fused); });
    }
    const double whole = seconds_of([&] { simulation.advance(); });
    ratios.push_back(through / at_once);
    shares.push_back((through - at_once) / whole);
    interface_times.push_back(through);
    fused_times.push_back(at_once);
    step_times.push_back(whole);
    state.SetIterationTime(through + at_once + whole);
  }
  const auto microseconds = [](const std::vector<double>& times) {
    return median(times) / steps_of_round * 1e6;
  };
  state.counters["active_pairs"] = static_cast<double>(step.active_pairs());
  state.counters["interface_us_per_step"] = microseconds(interface_times);
  state.counters["fused_us_per_step"] = microseconds(fused_times);
  state.counters["step_us"] = microseconds(step_times);
  state.counters["interface_over_fused"] = median(ratios);
  state.counters["share_of_step"] = median(shares);
}

}  // namespace

void register_interface() {
  for (const char* roles : {"symmetric", "priority"}) {
    const Load load{fmt::format("sliding.py --blocks 504 --cover block --roles {}", roles), "overlap_area",
                    false};
    benchmark::RegisterBenchmark(fmt::format("interface/sliding/504/block/{}", roles).c_str(),
                                 [load](benchmark::State& state) { measure(state, load); })
        ->Iterations(rounds)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace talus::benchmarks
