#include <gale/distributed/vertex_directory.hpp>

namespace gale::detail {

namespace {

/// What a rank says of a vertex that it hands over.
struct HandedVertex {
  Id place;
  int owner;
};

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

GlobalIds VertexDirectory::owned() const {
  const auto told = deal<GlobalId>(
      ranks_, "GALE::told_ids", table_.count(), [&](Id i) { return table_.entry(i).owner; },
      [&](Id i) { return table_.id(i); });
  return distinct_ids(exchange(ranks_, "GALE::owned_ids", told).entries).ids;
}

}  // namespace gale::detail
