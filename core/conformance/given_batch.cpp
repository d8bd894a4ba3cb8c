#include "conformance/given_batch.hpp"

namespace talus::conformance {
namespace {

/// `visit(name, array of one, array of the other)` for all arrays.
template <class Batch, class Visit>
void each_array(Batch& p, const GivenBatch& q, const Visit& visit) {
  visit("boundaries.corner", p.corners, q.corners);
  visit("boundaries.piece_start", p.piece_start, q.piece_start);
  visit("boundaries.is_strip", p.is_strip, q.is_strip);
  visit("boundaries.clear_depth", p.clear_depth, q.clear_depth);
  visit("boundaries.straight_beyond", p.straight_beyond, q.straight_beyond);
  visit("interfaces.row", p.row, q.row);
  visit("interfaces.value", p.values, q.values);
  visit("pairs", p.pairs, q.pairs);
  visit("piece_pairs.listed", p.piece_pairs, q.piece_pairs);
  visit("piece_pairs.first_piece", p.first_piece, q.first_piece);
  visit("history", p.history, q.history);
  visit("active", p.active, q.active);
}

}  // namespace

ContactBatch GivenBatch::view() const {
  return {{corners.data(), piece_start.data(), is_strip.data(), clear_depth.data(),
           straight_beyond.size() > 0 ? straight_beyond.data() : nullptr},
          {row.data(), values.data(), surface_count, parameter_count},
          pairs.data(),
          all_piece_pairs(),
          history.data(),
          active.data(),
          static_cast<std::uint32_t>(active.size()),
          dt,
          hold_stick,
          bonds_form,
          plan,
          layout};
}

void GivenBatch::surround(unsigned char value) {
  each_array(*this, *this, [&](const char*, auto& array, const auto&) { array.surround(value); });
}

std::optional<std::string> GivenBatch::differs_from(const GivenBatch& other) const {
  std::optional<std::string> found;
  each_array(*this, other, [&](const char* name, const auto& mine, const auto& its) {
    if (!found && !mine.same_bytes(its)) found = name;
  });
  return found;
}

std::uint32_t GivenBatch::corners_of(const PiecePair& pieces) const {
  return piece_start[pieces.a + 1] - piece_start[pieces.a] + piece_start[pieces.b + 1] -
         piece_start[pieces.b];
}

TakenLoads::TakenLoads(const GivenBatch& batch, unsigned char value)
    : corner(batch.load_count, value),
      history(std::size_t{batch.slot_count} * batch.doubles_per_contact, value),
      reports(batch.slot_count, value),
      pairs(batch.pairs.size(), value) {
  corner.surround(value), history.surround(value), reports.surround(value), pairs.surround(value);
}

ContactLoads TakenLoads::view(bool with_reports) {
  return {corner.data(), history.data(), with_reports ? reports.data() : nullptr, pairs.data()};
}

}  // namespace talus::conformance
