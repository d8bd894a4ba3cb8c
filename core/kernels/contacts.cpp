#include "kernels/contacts.hpp"

#include <talus/simd/pack.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace talus::kernels::TALUS_KERNEL_LEVEL {
namespace {

/// See Quad of quads.hpp.
using Row [[gnu::vector_size(32)]] = double;

inline void load_row(const double* from, Row& to) {
  std::memcpy(&to, from, sizeof to);
}
inline void copy_row(const double* from, double* to) {
  Row row;
  load_row(from, row);
  std::memcpy(to, &row, sizeof row);
}

/// By full rows, of which the last may lie over the one before; so there are four or more.
inline void copy(const double* from, std::size_t count, double* to) {
  copy_row(from, to);
  if (count > 8) {
    copy_row(from + 4, to + 4);
    for (std::size_t i = 8; i + 4 < count; i += 4) copy_row(from + i, to + i);
  }
  copy_row(from + count - 4, to + count - 4);
}
inline void copy_few(const double* from, std::size_t count, double* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
}

// What a report says in numbers is a row: penetration, stored, slip_loss, damping_power.
static_assert(offsetof(PairReport, damping_power) - offsetof(PairReport, penetration) == 3 * sizeof(double));

/// A pair without contact, or one that is short of slots.
inline void close_other(const PairBooks& books, std::uint32_t i, Row& sum, double& carried_on,
                        ClosedChunk& closed) {
  BodyPair& pair = books.pairs[i];
  const PairReport& report = books.reports[i];
  if (report.contact_count != 0) {
    closed.short_of_room.add(i);
    return;
  }
  Row row;
  load_row(&report.penetration, row);
  sum += row;
  if (std::isnan(report.gap)) closed.finite = false;
  if (pair.contact_count != 0) {
    closed.parted.add(i);
    carried_on += books.dashpots[pair.slot_start].power;  // nothing pushed, so it moved on as before
  }
  pair.contact_count = 0;
  books.approach[i] = at_least(books.drift[pair.a].approach(books.drift[pair.b]));
  books.ask_again[i] =
      books.skin ? at_most(books.way.of(books.approach[i]) + report.gap - books.rounding) : 0;
}

template <bool few>
void close_all(const PairBooks& given, const std::uint32_t* active, std::size_t count, ContactTotals& totals,
               ClosedChunk& closed) {
  const PairBooks books = given;  // which no store below can change
  Row touching{}, other{};
  double penetration = totals.penetration;
  double carried_on = 0;  // J/m, what dashpots push with at t_{n-1} times displacement since then
  for (const std::uint32_t *at = active, *const end = active + count; at != end; ++at) {
    const std::size_t i = *at;
    BodyPair& pair = books.pairs[i];
    const PairReport& report = books.reports[i];
    const std::uint32_t contacts = report.contact_count;
    if (contacts - 1 >= pair.slot_capacity) {  // 0 − 1 is the largest of all numbers
      close_other(books, *at, other, carried_on, closed);
      continue;
    }
    Row row;
    load_row(&report.penetration, row);
    touching += row;
    if (!(report.penetration <= penetration)) {
      penetration = report.penetration;
      totals.deepest_a = pair.a;
      totals.deepest_b = pair.b;
    }
    FormerDashpots& former = books.dashpots[pair.slot_start];
    if (pair.contact_count == 0) {
      closed.met.add(*at);
      former = {};
    }
    pair.contact_count = contacts;
    const double power = report.damping_power;
    FormerDashpots now;
    // At the start of a run without power, for nothing has moved yet. What is no number goes on as such.
    if (!(report.damping_force <= 0)) {
      now = {static_cast<float>(power), report.damping_force};
      carried_on += former.force * (power / now.force);
    }
    former = now;
    books.ask_again[i] = 0;
    const std::size_t start = std::size_t{pair.slot_start} * books.history_doubles,
                      doubles = std::size_t{contacts} * books.history_doubles;
    if constexpr (few) {
      copy_few(books.found + start, doubles, books.history + start);
    } else {
      copy(books.found + start, doubles, books.history + start);
    }
  }
  const Row all = touching + other;
  closed.finite = closed.finite && std::isfinite((all[0] + all[1]) + (all[2] + all[3]) + carried_on);
  totals.penetration = penetration;
  totals.stored += all[1];
  totals.slip_loss += all[2];
  // Work of the dashpots between t_{n-1} and t_n by the trapezoid rule, as that of springs is. At both ends
  // they are moved by the same, but a dashpot that may not pull gives way from one to the other.
  totals.damping_loss += (touching[3] + carried_on) / 2;
}

void close(const PairBooks& books, const std::uint32_t* active, std::size_t count, ContactTotals& totals,
           ClosedChunk& closed) {
  const bool few = books.history_doubles < 4;
  (few ? close_all<true> : close_all<false>)(books, active, count, totals, closed);
}

using Places [[gnu::vector_size(16)]] = std::uint32_t;

/// [lanes, one bit each] the lanes that are set, in front.
struct SetLanes {
  std::uint32_t of[16][4] = {};

  constexpr SetLanes() {
    for (unsigned set = 0; set < 16; ++set) {
      unsigned found = 0;
      for (unsigned lane = 0; lane < 4; ++lane) {
        if ((set >> lane & 1) != 0) of[set][found++] = lane;
      }
    }
  }
};
constexpr SetLanes set_lanes;

std::uint32_t choose(const float* ask_again, const float* approach, std::uint32_t count, const Way& now,
                     std::uint32_t* chosen) {
  std::size_t i = 0;
  std::uint32_t* next = chosen;
  // By four, never past the last place: no more are chosen than were looked at.
  if constexpr (simd::lanes > 1) {
    const simd::Pack time = now.time, strayed = now.strayed, travelled = now.travelled;
    Places first{};
    for (; i + simd::lanes <= count; i += simd::lanes) {
      const simd::Pack way = simd::min(simd::load(approach + i) * time + strayed, travelled);
      auto due = static_cast<std::size_t>(simd::bits(simd::load(ask_again + i) <= way));
      for (int four = 0; four < simd::lanes; four += 4, due >>= 4) {
        const std::size_t set = simd::lanes == 4 ? due : due & 15;
        Places places;
        std::memcpy(&places, set_lanes.of[set], sizeof places);
        places += first;
        std::memcpy(next, &places, sizeof places);
        next += std::popcount(set);
        first += 4;
      }
    }
  }
  for (; i < count; ++i) {
    *next = static_cast<std::uint32_t>(i);
    next += ask_again[i] <= now.of(approach[i]) ? 1 : 0;
  }
  return static_cast<std::uint32_t>(next - chosen);
}

}  // namespace

extern const ContactKernels contact_kernels;
const ContactKernels contact_kernels{choose, close};

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
