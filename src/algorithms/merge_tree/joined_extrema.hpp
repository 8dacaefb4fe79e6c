#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/global_index.hpp>

namespace gale::detail {

/// A vertex of this rank, with its key as a side sees it, and an extremum of which a path ends there.
struct JoiningVertex {
  std::uint64_t key;
  Id vertex;
  GlobalId extremum;

  bool operator<(const JoiningVertex& other) const {
    return key != other.key ? key < other.key : extremum < other.extremum;
  }
};

/// The extrema at which paths of this rank end, joined where these meet.
class JoinedExtrema {
 public:
  /// Keeps the meetings that join paths to extrema which lower ones of this rank (as the side comes to them) don't:
  /// what joins extrema that are joined already makes no node, wherever the others are.
  explicit JoinedExtrema(std::vector<JoiningVertex>& meetings) {
    parallel_sort("GALE::sort_meetings", meetings.begin(), meetings.end());
    const Offset count = static_cast<Offset>(meetings.size());
    const auto extremum_of = [&](Offset i) { return meetings[i].extremum; };
    extrema_ = GlobalIndex(distinct_ids(tabulated<GlobalId>("GALE::met_extrema", count, extremum_of)).ids);
    const auto place_of =
        tabulated<Id>("GALE::met_extrema", count, [&](Offset i) { return extrema_.find(extremum_of(i)); });
    joined_.resize(extrema_.count());
    std::iota(joined_.begin(), joined_.end(), Id(0));
    std::vector<JoiningVertex> kept;
    for (std::size_t i = 0, next = 0; i < meetings.size(); i = next) {
      const std::size_t before = kept.size();
      kept.push_back(meetings[i]);
      const Id all = root_of(joined_, place_of(i));
      for (next = i + 1; next < meetings.size() && meetings[next].vertex == meetings[i].vertex; ++next) {
        const Id other = root_of(joined_, place_of(next));
        if (other == all) continue;
        joined_[other] = all;
        kept.push_back(meetings[next]);
      }
      if (kept.size() == before + 1) kept.pop_back();
    }
    meetings = std::move(kept);
  }

  /// The extremum that stands for all that this one is joined with.
  GlobalId of(GlobalId extremum) {
    const Id place = extrema_.find(extremum);
    return place == no_id ? extremum : extrema_[root_of(joined_, place)];
  }

 private:
  GlobalIndex extrema_;
  std::vector<Id> joined_;  ///< for each a step to the one that stands for it
};

}  // namespace gale::detail
