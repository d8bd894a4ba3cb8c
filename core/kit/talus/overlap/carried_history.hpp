#pragma once

#include <talus/overlap/friction.hpp>
#include <talus/overlap/grouping.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace talus::overlap {

inline FrictionHistory read_history(const double* from) {
  return {from[0], from[1], from[2], from[3], from[4], from[5], from[6], from[7]};
}

inline void write_history(const FrictionHistory& history, double* to) {
  to[0] = history.elastic, to[1] = history.applied, to[2] = history.stored, to[3] = history.contact_length;
  to[4] = history.x, to[5] = history.y, to[6] = history.slip, to[7] = history.strips;
}

/// What the contacts of a pair remember of the step before. Overlaps come, part and go, so which of then is
/// which of now is found by place, or by the strips that touch. One object serves one thread.
class CarriedHistory {
 public:
  /// Finds each old contact again among the new ones by place; where an overlap split, its spring force is
  /// shared by length; where overlaps merged, V adds up; where one ended, its stored energy is lost.
  void carry(const OverlapGroups& overlaps, const ContactBatch& batch, const BodyPair& pair,
             PairReport& report) {
    carried_.assign(report.contact_count, FrictionHistory{});
    name_strips(overlaps, report.contact_count);
    // A contact is where its overlap is: the foot of its load may lie far from there, on another side of a
    // corner, or where dashpots press.
    for (std::uint32_t g = 0; g < carried_.size(); ++g) {
      const Point centre = overlaps.centre(g);
      carried_[g].x = centre.x, carried_[g].y = centre.y;
    }
    if (pair.contact_count == 0) return;
    if (pair.plain() && report.contact_count == 1) {  // wherever it is: convex bodies have one contact
      add(1, read_history(batch.history + pair.slot_start * friction_doubles), carried_[0]);
      return;
    }
    old_.clear();
    for (std::uint32_t i = 0; i < pair.contact_count; ++i)
      old_.push_back(read_history(batch.history + (pair.slot_start + i) * friction_doubles));
    carry_to_same_strips();
    if (old_.empty()) return;
    spans_.clear();
    for (std::uint32_t g = 0; g < carried_.size(); ++g) spans_.push_back(overlaps.span(g, batch.dt));
    for (std::uint32_t i = 0; i < old_.size(); ++i) carry_by_place(i, report);
  }

  FrictionHistory& operator[](std::uint32_t group) { return carried_[group]; }

 private:
  void name_strips(const OverlapGroups& overlaps, std::uint32_t groups) {
    for (const Overlap& overlap : overlaps.overlaps()) {
      if (overlap.group >= groups || !(overlap.piece[0].is_strip() || overlap.piece[1].is_strip())) continue;
      const auto strip = [&](const Piece& piece) { return piece.is_strip() ? piece.first_corner() : 0; };
      carried_[overlap.group].strips = name_of_strips(strip(overlap.piece[0]), strip(overlap.piece[1]));
    }
  }

  void carry_by_place(std::uint32_t i, PairReport& report) {
    const FrictionHistory& old = old_[i];
    const auto size_of_takers = [&](bool bent) {
      double size = 0;
      for (std::uint32_t g = 0; g < spans_.size(); ++g) size += takes(g, i, bent) ? spans_[g].size : 0;
      return size;
    };
    double total = size_of_takers(false);
    const bool bent = !(total > 0);
    if (bent) total = size_of_takers(true);
    if (!(total > 0)) {
      report.slip_loss += old.stored;
      return;
    }
    for (std::uint32_t g = 0; g < spans_.size(); ++g) {
      if (!takes(g, i, bent)) continue;
      add(spans_[g].size / total, old, carried_[g]);
    }
  }

  static void add(double share, const FrictionHistory& old, FrictionHistory& now) {
    // Whether it slips is for the longest to say: one that ends beside another does not reset it.
    if (share * old.contact_length >= now.contact_length) now.slip = old.slip;
    now.elastic += share * old.elastic;
    now.applied += share * old.applied;
    now.stored += share * old.stored;
    now.contact_length += share * old.contact_length;
  }

