#pragma once

#include "model/model.hpp"

#include <boost/pending/disjoint_sets.hpp>

namespace talus {

/// What joints leave of a body of many elements: elements that share a patch, directly or by way of others,
/// hang together.
class Fragments {
 public:
  /// Of elements added one by one; patches are told apart until then.
  explicit Fragments(const CoverRanges& ranges)
      : first_(ranges.patch_begin), sets_(ranges.patch_end - ranges.patch_begin) {}
  void add(const Element& element) {
    sets_.union_set(element.patch[0] - first_, element.patch[1] - first_);
    sets_.union_set(element.patch[0] - first_, element.patch[2] - first_);
  }

  /// The same number for all patches of a fragment.
  std::size_t of(std::uint32_t patch) { return sets_.find_set(patch - first_); }

 private:
  std::uint32_t first_;
  boost::disjoint_sets_with_storage<> sets_;
};

/// [element of the body, in the order of Model::body_element] its fragment, numbered from 0 as they appear.
std::vector<std::uint32_t> fragments_of(const Model& model, std::uint32_t body);

}  // namespace talus
