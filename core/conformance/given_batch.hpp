#pragma once

#include "conformance/guarded.hpp"

#include <talus/contact_model.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace talus::conformance {

/// All that a call gives to a law, between guard zones.
struct GivenBatch {
  Guarded<BoundaryCorner> corners;
  Guarded<std::uint32_t> piece_start;
  Guarded<std::uint8_t> is_strip;
  Guarded<double> clear_depth;
  Guarded<double> straight_beyond;
  Guarded<std::uint32_t> row;
  Guarded<double> values;
  std::uint32_t surface_count = 1, parameter_count = 0;
  Guarded<BodyPair> pairs;
  Guarded<PiecePair> piece_pairs;
  Guarded<std::uint32_t> first_piece;
  Guarded<double> history;
  Guarded<std::uint32_t> active;
  double dt = 1e-4;
  bool hold_stick = false, bonds_form = false;
  std::uint32_t load_count = 0, slot_count = 0, doubles_per_contact = 0;
  BatchPlan* plan = nullptr;
  std::uint64_t layout = 0;

  ContactBatch view() const;
  PiecePairs all_piece_pairs() const { return {piece_pairs.data(), first_piece.data()}; }
  void surround(unsigned char value);
  /// Name of the first array in which a byte differs, guard zones included.
  std::optional<std::string> differs_from(const GivenBatch& other) const;
  /// Corners of a pair's pieces: its entries in the loads.
  std::uint32_t corners_of(const PiecePair& pieces) const;
};

/// All that a law fills in.
struct TakenLoads {
  Guarded<CornerLoad> corner;
  Guarded<double> history;
  Guarded<ContactReport> reports;
  Guarded<PairReport> pairs;

  /// Room for a batch; every byte, guard zones included, has one value.
  TakenLoads(const GivenBatch& batch, unsigned char value);
  ContactLoads view(bool with_reports = true);
};

}  // namespace talus::conformance