  /// Whether a contact takes over from one of before: the two could be the same, and neither has a nearer one
  /// among those of the other time, unless one merged or split. One that lies on no line, since a contact
  /// bent around a corner came or went, is taken over by those near it that take over from no other.
  bool takes(std::uint32_t now, std::uint32_t old, bool bent) const {
    if (!bent) return takes(now, old);
    if (!near(now, old)) return false;
    for (std::uint32_t i = 0; i < old_.size(); ++i) {
      if (i != old && takes(now, i)) return false;
    }
    return true;
  }
  bool takes(std::uint32_t now, std::uint32_t old) const {
    if (!could_be(now, old)) return false;
    const double distance = apart(now, old);
    bool nearest_now = true, nearest_old = true;
    for (std::uint32_t g = 0; g < spans_.size(); ++g)
      nearest_now = nearest_now && !(could_be(g, old) && apart(g, old) < distance);
    for (std::uint32_t i = 0; i < old_.size(); ++i)
      nearest_old = nearest_old && !(could_be(now, i) && apart(now, i) < distance);
    return nearest_now || nearest_old;
  }

  /// Two contacts of a pair that lie side by side, or face each other, may be nearer than they are long: V of
  /// the one is nothing to the other. Along its line, or off it by no more than some six degrees, lies what
  /// was one with it.
  bool could_be(std::uint32_t now, std::uint32_t old) const {
    if (!near(now, old)) return false;
    if (at_home_[old] != 0 && carried_[now].strips != old_[old].strips) return false;
    const GroupSpan& span = spans_[now];
    const Point from = Point{old_[old].x, old_[old].y} - span.centre;
    if (spans_.size() == 1 && old_.size() == 1) return true;
    return std::abs(cross(span.along, from)) <= span.across + 0.1 * std::abs(dot(span.along, from));
  }
  bool near(std::uint32_t now, std::uint32_t old) const {
    return apart(now, old) <= spans_[now].reach + old_[old].contact_length / 2;
  }
  double apart(std::uint32_t now, std::uint32_t old) const {
    return length(Point{old_[old].x, old_[old].y} - spans_[now].centre);
  }

  /// Along the boundary of a body of many elements contacts lie end to end, and place alone would mix
  /// neighbours: the strips tell which is which as long as they touch. A strip that touches several pieces of
  /// a body may have several contacts, which place tells apart.
  void carry_to_same_strips() {
    list_names(carried_, now_);
    list_names(old_, then_);
    at_home_.clear();
    std::size_t kept = 0;
    for (const FrictionHistory& old : old_) {
      const auto now = named(now_, old.strips);
      if (now.size() == 1 && named(then_, old.strips).size() == 1) {
        add(1, old, carried_[now[0].contact]);
        continue;
      }
      at_home_.push_back(now.empty() ? 0 : 1);
      old_[kept++] = old;
    }
    old_.resize(kept);
  }

  /// Which strips a contact is of.
  struct Named {
    double strips;
    std::uint32_t contact;
    friend bool operator<(const Named& p, const Named& q) { return p.strips < q.strips; }
  };

  static void list_names(const std::vector<FrictionHistory>& contacts, std::vector<Named>& names) {
    names.clear();
    for (std::uint32_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i].strips != 0) names.push_back({contacts[i].strips, i});
    }
    std::sort(names.begin(), names.end());
  }

  /// Those of the strips with this name.
  static std::span<const Named> named(const std::vector<Named>& names, double strips) {
    const auto [first, last] = std::equal_range(names.begin(), names.end(), Named{strips, 0});
    return {first, last};
  }

  std::vector<FrictionHistory> carried_;
  std::vector<GroupSpan> spans_;
  std::vector<FrictionHistory> old_;  ///< in the end those that the strips did not tell
  std::vector<Named> now_, then_;     ///< by their strips
  std::vector<char> at_home_;         ///< [old] whether its strips still touch
};

}  // namespace talus::overlap
