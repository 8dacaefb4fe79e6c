#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <gale/distributed/sharing/local_cells.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// Whether a cell's vertices are 0 or more, and different.
template <int corners, class Index>
bool is_cell(const Index* cell) {
  bool is_one = true;
  for (int k = 0; k < corners; ++k) {
    is_one &= cell[k] >= 0;
    for (int other = 0; other < k; ++other) is_one &= cell[other] != cell[k];
  }
  return is_one;
}

/// Throws for a cell that is none.
template <int corners, class Index>
void require_cell(const Index* cell) {
  if (is_cell<corners>(cell)) return;
  std::string vertices;
  for (int k = 0; k < corners; ++k) vertices += ' ' + std::to_string(cell[k]);
  throw Error("the cell of vertices" + vertices + " is none: they must be different, and 0 or more");
}

/// The vertices that some cells of a part have outside `own` and `handed`, ascending, none twice. Throws gale::Error
/// for one of these cells whose vertices are below 0 or not different.
template <class Index>
GlobalIds vertices_outside(const MeshPart<Index>& part, const IdInterval& own, const GlobalIds& handed,
                           const SomeCells& outer) {
  const IndexInterval<Index> inner(own.is_empty() ? interval_of(handed) : own);  // spares most searches
  GlobalIds others;
  with_constant(part.cells.extent(1), [&](auto corners) {
    others = missing_ids(GlobalIndex(handed), outer.count, [&](Offset i, const auto& offer) {
      const Index* const cell = part.cells.data() + corners * Offset(outer[i]);
      require_cell<corners>(cell);
      for (int k = 0; k < corners; ++k) {
        if (!inner.contains(cell[k])) offer(cell[k]);
      }
    });
  });
  return others;
}

/// The places 0..count-1 but for those that are dropped, which ascend.
Array<Id, HostMemory> all_but(const std::vector<Id>& dropped, Offset count) {
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

/// The cells of a part that are kept: all but those of `outer` which `kept_outer` lacks.
template <class Index>
KeptCells kept_of(const MeshPart<Index>& part, const SomeCells& outer, const Array<Id, HostMemory>& kept_outer,
                  GlobalId first_id) {
  const Offset count = part.cells.extent(0), all = count - outer.count + Offset(kept_outer.extent(0));
  if (all == count) return {all, {}, part.cell_ids, first_id};
  if (outer.count == count) return {all, kept_outer, part.cell_ids, first_id};
  std::vector<Id> dropped;
  std::set_difference(outer.places.data(), outer.places.data() + outer.count, kept_outer.data(),
                      kept_outer.data() + kept_outer.extent(0), std::back_inserter(dropped));
  return {all, all_but(dropped, count), part.cell_ids, first_id};
}

}  // namespace

/// The ranks that own the vertices of some cells of a part.
template <class Index>
class CornerOwners {
 public:
  /// Takes the `outer` ones: the others have vertices in `own` alone. Collective. Throws gale::Error on all ranks for a
  /// vertex that no rank hands over.
  CornerOwners(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
               const IdInterval& own, const SomeCells& outer);

  /// Calls visit(rank) once for each rank that owns a vertex of a cell of `corners` vertices.
  template <int corners, class Visit>
  void visit_ranks(Offset t, const Visit& visit) const {
    const Index* const cell = part_.cells.data() + corners * t;
    int ranks[corners];
    bool is_one = true;  // as mostly
    for (int k = 0; k < corners; ++k) {
      ranks[k] = own_.contains(cell[k]) ? rank_ : owners_(vertices_.find(cell[k]));
      is_one &= ranks[k] == ranks[0];
    }
    visit(ranks[0]);
    for (int k = 1; !is_one && k < corners; ++k) {
      if (std::find(ranks, ranks + k, ranks[k]) == ranks + k) visit(ranks[k]);
    }
  }

 private:
  void fill(const DistinctIds& handed, const GlobalIds& others, const VertexDirectory& directory,
            const Array<VertexEntry, HostMemory>& of_others);

  int rank_;
  const MeshPart<Index>& part_;
  const IndexInterval<Index> own_;
  GlobalIndex vertices_;           ///< what the cells have outside `own`, and what the part hands over
  Array<int, HostMemory> owners_;  ///< of these vertices
};

template <class Index>
CornerOwners<Index>::CornerOwners(const Communicator& ranks, const MeshPart<Index>& part,
                                  const VertexDirectory& directory, const IdInterval& own, const SomeCells& outer)
    : rank_(ranks.rank()), part_(part), own_(own) {
  DistinctIds handed;
  GlobalIds others;
  together(ranks, [&] {
    if (own.is_empty()) handed = distinct_ids(part.vertex_ids);
    others = vertices_outside(part, own, handed.ids, outer);
  });
  const auto of_others = directory.find(others);
  together(ranks, [&] { fill(handed, others, directory, of_others); });
}

