#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gale/distributed/sharing/local_cells.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// Throws for a cell that is none.
template <class Index>
void require_cell(const Index* cell, Offset corners) {
  bool is_one = true;
  for (const Index* corner = cell; corner != cell + corners; ++corner)
    is_one &= *corner >= 0 && std::find(cell, corner, *corner) == corner;
  if (is_one) return;
  std::string vertices;
  for (Offset k = 0; k < corners; ++k) vertices += ' ' + std::to_string(cell[k]);
  throw Error("the cell of vertices" + vertices + " is none: they must be different, and 0 or more");
}

/// The cells of a part with vertices outside `own`: their places in it, ascending. Throws gale::Error for one of
/// these whose vertices are below 0 or not different.
template <class Index>
std::vector<Id> cells_beyond(const MeshPart<Index>& part, const IdInterval& own) {
  constexpr Offset block = 64;
  const Offset count = part.cells.extent(0), corners = part.cells.extent(1);
  const Index* const ids = part.cells.data();
  const IndexInterval<Index> inner(own);
  const int parts = threads_for(count);
  std::vector<std::vector<Id>> of_parts(parts);
  for_parts("GALE::outer_cells", count, parts, [&](int some, Offset first, Offset last) {
    for (Offset begin = first; begin < last; begin += block) {
      const Offset end = std::min(begin + block, last);
      if (inner.contains(ids + corners * begin, corners * (end - begin))) continue;
      for (Offset t = begin; t < end; ++t) {
        if (inner.contains(ids + corners * t, corners)) continue;
        require_cell(ids + corners * t, corners);
        of_parts[some].push_back(static_cast<Id>(t));
      }
    }
  });
  std::vector<Id> all;
  for (const auto& some : of_parts) all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// The places 0..count-1 but for those that are dropped, which ascend; none if none is.
Array<Id, HostMemory> all_but(const std::vector<Id>& dropped, Offset count) {
  if (dropped.empty()) return {};
  const auto kept = allocate<Array<Id, HostMemory>>("GALE::kept_cells", count - static_cast<Offset>(dropped.size()));
  for_parts("GALE::kept_cells", count, threads_for(count), [&](int, Offset first, Offset last) {
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

}  // namespace

/// The ranks that own the vertices of some cells of a part.
template <class Index>
class CornerOwners {
 public:
  /// Takes the `outer` ones: the others have vertices in `own` alone. Collective. Throws gale::Error on all ranks for a
  /// vertex that no rank hands over.
  CornerOwners(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
               const IdInterval& own, const std::vector<Id>& outer);

  /// Calls visit(rank) once for each rank that owns a vertex of a cell.
  template <class Visit>
  void visit_ranks(Offset t, const Visit& visit) const {
    int ranks[4];
    for (std::size_t corner = 0; corner < part_.cells.extent(1); ++corner) {
      ranks[corner] = owner(part_.cells(t, corner));
      bool is_new = true;
      for (std::size_t other = 0; other < corner; ++other) is_new &= ranks[other] != ranks[corner];
      if (is_new) visit(ranks[corner]);
    }
  }

 private:
  int owner(GlobalId vertex) const {
    if (own_.contains(vertex)) return rank_;
    const Id place = given_.find(vertex);
    return place != no_id ? of_given_(place).owner : of_others_(others_.find(vertex)).owner;
  }
  void refuse_unknown() const;

  int rank_;
  const MeshPart<Index>& part_;
  const IdInterval own_;
  GlobalIndex given_;   ///< vertices that this rank hands over, where `own` is empty
  GlobalIndex others_;  ///< vertices that the cells have beside these
  Array<VertexEntry, HostMemory> of_given_, of_others_;
};

template <class Index>
CornerOwners<Index>::CornerOwners(const Communicator& ranks, const MeshPart<Index>& part,
                                  const VertexDirectory& directory, const IdInterval& own, const std::vector<Id>& outer)
    : rank_(ranks.rank()), part_(part), own_(own) {
  GlobalIds others;
  together(ranks, [&] {
    if (own.is_empty()) given_ = GlobalIndex(distinct_ids(part.vertex_ids).ids);
    others = missing_ids(given_, static_cast<Offset>(outer.size()), [&](Offset i, const auto& offer) {
      for (std::size_t corner = 0; corner < part.cells.extent(1); ++corner) {
        const GlobalId vertex = part.cells(outer[i], corner);
        if (!own.contains(vertex)) offer(vertex);
      }
    });
    others_ = GlobalIndex(others);
  });
  of_given_ = directory.find(given_.ids());
  of_others_ = directory.find(others);
  together(ranks, [&] { refuse_unknown(); });
}

template <class Index>
void CornerOwners<Index>::refuse_unknown() const {
  for (Offset i = 0; i < others_.count(); ++i) {
    if (of_others_(i).giver < 0)
      throw Error("a cell has vertex " + std::to_string(others_[i]) + ", which no rank hands over");
  }
}

void require_local(const Communicator& ranks, const char* name, Offset count, Offset most) {
  const Offset greatest = -ranks.least(-count);
  if (greatest <= most) return;
  const double shares = static_cast<double>(greatest) * ranks.size() / static_cast<double>(most);
  throw SharedError("a rank would hold " + std::to_string(greatest) + ' ' + name + ", but at most " +
                    std::to_string(most) + " fit: take at least " + std::to_string(static_cast<Offset>(shares) + 1) +
                    " ranks");
}

template <class Index>
LocalCells<Index>::LocalCells(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
                              const IdInterval& own, Offset most_local)
    : part_(part), own_(own) {
  const GlobalId first_id = ranks.sum_before(part.cells.extent(0));
  std::vector<Id> outer;
  together(ranks, [&] { outer = cells_beyond(part, own); });
  Dealt<SentCell<Index>> sent;
  const KeptCells kept = choose(ranks, directory, outer, first_id, sent);
  received_ = exchange(ranks, "GALE::received_cells", sent);
  require_local(ranks, "cells", kept.count + received_.count(), most_local);
  together(ranks, [&] {
    places_ = CellPlaces(kept, tabulated<GlobalId>("GALE::received_ids", received_.count(),
                                                   [&](Offset i) { return received_.entries(i).id; }));
  });
}

/// Says which cells with vertices outside `own` are kept, and which go to others.
template <class Index>
KeptCells LocalCells<Index>::choose(const Communicator& ranks, const VertexDirectory& directory,
                                    const std::vector<Id>& outer, GlobalId first_id, Dealt<SentCell<Index>>& sent) {
  const CornerOwners<Index> owners(ranks, part_, directory, own_, outer);
  KeptCells all_kept;
  together(ranks, [&] {
    const int here = ranks.rank();
    const ByRank groups = by_rank(ranks.size(), static_cast<Offset>(outer.size()),
                                  [&](Id i, const auto& visit) { owners.visit_ranks(outer[i], visit); });
    std::vector<std::int64_t> counts(ranks.size());
    for (int rank = 0; rank < ranks.size(); ++rank) counts[rank] = groups.begin[rank + 1] - groups.begin[rank];
    const Offset kept = std::exchange(counts[here], 0), kept_from = groups.begin[here];
    outer_.resize(kept);
    parallel_for("GALE::outer_cells", HostExecutionSpace(), kept,
                 [&](Offset i) { outer_[i] = outer[groups.members(kept_from + i)]; });
    std::vector<Id> dropped;
    std::set_difference(outer.begin(), outer.end(), outer_.begin(), outer_.end(), std::back_inserter(dropped));
    const Offset count = part_.cells.extent(0);
    all_kept = {count - static_cast<Offset>(dropped.size()), all_but(dropped, count), part_.cell_ids, first_id};
    sent = dealt<SentCell<Index>>("GALE::sent_cells", counts);
    parallel_for("GALE::sent_cells", HostExecutionSpace(), sent.count(), [&](Offset i) {
      const Id t = outer[groups.members(i < kept_from ? i : i + kept)];
      SentCell<Index>& cell = sent.entries(i);
      cell.id = all_kept.id_at(t);
      for (std::size_t corner = 0; corner < part_.cells.extent(1); ++corner)
        cell.vertices[corner] = part_.cells(t, corner);
    });
  });
  return all_kept;
}

template <class Index>
GlobalIds LocalCells<Index>::vertices_beside(const OwnedIds& owned) const {
  const GlobalIndex index(owned.ids);
  const auto outer = static_cast<Offset>(outer_.size());
  return missing_ids(index, outer + received_.count(), [&](Offset i, const auto& offer) {
    for (std::size_t corner = 0; corner < part_.cells.extent(1); ++corner) {
      const GlobalId vertex =
          i < outer ? part_.cells(outer_[i], corner) : received_.entries(i - outer).vertices[corner];
      if (!own_.contains(vertex)) offer(vertex);
    }
  });
}

template <class Index>
void LocalCells<Index>::require_cells() const {
  const Offset corners = part_.cells.extent(1);
  for (std::size_t t = 0; t < part_.cells.extent(0); ++t) require_cell(part_.cells.data() + corners * t, corners);
}

template class LocalCells<std::int32_t>;
template class LocalCells<std::int64_t>;

}  // namespace gale::detail
