#include <algorithm>

#include <gale/distributed/deal.hpp>
#include <gale/distributed/vertex_directory.hpp>

namespace gale::detail {

namespace {

/// What a rank says of a vertex that it hands over.
struct Handed {
  GlobalId id;
  Id place;
  int owner;
};

GlobalId greatest(const Array<const GlobalId, HostMemory>& ids) {
  return -reduce_min("GALE::greatest_id", HostSpace(), ids.extent(0), GlobalId(0), [&](Offset i) { return -ids(i); });
}

}  // namespace

VertexDirectory::VertexDirectory(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                                 const Array<const int, HostMemory>& owners)
    : ranks_(ranks), ids_a_home_((-ranks.least(-greatest(ids)) + ranks.size()) / ranks.size()) {
  const auto sent = deal<Handed>(
      ranks, "GALE::handed_vertices", ids.extent(0), [&](Id i) { return home_of(ids(i)); },
      [&](Id i) {
        return Handed{ids(i), i, owners(i)};
      });
  const auto received = exchange(ranks, "GALE::known_vertices", sent);
  together(ranks, [&] {
    const auto all = allocate<GlobalIds>("GALE::known_ids", received.count());
    parallel_for("GALE::known_ids", HostSpace(), received.count(), [&](Offset i) { all(i) = received.entries(i).id; });
    const DistinctIds distinct = distinct_ids(all);
    index_ = GlobalIndex(distinct.ids);
    entries_ = allocate<Array<VertexEntry, HostMemory>>("GALE::vertex_entries", index_.count());
    parallel_for("GALE::vertex_entries", HostSpace(), index_.count(), [&](Offset i) {
      const Id at = distinct.places(i);  // the first, so that of the lowest rank
      const auto next = std::upper_bound(received.begin.begin(), received.begin.end(), Offset(at));
      const Handed& handed = received.entries(at);
      entries_(i) = {static_cast<int>(next - received.begin.begin()) - 1, handed.place, handed.owner};
    });
  });
  vertices_ = ranks.sum(index_.count());
}

Array<VertexEntry, HostMemory> VertexDirectory::find(const Array<const GlobalId, HostMemory>& ids) const {
  Array<Id, HostMemory> by_home;
  const auto asked = deal<GlobalId>(
      ranks_, "GALE::asked_ids", ids.extent(0), [&](Id i) { return std::min(home_of(ids(i)), ranks_.size() - 1); },
      [&](Id i) { return ids(i); }, &by_home);
  const auto answers = answer<VertexEntry>(ranks_, "GALE::asked_entries", asked, [&](GlobalId id) {
    const Id place = index_.find(id);
    return place == no_id ? VertexEntry() : entries_(place);
  });
  Array<VertexEntry, HostMemory> found;
  together(ranks_, [&] {
    found = allocate<Array<VertexEntry, HostMemory>>("GALE::found_entries", ids.extent(0));
    parallel_for("GALE::found_entries", HostSpace(), ids.extent(0),
                 [&](Offset k) { found(by_home(k)) = answers.entries(k); });
  });
  return found;
}

GlobalIds VertexDirectory::owned() const {
  const auto told = deal<GlobalId>(
      ranks_, "GALE::told_ids", index_.count(), [&](Id i) { return entries_(i).owner; },
      [&](Id i) { return index_[i]; });
  return distinct_ids(exchange(ranks_, "GALE::owned_ids", told).entries).ids;
}

}  // namespace gale::detail
