#include <gale/distributed/sharing/vertex_directory.hpp>

namespace gale::detail {

namespace {

/// What a rank says of a vertex that it hands over.
struct HandedVertex {
  Id place;
  int owner;
};

/// How many vertices a rank is the lowest to hand over.
Offset first_given(const GivenIntervals& given, int rank) {
  Offset count = 0;
  given.visit_first_givers_of(rank, [&](const IdInterval& ids) { count += ids.end - ids.begin; });
  return count;
}

/// What it owns, where each vertex belongs to the lowest rank that hands it over.
OwnedIds owned_of(const GivenIntervals& given, int rank) {
  std::vector<IdInterval> intervals;
  given.visit_first_givers_of(rank, [&](const IdInterval& some) { intervals.push_back(some); });
  if (intervals.size() == 1) return OwnedIds(intervals.front());
  const auto ids = allocate<GlobalIds>("GALE::owned_ids", first_given(given, rank));
  Offset from = 0;
  for (const IdInterval& some : intervals) {
    parallel_for("GALE::owned_ids", HostExecutionSpace(), some.end - some.begin,
                 [&](Offset i) { ids(from + i) = some.begin + i; });
    from += some.end - some.begin;
  }
  return OwnedIds(ids);
}

VertexEntry entry_of(const GivenIntervals& given, GlobalId id) {
  const int giver = given.giver(id);
  if (giver < 0) return {};
  return {giver, static_cast<Id>(id - given.of(giver).begin), giver};
}

}  // namespace

VertexDirectory::VertexDirectory(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                                 const Array<const int, HostMemory>& owners)
    : ranks_(ranks),
      table_(
          ranks, ids,
          [&](Id i) {
            return HandedVertex{i, owners(i)};
          },
          [](int giver, const HandedVertex& handed) {
            return VertexEntry{giver, handed.place, handed.owner};
          }),
      vertices_(ranks.sum(table_.count())) {}

VertexDirectory::VertexDirectory(const Communicator& ranks, const GivenIntervals& given)
    : ranks_(ranks), given_(given), vertices_(ranks.sum(first_given(given, ranks.rank()))) {}

Array<VertexEntry, HostMemory> VertexDirectory::find(const Array<const GlobalId, HostMemory>& ids) const {
  if (!given_) return table_.find(ranks_, ids);
  Array<VertexEntry, HostMemory> found;
  together(ranks_, [&] {
    found = tabulated<VertexEntry>("GALE::found_entries", ids.extent(0),
                                   [&](Offset i) { return entry_of(*given_, ids(i)); });
  });
  return found;
}

OwnedIds VertexDirectory::owned() const {
  OwnedIds owned;
  if (given_) {
    together(ranks_, [&] { owned = owned_of(*given_, ranks_.rank()); });
    return owned;
  }
  const auto told = deal<GlobalId>(
      ranks_, "GALE::told_ids", table_.count(), [&](Id i) { return table_.entry(i).owner; },
      [&](Id i) { return table_.id(i); });
  const auto received = exchange(ranks_, "GALE::owned_ids", told);
  together(ranks_, [&] { owned = OwnedIds(distinct_ids(received.entries).ids); });
  return owned;
}

}  // namespace gale::detail
