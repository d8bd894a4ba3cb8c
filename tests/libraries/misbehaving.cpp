// Laws that load and run, and then do what no law may do with the loads.
#include "descriptor.hpp"

#include <limits>
#include <stdexcept>

namespace {

enum class Slip {
  nan_load,
  nan_report,
  nan_contact,
  nan_dashpot,
  past_the_end,
  one_sided,
  couple,
  debt,
  throws
};

[[gnu::noinline]] void throw_up() {
  throw std::runtime_error("no such pair");
}

/// Says of every pair that it touches, without a load but for one slip.
template <Slip slip>
class Misbehaving : public SilentLaw {
 public:
  using SilentLaw::SilentLaw;

  void evaluate(const talus::ContactBatch& batch, const talus::ContactLoads& loads) const noexcept override {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    if (slip == Slip::throws) throw_up();
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const talus::BodyPair& pair = batch.pairs[batch.active[k]];
      talus::PairReport& report = loads.pairs[batch.active[k]];
      report = {};
      report.contact_count = 1;
      const talus::PiecePair pieces = batch.piece_pairs.at(pair, 0);
      const std::uint32_t* start = batch.boundaries.piece_start;
      const std::uint32_t of_b = pieces.load_start + start[pieces.a + 1] - start[pieces.a];
      const std::uint32_t end = of_b + start[pieces.b + 1] - start[pieces.b];
      for (std::uint32_t load = pieces.load_start; load < end; ++load) loads.corner[load] = {0, 0};
      if (slip == Slip::nan_load) loads.corner[of_b].y = not_a_number;
      if (slip == Slip::nan_report) report.stored = not_a_number;
      if (slip == Slip::debt) report.stored = -1;
      if (slip == Slip::nan_dashpot) report.damping_force = std::numeric_limits<float>::quiet_NaN();
      if (slip == Slip::nan_contact && pair.slot_capacity > 0)
        loads.reports[pair.slot_start].px = not_a_number;
      if (slip == Slip::past_the_end) loads.corner[end].x = 0;
      if (slip == Slip::one_sided) loads.corner[of_b].y = 1;
      if (slip == Slip::couple) loads.corner[of_b].x = 1, loads.corner[of_b + 2].x = -1;
    }
  }
};

/// Silent, and what it makes of its one parameter is no number.
class Unprepared : public SilentLaw {
 public:
  using SilentLaw::SilentLaw;
  void prepare_interface(double* values) const noexcept override {
    values[0] = std::numeric_limits<double>::quiet_NaN();
  }
};

constexpr talus::Parameter strength[] = {
    talus::number("strength", "Pa", 1, 0, talus::unbounded, "What it prepares.")};

constexpr talus::Component unprepared() {
  talus::Component component = law<Unprepared>("nan_interface");
  component.interface_parameters = strength;
  component.interface_parameter_count = 1;
  return component;
}

constexpr talus::Component components[] = {law<Misbehaving<Slip::nan_contact>>("nan_contact"),
                                           law<Misbehaving<Slip::nan_dashpot>>("nan_dashpot"),
                                           unprepared(),
                                           law<Misbehaving<Slip::nan_load>>("nan_load"),
                                           law<Misbehaving<Slip::nan_report>>("nan_report"),
                                           law<Misbehaving<Slip::past_the_end>>("past_the_end"),
                                           law<Misbehaving<Slip::one_sided>>("one_sided"),
                                           law<Misbehaving<Slip::couple>>("couple"),
                                           law<Misbehaving<Slip::debt>>("debt"),
                                           law<Misbehaving<Slip::throws>>("throws")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 10);
