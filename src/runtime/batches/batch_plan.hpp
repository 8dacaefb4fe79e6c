#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <gale/relations/kernels/block_pool.hpp>

namespace gale::detail {

/// Segments that are computed together, and what they are known to need beyond the usual.
struct BatchPlan {
  Id begin = 0, end = 0;           ///< the interval that they are, unless they are in the list
  std::vector<Id> segments;        ///< the list; empty: the interval
  Offset words = 0;                ///< room that their blocks have
  std::vector<StarSizes> scratch;  ///< by kernel, at least; none: the usual

  bool is_interval() const { return segments.empty(); }
  Id count() const { return is_interval() ? end - begin : static_cast<Id>(segments.size()); }
  Id segment(Id i) const { return is_interval() ? begin + i : segments[i]; }
};

/// What a batch took and lacked.
struct BatchShortfall {
  std::vector<Id> segments;        ///< that haven't all their blocks
  Offset words = 0;                ///< that the blocks of all its segments take
  std::vector<StarSizes> scratch;  ///< by kernel: what the missing ones need
};

/// What a batch lacks that couldn't be launched: everything.
inline BatchShortfall all_of(const BatchPlan& plan) {
  BatchShortfall lacked;
  for (Id i = 0; i < plan.count(); ++i) lacked.segments.push_back(plan.segment(i));
  return lacked;
}

/// What a batch lacked, to be tried again in two parts, or in one if it is one segment: with the scratch memory that it
/// needs and, for one segment, the room.
inline std::vector<BatchPlan> in_halves(const BatchPlan& plan, const BatchShortfall& lacked) {
  BatchPlan half;
  half.words = plan.words;
  half.scratch = plan.scratch;
  half.scratch.resize(std::max(plan.scratch.size(), lacked.scratch.size()));
  for (std::size_t k = 0; k < lacked.scratch.size(); ++k) half.scratch[k] = larger(half.scratch[k], lacked.scratch[k]);
  if (lacked.segments.size() == 1) half.words = std::max(half.words, lacked.words);
  std::vector<BatchPlan> halves;
  const auto begin = lacked.segments.begin(), end = lacked.segments.end(), middle = begin + (end - begin + 1) / 2;
  for (const auto& [from, to] : {std::make_pair(begin, middle), std::make_pair(middle, end)}) {
    if (from == to) continue;
    half.segments.assign(from, to);
    halves.push_back(half);
  }
  return halves;
}

}  // namespace gale::detail
