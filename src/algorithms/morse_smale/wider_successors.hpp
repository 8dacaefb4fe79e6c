#pragma once

#include <utility>
#include <vector>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

/// The successors of simplices that a rank knows: of a part's own ones, and of others, whose numbers come after them.
/// An own one that the part says is elsewhere is looked up among the exits. Owns nothing.
template <class Own>
struct WiderSuccessorsOf {
  Own own;
  Id count;                                  ///< of own ones
  const Id* beyond = nullptr;                ///< of the others
  const std::pair<Id, Id>* exits = nullptr;  ///< own ones, ascending, and their successors
  Id exit_count = 0;

  /// Elsewhere where nobody has told it.
  GALE_CALLS_ANY
  KOKKOS_FUNCTION Id operator[](Id simplex) const {
    if (simplex >= count) return beyond[simplex - count];
    const Id next = own[simplex];
    return next == DiscreteGradient::elsewhere ? next_of_exit(simplex) : next;
  }

 private:
  KOKKOS_FUNCTION Id next_of_exit(Id simplex) const {
    const auto* const from = exits;
    const Id at = bisect(Id(0), exit_count, [=](Id i) { return from[i].first < simplex; });
    return at < exit_count && exits[at].first == simplex ? exits[at].second : DiscreteGradient::elsewhere;
  }
};

using WiderSuccessors = WiderSuccessorsOf<const Id*>;

/// Successors as WiderSuccessors has them, which own their arrays.
struct MoreSuccessors {
  Mirrored<Id> own;                      ///< of the part's simplices, where these were found
  std::vector<Id> beyond;                ///< of others', whose numbers come after them
  std::vector<std::pair<Id, Id>> exits;  ///< own ones, ascending, and their successors

  /// Takes what somebody has told of one simplex; of own ones in any order, before `sort`.
  void tell(Id simplex, Id next) {
    const Id count = static_cast<Id>(own.size());
    if (simplex < count) {
      exits.emplace_back(simplex, next);
    } else {
      beyond[simplex - count] = next;
    }
  }
  void sort() { parallel_sort("GALE::sort_exits", exits.begin(), exits.end()); }

  /// Successors of all, with own ones read through `own_ones`. Refers to these arrays.
  template <class Own>
  WiderSuccessorsOf<Own> beside(const Own& own_ones) const {
    return {own_ones, static_cast<Id>(own.size()), beyond.data(), exits.data(), static_cast<Id>(exits.size())};
  }
};

/// Puts MoreSuccessors into a memory. Refers to them where they lie there already.
template <class Memory>
class SuccessorsIn {
 public:
  explicit SuccessorsIn(const MoreSuccessors& successors)
      : own_(successors.own.in<Memory>()),
        beyond_(in_memory<Memory>(successors.beyond)),
        exits_(in_memory<Memory>(successors.exits)) {}

  WiderSuccessors all() const {
    return {own_.data(), static_cast<Id>(own_.extent(0)), beyond_.data(), exits_.data(),
            static_cast<Id>(exits_.extent(0))};
  }

 private:
  Array<const Id, Memory> own_, beyond_;
  Array<const std::pair<Id, Id>, Memory> exits_;
};

/// Brings a successor that is soon read near.
inline void bring_near(const WiderSuccessors& successors, Id simplex) {
  if (simplex < successors.count) __builtin_prefetch(successors.own + simplex);
}

}  // namespace gale::detail
