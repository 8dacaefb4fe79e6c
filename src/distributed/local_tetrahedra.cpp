#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gale/distributed/deal.hpp>
#include <gale/distributed/local_tetrahedra.hpp>

namespace gale::detail {

namespace {

/// The vertices of a part's tetrahedra, and the ranks that own them.
template <class Index>
class CornerOwners {
 public:
  CornerOwners(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory) : part_(part) {
    GlobalIds others;
    together(ranks, [&] {
      given_ = GlobalIndex(distinct_ids(part.vertex_ids).ids);
      others = missing_ids(given_, part.tetrahedra.extent(0), [&](Offset t, const auto& offer) {
        for (int corner = 0; corner < 4; ++corner) offer(GlobalId(part.tetrahedra(t, corner)));
      });
      others_ = GlobalIndex(others);
    });
    of_given_ = directory.find(given_.ids());
    of_others_ = directory.find(others);
    together(ranks, [&] { refuse_unknown(); });
  }

  int owner(Offset t, int corner) const {
    const GlobalId vertex = part_.tetrahedra(t, corner);
    const Id place = given_.find(vertex);
    return place != no_id ? of_given_(place).owner : of_others_(others_.find(vertex)).owner;
  }

  /// Calls visit(rank) once for each rank that owns a vertex of a tetrahedron.
  template <class Visit>
  void visit_ranks(Offset t, const Visit& visit) const {
    int ranks[4];
    for (int corner = 0; corner < 4; ++corner) {
      ranks[corner] = owner(t, corner);
      bool is_new = true;
      for (int other = 0; other < corner; ++other) is_new &= ranks[other] != ranks[corner];
      if (is_new) visit(ranks[corner]);
    }
  }

 private:
  void refuse_unknown() const {
    for (Offset i = 0; i < others_.count(); ++i) {
      if (of_others_(i).giver < 0)
        throw Error("a tetrahedron has vertex " + std::to_string(others_[i]) + ", which no rank hands over");
    }
  }

  const MeshPart<Index>& part_;
  GlobalIndex given_, others_;  ///< vertices that this rank hands over, and those that its tetrahedra have beside them
  Array<VertexEntry, HostMemory> of_given_, of_others_;
};

template <class Index>
GlobalId id_of(const MeshPart<Index>& part, GlobalId first_id, Offset t) {
  return part.tetrahedron_ids.extent(0) == 0 ? first_id + t : part.tetrahedron_ids(t);
}

/// The least id that occurs more than once.
GlobalId repeated(const GlobalIds& ids) {
  std::vector<GlobalId> sorted(ids.data(), ids.data() + ids.extent(0));
  std::sort(sorted.begin(), sorted.end());
  return *std::adjacent_find(sorted.begin(), sorted.end());
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
                                        const VertexDirectory& directory, Offset most_local)
    : part_(part) {
  const GlobalId first_id = ranks.sum_before(part.tetrahedra.extent(0));
  const CornerOwners<Index> owners(ranks, part, directory);
  Dealt<SentTetrahedron> sent;
  together(ranks, [&] {
    const ByRank groups = by_rank(ranks.size(), part.tetrahedra.extent(0),
                                  [&](Id t, const auto& visit) { owners.visit_ranks(t, visit); });
    std::vector<std::int64_t> counts(ranks.size());
    for (int rank = 0; rank < ranks.size(); ++rank) counts[rank] = groups.begin[rank + 1] - groups.begin[rank];
    kept_ = allocate<Array<Id, HostMemory>>("GALE::kept_tetrahedra", std::exchange(counts[ranks.rank()], 0));
    const Offset kept_from = groups.begin[ranks.rank()];
    parallel_for("GALE::kept_tetrahedra", HostSpace(), kept_.extent(0),
                 [&](Offset i) { kept_(i) = groups.members(kept_from + i); });
    sent = dealt<SentTetrahedron>("GALE::sent_tetrahedra", counts);
    const Offset kept = kept_.extent(0);
    parallel_for("GALE::sent_tetrahedra", HostSpace(), sent.count(), [&](Offset i) {
      const Id t = groups.members(i < kept_from ? i : i + kept);
      SentTetrahedron& tetrahedron = sent.entries(i);
      tetrahedron.id = id_of(part, first_id, t);
      for (int corner = 0; corner < 4; ++corner) tetrahedron.vertices[corner] = part.tetrahedra(t, corner);
    });
  });
  received_ = exchange(ranks, "GALE::received_tetrahedra", sent);
  require_local(ranks, "tetrahedra", kept_.extent(0) + received_.count(), most_local);
  together(ranks, [&] { sort(first_id); });
}

template <class Index>
void LocalTetrahedra<Index>::sort(GlobalId first_id) {
  const Offset kept = kept_.extent(0), count = kept + received_.count();
  const auto ids = allocate<GlobalIds>("GALE::tetrahedron_ids", count);
  parallel_for("GALE::tetrahedron_ids", HostSpace(), count, [&](Offset i) {
    ids(i) = i < kept ? id_of(part_, first_id, kept_(i)) : received_.entries(i - kept).id;
  });
  sorted_ = distinct_ids(ids);
  if (this->count() < count) throw Error("tetrahedron " + std::to_string(repeated(ids)) + " is handed over twice");
}

template class LocalTetrahedra<std::int32_t>;
template class LocalTetrahedra<std::int64_t>;

}  // namespace gale::detail
