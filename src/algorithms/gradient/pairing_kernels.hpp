#pragma once

#include <algorithm>
#include <array>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/lower_star.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/runtime/device/handed_stars.hpp>
#include <gale/runtime/device_sweep.hpp>

namespace gale::detail {

/// Where lanes put what they find at a vertex: see pair_star.
struct LaneSink {
  Id* vertex_successor;
  Id* tetrahedron_successor;
  DeviceList<Id> critical_vertices;
  DeviceList<std::array<Id, 2>> critical_edges;
  DeviceList<std::array<Id, 3>> critical_triangles;
  DeviceList<Id> critical_tetrahedra;
  DeviceList<InStar> stars;
};

/// Where one lane puts what it finds: its row of edges has a place of its own.
struct RowSink {
  const LaneSink& all;
  Id* row;

  KOKKOS_FORCEINLINE_FUNCTION EdgePairRow begin_edges(Id, Id count) const {
    EdgePairRow edges(row);
    edges.begin(count);
    return edges;
  }
  KOKKOS_FORCEINLINE_FUNCTION void set_vertex(Id vertex, Id other) const {
    all.vertex_successor[vertex] = other;
    if (other == no_id) all.critical_vertices.add(vertex);
  }
  KOKKOS_FORCEINLINE_FUNCTION void set_tetrahedron(Id tetrahedron, Id successor) const {
    all.tetrahedron_successor[tetrahedron] = successor;
  }
  KOKKOS_FORCEINLINE_FUNCTION void add_critical_edge(Id high, Id low) const { all.critical_edges.add({high, low}); }
  KOKKOS_FORCEINLINE_FUNCTION void add_critical_triangle(Id high, Id middle, Id low) const {
    all.critical_triangles.add({high, middle, low});
  }
  KOKKOS_FORCEINLINE_FUNCTION void add_critical_tetrahedron(Id tetrahedron) const {
    all.tetrahedron_successor[tetrahedron] = no_id;
    all.critical_tetrahedra.add(tetrahedron);
  }
  KOKKOS_FORCEINLINE_FUNCTION void add_to_star(Id high, Id middle, Id low, Id tetrahedron) const {
    all.stars.add({{high, middle, low}, tetrahedron});
  }
};

/// Pairs a star of so many words of cells; false if it has more.
template <int Words>
KOKKOS_FUNCTION bool pair_of_words(const std::uint64_t* keys, const LaneSink& sink, const VertexStar& star, Id* row) {
  LowerNeighbours lower;
  using Star = LowerStar<Words, have_device>;
  Star cells;
  if (!lower.find(keys, star.vertex, star.neighbours) || !cells.build(lower, star.link)) return false;
  pair_star(RowSink{sink, row}, star, lower, cells, BitQueues<Star>(cells));
  return true;
}

/// Pairs the lower stars of a segment's vertices.
struct PairStars {
  const std::uint64_t* keys;
  LaneSink sink;
  Id* words;
  Offset capacity;      ///< of words
  Offset* used;         ///< words reserved; above `capacity` it says what there should have been
  Offset* pairs_begin;  ///< of each vertex
  HandedStars large;    ///< of more than one word of cells
  int scratch_rows;     ///< that a team has scratch memory for

  struct Shared {
    Offset begin;
  };

  KOKKOS_FUNCTION static std::size_t scratch_bytes(int rows) {
    return sizeof(Shared) + (2 * std::size_t(rows) + 1) * sizeof(Id);
  }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team, const SegmentRowsIn<MemoryOfSweep<WorkerSpace>>& segment) const {
    char* const scratch = team::scratch<0>(team, scratch_bytes(scratch_rows));
    Shared& shared = *reinterpret_cast<Shared*>(scratch);
    Id* const begin = reinterpret_cast<Id*>(scratch + sizeof(Shared));
    const Rows neighbours = segment[Relation::VV], tetrahedra = segment[Relation::VT];
    const LinkRows links = segment.links();
    for (Id from = 0; from < neighbours.count; from += scratch_rows) {
      const Id rows = neighbours.count - from < scratch_rows ? neighbours.count - from : scratch_rows;
      const Id first = neighbours.first + from;
      const auto star_of = [&](Id v) { return VertexStar{v, neighbours[v], tetrahedra[v], links[v]}; };
      team::for_all(team, rows, [&](int i) { begin[i] = words_for(neighbours[first + i], first + i); });
      team::exclusive_scan(team, rows, begin);
      team::once(team, [&] {
        const Offset at = team::add(team, used, Offset(begin[rows]));
        shared.begin = at + begin[rows] <= capacity ? at : -1;
      });
      team::barrier(team);
      if (shared.begin >= 0) {
        Id* const by_size = begin + scratch_rows + 1;
        sort_by_size(team, rows, begin, by_size);
        team::for_all(team, rows, [&](int k) {
          const Id i = by_size[k];
          const Offset at = shared.begin + begin[i];
          const VertexStar star = star_of(first + i);
          pairs_begin[first + i] = at;
          if (!pair_of_words<1>(keys, sink, star, words + at)) large.add(star);
        });
      }
      team::barrier(team);
    }
  }

 private:
  /// The rows by their lengths, the longest first, so that lanes of a warp have stars of about one size.
  template <class Team>
  KOKKOS_FORCEINLINE_FUNCTION static void sort_by_size(const Team& team, Id rows, const Id* begin, Id* by_size) {
    team::for_all(team, rows, [&](int i) {
      const Id size = begin[i + 1] - begin[i];
      Id before = 0;
      for (Id k = 0; k < rows; ++k) {
        const Id other = begin[k + 1] - begin[k];
        before += other > size || (other == size && k < i);
      }
      by_size[before] = i;
    });
    team::barrier(team);
  }

  /// What the row of a vertex takes.
  KOKKOS_FORCEINLINE_FUNCTION Id words_for(const Row& neighbours, Id v) const {
    const std::uint64_t key = keys[v];
    Id lower = 0;
    for (const Id neighbour : neighbours) lower += keys[neighbour] < key;
    return static_cast<Id>(EdgePairRow::words_for(lower));
  }
};

/// Pairs the stars that PairStars hands on; those of more than two words are handed on again.
struct PairLargeStars {
  const std::uint64_t* keys;
  LaneSink sink;
  Id* words;
  const Offset* pairs_begin;
  HandedStars large;
  DeviceList<Offset> outgrown;  ///< places in `large`

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const VertexStar star = large[i];
    if (!pair_of_words<2>(keys, sink, star, words + pairs_begin[star.vertex])) outgrown.add(i);
  }
};

}  // namespace gale::detail