/// Merges the owners of what the part hands over, which are known, and of others.
template <class Index>
void CornerOwners<Index>::fill(const DistinctIds& handed, const GlobalIds& others, const VertexDirectory& directory,
                               const Array<VertexEntry, HostMemory>& of_others) {
  const Offset count = others.extent(0);
  const Offset unknown = reduce_min("GALE::unknown_vertex", HostExecutionSpace(), count, count,
                                    [&](Offset i) { return of_others(i).giver < 0 ? i : count; });
  if (unknown < count)
    throw Error("a cell has vertex " + std::to_string(others(unknown)) + ", which no rank hands over");
  const auto ids = allocate<GlobalIds>("GALE::outer_vertices", handed.ids.extent(0) + count);
  owners_ = allocate<Array<int, HostMemory>>("GALE::owners_of_outer", ids.extent(0));
  visit_merged(handed.ids, others, [&](Offset i, Offset place) {
    ids(place) = handed.ids(i);
    owners_(place) = directory.owner_of_handed(handed.places(i));
  });
  visit_merged(others, handed.ids, [&](Offset i, Offset place) {
    ids(place) = others(i);
    owners_(place) = of_others(i).owner;
  });
  vertices_ = GlobalIndex(ids, GlobalIndex::Lookups::many);
}

void require_local(const Communicator& ranks, const char* name, Offset count, Offset most) {
  require_fits(ranks.size(), name, -ranks.least(-count), most);
}

void require_fits(int ranks, const char* name, Offset greatest, Offset most) {
  if (greatest <= most) return;
  const double shares = static_cast<double>(greatest) * ranks / static_cast<double>(most);
  throw SharedError("a rank would hold " + std::to_string(greatest) + ' ' + name + ", but at most " +
                    std::to_string(most) + " fit: take at least " + std::to_string(static_cast<Offset>(shares) + 1) +
                    " ranks");
}

template <class Index>
LocalCells<Index>::LocalCells(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
                              const IdInterval& own, const SomeCells& outer, Offset most_local)
    : part_(part), own_(own) {
  const GlobalId first_id = ranks.sum_before(part.cells.extent(0));
  SentCells<Index> sent;
  const KeptCells kept = choose(ranks, directory, outer, first_id, sent);
  received_.ids = exchange_packed(ranks, "GALE::received_ids", sent.ids);
  together(ranks, [&] {
    auto counts = counts_of(received_.ids);
    for (std::int64_t& count : counts) count *= corners();
    received_.vertices = room_to_receive<Index>("GALE::received_vertices", counts);
  });
  exchange(ranks, sent.vertices, received_.vertices);
  require_local(ranks, "cells", kept.count + received_.count(), most_local);
  together(ranks, [&] { places_ = CellPlaces(kept, received_.ids.entries); });
}

/// Says which cells with vertices outside `own` are kept, and which go to others.
template <class Index>
KeptCells LocalCells<Index>::choose(const Communicator& ranks, const VertexDirectory& directory, const SomeCells& outer,
                                    GlobalId first_id, SentCells<Index>& sent) {
  const CornerOwners<Index> owners(ranks, part_, directory, own_, outer);
  KeptCells all_kept;
  together(ranks, [&] {
    const int here = ranks.rank();
    EntriesByRank<Id> groups;
    with_constant(corners(), [&](auto corners) {
      groups = group_by_rank(ranks.size(), outer.count,
                             [&](Id i, const auto& visit) { owners.template visit_ranks<corners>(outer[i], visit); });
    });
    auto counts = counts_of(groups);
    const Offset kept = std::exchange(counts[here], 0), kept_from = groups.begin[here];
    outer_ = tabulated<Id>("GALE::kept_outer", kept, [&](Offset i) { return outer[groups.entries(kept_from + i)]; });
    all_kept = kept_of(part_, outer, outer_, first_id);
    sent.ids = room_by_rank<GlobalId>("GALE::sent_ids", counts);
    for (std::int64_t& count : counts) count *= corners();
    sent.vertices = room_by_rank<Index>("GALE::sent_vertices", counts);
    with_constant(corners(), [&](auto corners) {
      parallel_for("GALE::sent_cells", HostExecutionSpace(), sent.count(), [&](Offset i) {
        const Offset t = outer[groups.entries(i < kept_from ? i : i + kept)];
        sent.ids.entries(i) = all_kept.id_at(t);
        std::copy_n(part_.cells.data() + corners * t, int(corners), sent.vertices.entries.data() + corners * i);
      });
    });
  });
  return all_kept;
}

template <class Index>
GlobalIds LocalCells<Index>::vertices_beside(const OwnedIds& owned) const {
  const GlobalIndex index(owned.ids, GlobalIndex::Lookups::many);
  const IndexInterval<Index> own(own_);
  const Offset outer = outer_.extent(0);
  GlobalIds beside;
  with_constant(corners(), [&](auto corners) {
    beside = missing_ids(index, outer + received_.count(), [&](Offset i, const auto& offer) {
      const Index* const cell = i < outer ? part_vertices(outer_(i)) : received_vertices(i - outer);
      for (int k = 0; k < corners; ++k) {
        if (!own.contains(cell[k])) offer(cell[k]);
      }
    });
  });
  return beside;
}

template <class Index>
void LocalCells<Index>::require_cells() const {
  with_constant(corners(), [&](auto corners) {
    for (std::size_t t = 0; t < part_.cells.extent(0); ++t) require_cell<corners>(part_.cells.data() + corners * t);
  });
}

template class LocalCells<std::int32_t>;
template class LocalCells<std::int64_t>;

}  // namespace gale::detail
