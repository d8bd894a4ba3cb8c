#include "conformance/differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace talus::conformance {
namespace {

bool same_number(double p, double q) {
  return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q);
}

/// First difference between what two calls say of pair i, in words.
std::optional<std::string> difference_of_pair(const GivenBatch& batch, std::size_t i, const TakenLoads& p,
                                              const TakenLoads& q, const Compared& compared) {
  std::optional<std::string> found;
  const auto compare = [&](const std::string& what, double here, double there) {
    if (!found && !same_number(here, there))
      found = fmt::format("{} of pair {}: {:.17g} and {:.17g}", what, i, here, there);
  };
  const PairReport &one = p.pairs[i], &other = q.pairs[i];
  compare("contact_count", one.contact_count, other.contact_count);
  compare("penetration", one.penetration, other.penetration);
  compare("stored", one.stored, other.stored);
  compare("slip_loss", one.slip_loss, other.slip_loss);
  compare("damping_power", one.damping_power, other.damping_power);
  if (one.contact_count != 0) compare("damping_force", one.damping_force, other.damping_force);
  compare("gap", one.gap, other.gap);
  if (found || one.contact_count == 0) return found;
  const BodyPair& pair = batch.pairs[i];
  const PiecePairs all = batch.all_piece_pairs();
  for (const PiecePair pieces : all.of(pair)) {
    for (std::uint32_t c = 0; c < batch.corners_of(pieces); ++c) {
      const CornerLoad &here = p.corner[pieces.load_start + c], &there = q.corner[pieces.load_start + c];
      compare("load x", here.x, there.x);
      compare("load y", here.y, there.y);
    }
  }
  const std::uint32_t kept = std::min(one.contact_count, pair.slot_capacity);
  for (std::uint32_t c = 0; c < kept; ++c) {
    for (std::uint32_t k = 0; compared.history && k < batch.doubles_per_contact; ++k) {
      const std::size_t at = std::size_t{pair.slot_start + c} * batch.doubles_per_contact + k;
      compare("history", p.history[at], q.history[at]);
    }
    if (!compared.reports) continue;
    const ContactReport &here = p.reports[pair.slot_start + c], &there = q.reports[pair.slot_start + c];
    compare("report px", here.px, there.px);
    compare("report tx", here.tx, there.tx);
  }
  return found;
}

}  // namespace

std::optional<std::string> difference_of(const GivenBatch& batch, const TakenLoads& p, const TakenLoads& q,
                                         const Compared& compared) {
  for (const std::uint32_t i : batch.active) {
    if (auto found = difference_of_pair(batch, i, p, q, compared)) return found;
  }
  return std::nullopt;
}

std::optional<std::string> difference_of(const Evaluation& p, const Evaluation& q, const Compared& compared) {
  std::optional<std::string> found;
  const auto compare = [&](const std::string& what, double here, double there) {
    if (!found && !same_number(here, there))
      found = fmt::format("{}: {:.17g} and {:.17g}", what, here, there);
  };
  compare("contacts", static_cast<double>(p.contacts.size()), static_cast<double>(q.contacts.size()));
  if (compared.history)
    compare("doubles of history", static_cast<double>(p.history.size()),
            static_cast<double>(q.history.size()));
  for (std::size_t i = 0; i < p.forces.size() && !found; ++i) {
    compare(fmt::format("force x on body {}", i), p.forces[i].force.x, q.forces[i].force.x);
    compare(fmt::format("force y on body {}", i), p.forces[i].force.y, q.forces[i].force.y);
    const auto moment = [&](const Evaluation& of) {
      return of.moment_on(static_cast<std::uint32_t>(i), {0, 0});
    };
    compare(fmt::format("moment on body {}", i), moment(p), moment(q));
  }
  for (std::size_t i = 0; i < p.pairs.size() && !found; ++i) {
    compare(fmt::format("stored energy of pair {}", i), p.pairs[i].stored, q.pairs[i].stored);
    compare(fmt::format("slip loss of pair {}", i), p.pairs[i].slip_loss, q.pairs[i].slip_loss);
    compare(fmt::format("damping of pair {}", i), p.pairs[i].damping_power, q.pairs[i].damping_power);
  }
  for (std::size_t i = 0; i < p.contacts.size() && !found; ++i) {
    const ContactReport &here = p.contacts[i], &there = q.contacts[i];
    compare(fmt::format("normal force x of contact {}", i), here.px, there.px);
    compare(fmt::format("normal force y of contact {}", i), here.py, there.py);
    compare(fmt::format("tangential force x of contact {}", i), here.tx, there.tx);
    compare(fmt::format("tangential force y of contact {}", i), here.ty, there.ty);
  }
  for (std::size_t i = 0; compared.history && i < p.history.size() && !found; ++i)
    compare(fmt::format("history {}", i), p.history[i], q.history[i]);
  return found;
}

}  // namespace talus::conformance
