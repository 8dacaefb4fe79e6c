#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gale/distributed/corner_owners.hpp>
#include <gale/distributed/deal.hpp>
#include <gale/distributed/local_tetrahedra.hpp>

namespace gale::detail {

namespace {

/// The least id that occurs more than once.
GlobalId repeated(const GlobalIds& ids) {
  std::vector<GlobalId> sorted(ids.data(), ids.data() + ids.extent(0));
  std::sort(sorted.begin(), sorted.end());
  return *std::adjacent_find(sorted.begin(), sorted.end());
}

[[noreturn]] void refuse_repeated(GlobalId id) {
  throw Error("tetrahedron " + std::to_string(id) + " is handed over twice");
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
  Dealt<SentTetrahedron> sent;
  choose(ranks, directory, outer, first_id, sent);
  received_ = exchange(ranks, "GALE::received_tetrahedra", sent);
  require_local(ranks, "tetrahedra", kept_count_ + received_.count(), most_local);
  together(ranks, [&] { merge(first_id); });
}

/// Of those with vertices outside `own`: which are kept, and which go to others.
template <class Index>
void LocalTetrahedra<Index>::choose(const Communicator& ranks, const VertexDirectory& directory,
                                    const std::vector<Id>& outer, GlobalId first_id, Dealt<SentTetrahedron>& sent) {
  const CornerOwners<Index> owners(ranks, part_, directory, own_, outer);
  together(ranks, [&] {
    const int here = ranks.rank();
    const ByRank groups = by_rank(ranks.size(), static_cast<Offset>(outer.size()),
                                  [&](Id i, const auto& visit) { owners.visit_ranks(outer[i], visit); });
    std::vector<std::int64_t> counts(ranks.size());
    for (int rank = 0; rank < ranks.size(); ++rank) counts[rank] = groups.begin[rank + 1] - groups.begin[rank];
    const Offset kept = std::exchange(counts[here], 0), kept_from = groups.begin[here];
    outer_.resize(kept);
    parallel_for("GALE::outer_tetrahedra", HostSpace(), kept,
                 [&](Offset i) { outer_[i] = outer[groups.members(kept_from + i)]; });
    std::vector<Id> dropped;
    std::set_difference(outer.begin(), outer.end(), outer_.begin(), outer_.end(), std::back_inserter(dropped));
    keep_all_but(dropped);
    sent = dealt<SentTetrahedron>("GALE::sent_tetrahedra", counts);
    parallel_for("GALE::sent_tetrahedra", HostSpace(), sent.count(), [&](Offset i) {
      const Id t = outer[groups.members(i < kept_from ? i : i + kept)];
      SentTetrahedron& tetrahedron = sent.entries(i);
      tetrahedron.id = part_.tetrahedron_ids.extent(0) == 0 ? first_id + t : part_.tetrahedron_ids(t);
      for (int corner = 0; corner < 4; ++corner) tetrahedron.vertices[corner] = part_.tetrahedra(t, corner);
    });
  });
}

/// `dropped` ascends.
template <class Index>
void LocalTetrahedra<Index>::keep_all_but(const std::vector<Id>& dropped) {
  const Offset count = part_.tetrahedra.extent(0);
  kept_count_ = count - static_cast<Offset>(dropped.size());
  if (dropped.empty() || kept_count_ == 0) return;
  kept_ = allocate<Array<Id, HostMemory>>("GALE::kept_tetrahedra", kept_count_);
  for_parts("GALE::kept_tetrahedra", count, threads_for(count), [&](int, Offset first, Offset last) {
    auto next = std::lower_bound(dropped.begin(), dropped.end(), static_cast<Id>(first));
    for (Offset t = first; t < last; ++t) {
      if (next != dropped.end() && *next == t) {
        ++next;
      } else {
        kept_(t - (next - dropped.begin())) = static_cast<Id>(t);
      }
    }
  });
}

/// Puts them in the order of ids: those that are kept have it mostly, and the others are few.
template <class Index>
void LocalTetrahedra<Index>::merge(GlobalId first_id) {
  const Offset descents = reduce_sum("GALE::count_descents", HostSpace(), kept_count_, [&](Offset k) {
    return Offset(k > 0 && kept_id(k, first_id) <= kept_id(k - 1, first_id));
  });
  if (descents > 0) return sort(first_id);
  const Offset received = received_.count();
  std::vector<Id> by_id(received);
  std::iota(by_id.begin(), by_id.end(), Id(0));
  std::sort(by_id.begin(), by_id.end(), [&](Id a, Id b) { return received_.entries(a).id < received_.entries(b).id; });
  before_received_.resize(received);
  received_places_.resize(received);
  ids_ = allocate<GlobalIds>("GALE::tetrahedron_ids", kept_count_ + received);
  Offset before = 0;
  for (Offset r = 0; r < received; ++r) {
    const GlobalId id = received_.entries(by_id[r]).id;
    for (Offset end = kept_count_; before < end;) {  // to the first kept one that isn't below it
      const Offset middle = before + (end - before) / 2;
      const bool is_below = kept_id(middle, first_id) < id;
      before = is_below ? middle + 1 : before;
      end = is_below ? end : middle;
    }
    if ((before < kept_count_ && kept_id(before, first_id) == id) ||
        (r > 0 && received_.entries(by_id[r - 1]).id == id))
      refuse_repeated(id);
    before_received_[r] = before;
    received_places_[by_id[r]] = before + r;
    ids_(before + r) = id;
  }
  for_each_kept("GALE::tetrahedron_ids", [&](Offset i, Offset k) { ids_(i) = kept_id(k, first_id); });
}

template <class Index>
void LocalTetrahedra<Index>::sort(GlobalId first_id) {
  const Offset count = kept_count_ + received_.count();
  const auto ids = allocate<GlobalIds>("GALE::tetrahedron_ids", count);
  parallel_for("GALE::tetrahedron_ids", HostSpace(), count, [&](Offset i) {
    ids(i) = i < kept_count_ ? kept_id(i, first_id) : received_.entries(i - kept_count_).id;
  });
  const DistinctIds sorted = distinct_ids(ids);
  if (static_cast<Offset>(sorted.ids.extent(0)) < count) refuse_repeated(repeated(ids));
  ids_ = sorted.ids;
  places_ = sorted.places;
}

template <class Index>
GlobalIds LocalTetrahedra<Index>::vertices_beside(const GlobalIds& owned) const {
  const GlobalIndex index(own_.is_empty() ? owned : GlobalIds());
  const auto outer = static_cast<Offset>(outer_.size());
  return missing_ids(index, outer + received_.count(), [&](Offset i, const auto& offer) {
    for (int corner = 0; corner < 4; ++corner) {
      const GlobalId vertex =
          i < outer ? GlobalId(part_.tetrahedra(outer_[i], corner)) : received_.entries(i - outer).vertices[corner];
      if (!own_.contains(vertex)) offer(vertex);
    }
  });
}

template class LocalTetrahedra<std::int32_t>;
template class LocalTetrahedra<std::int64_t>;

}  // namespace gale::detail
