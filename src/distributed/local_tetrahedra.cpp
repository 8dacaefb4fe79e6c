#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gale/distributed/corner_owners.hpp>
#include <gale/distributed/deal.hpp>
#include <gale/distributed/local_tetrahedra.hpp>

namespace gale::detail {

namespace {

/// The places 0..count-1 but for those that are dropped, which ascend; none if none is.
Array<Id, HostMemory> all_but(const std::vector<Id>& dropped, Offset count) {
  if (dropped.empty()) return {};
  const auto kept =
      allocate<Array<Id, HostMemory>>("GALE::kept_tetrahedra", count - static_cast<Offset>(dropped.size()));
  for_parts("GALE::kept_tetrahedra", count, threads_for(count), [&](int, Offset first, Offset last) {
    auto next = std::lower_bound(dropped.begin(), dropped.end(), static_cast<Id>(first));
    for (Offset t = first; t < last; ++t) {
      if (next != dropped.end() && *next == t) {
        ++next;
      } else {
        kept(t - (next - dropped.begin())) = static_cast<Id>(t);
      }
    }
  });
  return kept;
}

template <class Index>
GlobalIds ids_of(const Dealt<SentTetrahedron<Index>>& some) {
  const auto ids = allocate<GlobalIds>("GALE::received_ids", some.count());
  parallel_for("GALE::received_ids", HostExecutionSpace(), some.count(),
               [&](Offset i) { ids(i) = some.entries(i).id; });
  return ids;
}

}  // namespace

void require_local(const Communicator& ranks, const char* name, Offset count, Offset most) {
  const Offset greatest = -ranks.least(-count);
  if (greatest <= most) return;
  const double shares = static_cast<double>(greatest) * ranks.size() / static_cast<double>(most);
  throw SharedError("a rank would hold " + std::to_string(greatest) + ' ' + name + ", but at most " +
                    std::to_string(most) + " fit: take at least " + std::to_string(static_cast<Offset>(shares) + 1) +
                    " ranks");
}

template <class Index>
LocalTetrahedra<Index>::LocalTetrahedra(const Communicator& ranks, const MeshPart<Index>& part,
                                        const VertexDirectory& directory, const IdInterval& own, Offset most_local)
    : part_(part), own_(own) {
  const GlobalId first_id = ranks.sum_before(part.tetrahedra.extent(0));
  std::vector<Id> outer;
  together(ranks, [&] { outer = tetrahedra_beyond(part, own); });
  Dealt<SentTetrahedron<Index>> sent;
  const KeptTetrahedra kept = choose(ranks, directory, outer, first_id, sent);
  received_ = exchange(ranks, "GALE::received_tetrahedra", sent);
  require_local(ranks, "tetrahedra", kept.count + received_.count(), most_local);
  together(ranks, [&] { places_ = TetrahedronPlaces(kept, ids_of(received_)); });
}

/// Says which tetrahedra with vertices outside `own` are kept, and which go to others.
template <class Index>
KeptTetrahedra LocalTetrahedra<Index>::choose(const Communicator& ranks, const VertexDirectory& directory,
                                              const std::vector<Id>& outer, GlobalId first_id,
                                              Dealt<SentTetrahedron<Index>>& sent) {
  const CornerOwners<Index> owners(ranks, part_, directory, own_, outer);
  KeptTetrahedra all_kept;
  together(ranks, [&] {
    const int here = ranks.rank();
    const ByRank groups = by_rank(ranks.size(), static_cast<Offset>(outer.size()),
                                  [&](Id i, const auto& visit) { owners.visit_ranks(outer[i], visit); });
    std::vector<std::int64_t> counts(ranks.size());
    for (int rank = 0; rank < ranks.size(); ++rank) counts[rank] = groups.begin[rank + 1] - groups.begin[rank];
    const Offset kept = std::exchange(counts[here], 0), kept_from = groups.begin[here];
    outer_.resize(kept);
    parallel_for("GALE::outer_tetrahedra", HostExecutionSpace(), kept,
                 [&](Offset i) { outer_[i] = outer[groups.members(kept_from + i)]; });
    std::vector<Id> dropped;
    std::set_difference(outer.begin(), outer.end(), outer_.begin(), outer_.end(), std::back_inserter(dropped));
    const Offset count = part_.tetrahedra.extent(0);
    all_kept = {count - static_cast<Offset>(dropped.size()), all_but(dropped, count), part_.tetrahedron_ids, first_id};
    sent = dealt<SentTetrahedron<Index>>("GALE::sent_tetrahedra", counts);
    parallel_for("GALE::sent_tetrahedra", HostExecutionSpace(), sent.count(), [&](Offset i) {
      const Id t = outer[groups.members(i < kept_from ? i : i + kept)];
      SentTetrahedron<Index>& tetrahedron = sent.entries(i);
      tetrahedron.id = all_kept.id_at(t);
      for (int corner = 0; corner < 4; ++corner) tetrahedron.vertices[corner] = part_.tetrahedra(t, corner);
    });
  });
  return all_kept;
}

template <class Index>
GlobalIds LocalTetrahedra<Index>::vertices_beside(const OwnedIds& owned) const {
  const GlobalIndex index(owned.ids);
  const auto outer = static_cast<Offset>(outer_.size());
  return missing_ids(index, outer + received_.count(), [&](Offset i, const auto& offer) {
    for (int corner = 0; corner < 4; ++corner) {
      const GlobalId vertex =
          i < outer ? part_.tetrahedra(outer_[i], corner) : received_.entries(i - outer).vertices[corner];
      if (!own_.contains(vertex)) offer(vertex);
    }
  });
}

template class LocalTetrahedra<std::int32_t>;
template class LocalTetrahedra<std::int64_t>;

}  // namespace gale::detail
