#pragma once

#include "contact/room.hpp"
#include "kernels/contacts.hpp"

#include <talus/contact_model.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// What is kept of contacts from step to step. Each batch of pairs has its slots side by side, and at their
/// end some that wait for pairs which meet: of the pairs that are near each other most are apart, and a slot
/// takes more memory than all else about a pair. In a pile at rest nearly all have theirs, and none waits.
class ContactSlots {
 public:
  /// What is kept: as many doubles of a contact as its law asks for, and whether reports are.
  void keep(std::uint32_t doubles_per_contact, bool reports) {
    doubles_ = doubles_per_contact;
    keeps_reports_ = reports;
  }
  bool keeps_reports() const { return keeps_reports_; }

  /// Closes up all contacts, pair after pair: BodyPair::slot_start counts from the first of all, until the
  /// next lay_out().
  void close_up(std::span<BodyPair> pairs, std::span<const std::uint32_t> batch_begin);

  /// Gives the pairs the slots that their capacities ask for, and moves contacts there from where close_up()
  /// left them.
  void lay_out(std::span<BodyPair> pairs, std::span<const std::uint32_t> batch_begin);

  /// Lets so many slots wait in each batch [batch], at least.
  void widen(std::span<const std::uint32_t> wanted);
  /// Gives a pair of a batch slots that wait, and moves its contacts there.
  void give(BodyPair& pair, std::size_t batch, std::uint32_t capacity);

  /// Number of the first slot of a batch, which BodyPair::slot_start counts from.
  std::size_t first_of(std::size_t batch) const { return base_[batch]; }
  /// Slots of a batch, at most.
  std::size_t most() const { return most_; }

  std::uint32_t doubles() const { return doubles_; }
  double* history(std::size_t slot) { return history_.data() + slot * doubles_; }
  const double* history(std::size_t slot) const { return history_.data() + slot * doubles_; }
  /// Of the last step that was observed.
  ContactReport* reports(std::size_t slot) { return reports_.data() + slot; }
  const ContactReport* reports(std::size_t slot) const { return reports_.data() + slot; }
  /// Of the last step, at the first slot of a pair.
  kernels::FormerDashpots* dashpots(std::size_t slot) { return dashpots_.data() + slot; }

  /// What stands in all slots, while they are closed up.
  template <class Archive>
  void exchange(Archive& archive) {
    archive(history_);
    archive(reports_);
    archive(dashpots_);
  }
  /// Whether there are slots for so many contacts, and nothing else.
  bool hold(std::size_t contacts) const {
    return history_.size() == contacts * doubles_ && (reports_.size() == contacts || reports_.empty()) &&
           dashpots_.size() == contacts;
  }
  /// Of so many contacts, while they are closed up and may come from where others were kept.
  void fit_reports(std::size_t contacts) { reports_.resize(keeps_reports_ ? contacts : 0); }

 private:
  /// Calls each(values, values per slot) for all that is kept.
  template <class Each>
  void over_all(const Each& each) {
    each(history_, doubles_);
    if (keeps_reports_) each(reports_, 1);
    each(dashpots_, 1);
  }

  /// To a place that is no earlier, or far away.
  template <class Values>
  static void move(Values& values, std::size_t per_slot, std::size_t from, std::size_t count, std::size_t to);

  std::uint32_t doubles_ = 0;
  bool keeps_reports_ = true;
  std::vector<std::size_t> base_{0};         ///< [batch + 1]
  std::vector<std::size_t> former_base_{0};  ///< while slots are moved
  std::vector<std::uint32_t> taken_;         ///< [batch] of its slots; the others wait
  std::vector<std::uint32_t> without_;       ///< [batch] pairs that have had none
  std::size_t most_ = 0;
  InLines<double> history_;
  std::vector<ContactReport> reports_;
  std::vector<kernels::FormerDashpots> dashpots_;
  std::vector<unsigned char> aside_;  ///< of a batch, while its contacts are put in their order
};

}  // namespace talus
