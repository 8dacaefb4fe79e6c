#pragma once

#include <utility>
#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/distributed/dealt.hpp>

// Messages of which each rank decides by itself what it sends to whom.

namespace gale::detail {

/// Items by rank: those of rank r are members(begin[r]) to members(begin[r + 1] - 1), ascending.
struct ByRank {
  std::vector<Offset> begin;
  Array<Id, HostMemory> members;
};

/// Groups the items 0..items-1: visit_ranks(item, visit) calls visit(rank) for each rank of an item, the same ones each
/// time. Unlike group_by it is for few groups of many items: no two threads count in one place.
template <class VisitRanks>
ByRank by_rank(int ranks, Offset items, const VisitRanks& visit_ranks) {
  const int parts = threads_for(items);
  std::vector<std::vector<Offset>> places(parts);
  for_parts("GALE::count_by_rank", items, parts, [&](int part, Offset first, Offset last) {
    std::vector<Offset> counts(ranks, 0);
    for (Offset i = first; i < last; ++i) visit_ranks(static_cast<Id>(i), [&](int rank) { ++counts[rank]; });
    places[part] = std::move(counts);
  });
  ByRank groups{{0}, {}};
  Offset total = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    for (auto& of_part : places) total += std::exchange(of_part[rank], total);
    groups.begin.push_back(total);
  }
  groups.members = allocate<Array<Id, HostMemory>>("GALE::items_by_rank", total);
  for_parts("GALE::fill_by_rank", items, parts, [&](int part, Offset first, Offset last) {
    std::vector<Offset>& next = places[part];
    for (Offset i = first; i < last; ++i)
      visit_ranks(static_cast<Id>(i), [&](int rank) { groups.members(next[rank]++) = static_cast<Id>(i); });
  });
  return groups;
}

/// For each rank the entries entry_of(i) of those items i in 0..items-1 whose rank_of(i) it is, ascending. `members`
/// becomes the items in the order of the entries. Collective.
template <class T, class RankOf, class EntryOf>
Dealt<T> deal(const Communicator& ranks, const char* label, Offset items, const RankOf& rank_of,
              const EntryOf& entry_of, Array<Id, HostMemory>* members = nullptr) {
  Dealt<T> sent;
  together(ranks, [&] {
    const ByRank groups =
        by_rank(ranks.size(), items, [&](Id i, const auto& visit) { visit(static_cast<int>(rank_of(i))); });
    sent = {allocate<Array<T, HostMemory>>(label, items), groups.begin};
    parallel_for("GALE::deal", HostExecutionSpace(), items,
                 [&](Offset k) { sent.entries(k) = entry_of(groups.members(k)); });
    if (members != nullptr) *members = groups.members;
  });
  return sent;
}

/// What the ranks answer to what was `asked` of them, in the same places: answer_of(question), found by the rank that
/// it was sent to. Collective; no answer_of sends anything.
template <class Answer, class Question, class AnswerOf>
Dealt<Answer> answer(const Communicator& ranks, const char* label, const Dealt<Question>& asked,
                     const AnswerOf& answer_of) {
  const Dealt<Question> questions = exchange(ranks, "GALE::questions", asked);
  Dealt<Answer> given, received;
  together(ranks, [&] {
    given = dealt<Answer>("GALE::answers", counts_of(questions));
    parallel_for("GALE::answers", HostExecutionSpace(), questions.count(),
                 [&](Offset i) { given.entries(i) = answer_of(questions.entries(i)); });
    received = dealt<Answer>(label, counts_of(asked));
  });
  exchange(ranks, given, received);
  return received;
}

}  // namespace gale::detail
