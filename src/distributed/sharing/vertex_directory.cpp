#include <utility>
#include <vector>

#include <gale/distributed/sharing/vertex_directory.hpp>

namespace gale::detail {

namespace {

/// What a rank says of a vertex that it hands over.
struct HandedVertex {
  Id place;
  int owner;
};

/// What a rank is told of one of which it has said another owner than the lowest one that hands it over.
struct Correction {
  int rank;
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
                                 const Array<int, HostMemory>& owners)
    : ranks_(ranks), owners_of_handed_(owners) {
  std::vector<Correction> corrections;
  table_ = HomeTable<VertexEntry>(
      ranks, ids,
      [&](Id i) {
        return HandedVertex{i, owners(i)};
      },
      [](int giver, const HandedVertex& handed) {
        return VertexEntry{giver, handed.place, handed.owner};
      },
      [&](int rank, const HandedVertex& handed, const VertexEntry& entry) {
        if (handed.owner != entry.owner) corrections.push_back({rank, handed.place, entry.owner});
      });
  vertices_ = ranks.sum(table_.count());
  const auto sent = collect_by_rank<Correction>(
      ranks, "GALE::corrections", static_cast<Offset>(corrections.size()), [&](Id i) { return corrections[i].rank; },
      [&](Id i) { return corrections[i]; });
  const auto told = exchange(ranks, "GALE::told_corrections", sent);
  for (Offset i = 0; i < told.count(); ++i) owners_of_handed_(told.entries(i).place) = told.entries(i).owner;
}

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

OwnedVertices VertexDirectory::owned() const {
  struct OwnedVertex {
    GlobalId id;
    int giver;
    Id place;
  };
  OwnedVertices owned;
  if (given_) {
    together(ranks_, [&] {
      owned.ids = owned_of(*given_, ranks_.rank());
      owned.entries = tabulated<VertexEntry>("GALE::owned_entries", owned.ids.ids.extent(0),
                                             [&](Offset i) { return entry_of(*given_, owned.ids.ids(i)); });
    });
    return owned;
  }
  const auto told = collect_by_rank<OwnedVertex>(
      ranks_, "GALE::told_vertices", table_.count(), [&](Id i) { return table_.entry(i).owner; },
      [&](Id i) {
        return OwnedVertex{table_.id(i), table_.entry(i).giver, table_.entry(i).place};
      });
  const auto received = exchange(ranks_, "GALE::owned_vertices", told);  // ascending: as homes do, and ids of each
  together(ranks_, [&] {
    owned.ids = OwnedIds(
        tabulated<GlobalId>("GALE::owned_ids", received.count(), [&](Offset i) { return received.entries(i).id; }));
    owned.entries = tabulated<VertexEntry>("GALE::owned_entries", received.count(), [&](Offset i) {
      return VertexEntry{received.entries(i).giver, received.entries(i).place, ranks_.rank()};
    });
  });
  return owned;
}

}  // namespace gale::detail
