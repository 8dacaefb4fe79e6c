#include <utility>

#include <gale/algorithms/persistence/joined_ends.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

namespace {

/// Sets of extrema, by age; each is known by its oldest.
class Sets {
 public:
  explicit Sets(std::size_t count) : older_(count) {
    for (std::size_t i = 0; i < count; ++i) older_[i] = static_cast<Id>(i);
  }

  Id oldest(Id of) {
    while (older_[of] != of) of = older_[of] = older_[older_[of]];
    return of;
  }

  void join(Id younger, Id older) { older_[younger] = older; }

 private:
  std::vector<Id> older_;
};

}  // namespace

std::vector<Id> join_ends(const std::vector<Id>& saddles, const PathEnds& ends, const std::vector<Id>& age) {
  // The outside has age 0 here, and the extrema follow.
  std::vector<Id> extremum(age.size() + 1, no_id), saddle_of(age.size(), no_id);
  for (std::size_t i = 0; i < age.size(); ++i) extremum[age[i] + 1] = static_cast<Id>(i);
  Sets sets(age.size() + 1);
  const auto oldest = [&](Id end) { return sets.oldest(end == no_id ? 0 : age[end] + 1); };
  for (const Id saddle : saddles) {
    stop_if_asked_at(saddle);
    Id one = oldest(ends[saddle][0]), other = oldest(ends[saddle][1]);
    if (one == other) continue;
    if (one < other) std::swap(one, other);
    saddle_of[extremum[one]] = saddle;
    sets.join(one, other);
  }
  return saddle_of;
}

}  // namespace gale::detail
