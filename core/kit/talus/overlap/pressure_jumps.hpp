#pragma once

// Whether the pressure behind the sides of a pair goes by several stiffnesses.

#include <talus/overlap/pressure.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace talus::overlap {

/// Whether the pressure goes the same way with depth on two interfaces.
template <class Law>
bool same_pressure(const Law& law, const Interfaces& interfaces, std::uint32_t row, std::uint32_t other) {
  const auto stiffness = [&](std::uint32_t of) {
    return law.interface(interfaces.value + of * interfaces.parameter_count).normal_stiffness;
  };
  return row == other || (!HasOwnPressure<Law> && stiffness(row) == stiffness(other));
}

/// Calls visit(class of surface) for each stretch of one class around a piece.
template <class Visit>
void each_class(const Piece& piece, const Visit& visit) {
  std::uint32_t before = internal_side;
  for (std::uint32_t i = 0; i < piece.size(); ++i) {
    if (!piece.real(i) || piece.surface(i) == before) continue;
    before = piece.surface(i);
    visit(before);
  }
}

/// Whether it goes another way under some sides of the slave than under others, behind one of the master.
template <class Law>
bool jumps_under(const Law& law, const Interfaces& interfaces, const Piece& master, std::uint32_t side,
                 const Piece& slave) {
  std::optional<std::uint32_t> first;
  bool several = false;
  each_class(slave, [&](std::uint32_t of_slave) {
    const std::uint32_t row = interfaces.row[master.surface(side) * interfaces.surface_count + of_slave];
    several = several || !same_pressure(law, interfaces, first.value_or(row), row);
    if (!first) first = row;
  });
  return several;
}

/// Whether it does anywhere in a pair.
template <class Law>
bool jumps_anywhere(const Law& law, const Interfaces& interfaces, std::span<const Overlap> overlaps) {
  if (interfaces.surface_count == 1) return false;
  std::optional<std::uint32_t> first;
  bool several = false;
  for (const Overlap& overlap : overlaps) {
    each_class(overlap.piece[0], [&](std::uint32_t of_a) {
      each_class(overlap.piece[1], [&](std::uint32_t of_b) {
        const std::uint32_t row = interfaces.row[of_a * interfaces.surface_count + of_b];
        several = several || !same_pressure(law, interfaces, first.value_or(row), row);
        if (!first) first = row;
      });
    });
  }
  return several;
}

}  // namespace talus::overlap
