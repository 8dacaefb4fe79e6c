#include <gale/base/atomic.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/encode/cells.hpp>

// T_ex without a sort of its entries: a team marks which of some consecutive cells touch which segment, a bit each. So
// the cells of a mark ascend, and marks are put in order, some thirty times fewer than entries.

namespace gale::detail {

namespace {

constexpr int cells_of_chunk = 512, words_of_chunk = cells_of_chunk / 32;

/// Segments that a team tells apart: some twenty are usual. Where a chunk touches more, its team goes through it piece
/// by piece, whose cells touch three each at most.
constexpr int most_marked = 64, cells_of_piece = 16;
static_assert(3 * cells_of_piece < most_marked);

/// Which cells of chunks touch which segments: a run for each pair of these. In no order.
template <class Memory>
struct Runs {
  Array<std::uint64_t, Memory> keys;  ///< the pair_key of a segment and of its run's chunk or piece, by the first cell
  Array<Offset, Memory> begin;        ///< where its cells begin among `cells`
  Array<Id, Memory> count;            ///< how many they are
  Array<Id, Memory> cells;            ///< run by run, ascending in each

  Runs(Offset runs, Offset members)
      : keys(allocate<Array<std::uint64_t, Memory>>("GALE::run_keys", runs)),
        begin(allocate<Array<Offset, Memory>>("GALE::run_begin", runs)),
        count(allocate<Array<Id, Memory>>("GALE::run_count", runs)),
        cells(allocate<Array<Id, Memory>>("GALE::run_cells", members)) {}
};

/// What a team keeps of the cells that it goes through.
struct Marks {
  std::uint32_t bits[words_of_chunk * most_marked];  ///< word by word, in each by place of the segment
  Id segment[most_marked];                           ///< by place; no_id where there is none
  int place[most_marked];                            ///< of each segment that is there, as they came
  int begin[most_marked + 1];                        ///< where its cells begin among the team's
  int segments;
  bool are_too_many;
  Offset first_run, first_cell;  ///< the team's own among all
};

/// A team's work: finds the runs of a chunk of cells. Writes them where there is room, and counts them anyway.
template <class Memory>
struct FindRuns {
  static constexpr int scratch_level = 0;

  ExternalSegments segments_of;
  Offset cells;
  Runs<Memory> runs;
  Offset* found;  ///< how many runs, and how many cells in them

  KOKKOS_FUNCTION std::size_t scratch_bytes() const { return sizeof(Marks); }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    Marks& marks = *reinterpret_cast<Marks*>(team::scratch<scratch_level>(team, scratch_bytes()));
    const Offset first = static_cast<Offset>(team.league_rank()) * cells_of_chunk, left = cells - first;
    const int count = left < cells_of_chunk ? static_cast<int>(left) : cells_of_chunk;
    if (mark(team, marks, static_cast<Id>(first), count)) return write(team, marks, static_cast<Id>(first));
    for (int piece = 0; piece < count; piece += cells_of_piece) {
      const int size = count - piece < cells_of_piece ? count - piece : cells_of_piece;
      mark(team, marks, static_cast<Id>(first + piece), size);
      write(team, marks, static_cast<Id>(first + piece));
    }
  }

 private:
  /// Returns false if there are too many segments.
  template <class Team>
  KOKKOS_FUNCTION bool mark(const Team& team, Marks& marks, Id first, int count) const {
    team::barrier(team);  // for what others still read
    team::for_all(team, most_marked, [&](int place) { marks.segment[place] = no_id; });
    team::for_all(team, words_of_chunk * most_marked, [&](int i) { marks.bits[i] = 0; });
    team::once(team, [&] {
      marks.segments = 0;
      marks.are_too_many = false;
    });
    team::barrier(team);
    team::for_all(team, count, [&](int i) {
      segments_of(first + i, [&](Id segment) {
        const int place = place_of(team, marks, segment);
        if (place < 0) {
          marks.are_too_many = true;
        } else {
          team::set_bits(team, &marks.bits[i / 32 * most_marked + place], std::uint32_t(1) << (i % 32));
        }
      });
    });
    team::barrier(team);
    return !marks.are_too_many;
  }

  /// The place of a segment, which is given one if it has none; below 0 if all are taken.
  template <class Team>
  KOKKOS_FUNCTION int place_of(const Team& team, Marks& marks, Id segment) const {
    int place = static_cast<int>(spread(static_cast<std::uint64_t>(segment)) % most_marked);
    for (int tried = 0; tried < most_marked; ++tried) {
      const Id there = marks.segment[place] == no_id ? team::exchange_if(team, &marks.segment[place], no_id, segment)
                                                     : marks.segment[place];
      if (there == no_id) marks.place[team::add(team, &marks.segments, 1)] = place;
      if (there == no_id || there == segment) return place;
      place = (place + 1) % most_marked;
    }
    return -1;
  }

  template <class Team>
  KOKKOS_FUNCTION void write(const Team& team, Marks& marks, Id first) const {
    const int segments = marks.segments;
    team::for_all(team, segments, [&](int i) { marks.begin[i] = cells_before(marks, words_of_chunk, marks.place[i]); });
    team::exclusive_scan(team, segments, marks.begin);
    team::once(team, [&] {
      marks.first_run = atomic_add(&found[0], Offset(segments));
      marks.first_cell = atomic_add(&found[1], Offset(marks.begin[segments]));
    });
    team::barrier(team);
    if (marks.first_run + segments > static_cast<Offset>(runs.keys.extent(0)) ||
        marks.first_cell + marks.begin[segments] > static_cast<Offset>(runs.cells.extent(0)))
      return;
    team::for_all(team, segments * words_of_chunk, [&](int item) {
      const int i = item / words_of_chunk, word = item % words_of_chunk, place = marks.place[i];
      if (word == 0) {
        const Offset run = marks.first_run + i;
        runs.keys(run) = pair_key(marks.segment[place], first);
        runs.begin(run) = marks.first_cell + marks.begin[i];
        runs.count(run) = marks.begin[i + 1] - marks.begin[i];
      }
      std::uint32_t bits = marks.bits[word * most_marked + place];
      if (bits == 0) return;
      Id* to = runs.cells.data() + marks.first_cell + marks.begin[i] + cells_before(marks, word, place);
      for (; bits != 0; bits &= bits - 1) *to++ = first + 32 * word + lowest_bit(bits);
    });
  }

  /// How many of the cells in the first so many words touch the segment at a place.
  static KOKKOS_FUNCTION int cells_before(const Marks& marks, int words, int place) {
    int sum = 0;
    for (int word = 0; word < words; ++word) sum += count_bits(marks.bits[word * most_marked + place]);
    return sum;
  }
};

/// A team's work: copies some runs, a warp each, to where they go.
template <class Memory>
struct CopyRuns {
  static constexpr int runs_of_team = 64;

  Runs<Memory> runs;
  Array<Id, Memory> in_order;
  Array<Offset, Memory> to;
  Array<Id, Memory> external;

  KOKKOS_FUNCTION std::size_t scratch_bytes() const { return 0; }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const Offset first = static_cast<Offset>(team.league_rank()) * runs_of_team,
                 left = static_cast<Offset>(in_order.extent(0)) - first;
    team::for_warps(team, left < runs_of_team ? static_cast<int>(left) : runs_of_team, [&](int i) {
      const Id run = in_order(first + i);
      const Id* const from = runs.cells.data() + runs.begin(run);
      Id* const here = external.data() + to(first + i);
      team::for_lanes(team, runs.count(run), [&](int k) { here[k] = from[k]; });
    });
  }
};

constexpr int warps_of_team = 8;

/// All runs. Memory is guessed first, and taken again where that was too little.
template <class Space>
Runs<MemoryOf<Space>> find_runs(const Space& space, const ExternalSegments& segments_of, Offset cells) {
  using Memory = MemoryOf<Space>;
  const Offset teams = (cells + cells_of_chunk - 1) / cells_of_chunk;
  const auto found = allocate<Array<Offset, Memory>>("GALE::runs_found", 2);
  Offset runs = 32 * teams, members = cells;
  for (;;) {
    Runs<Memory> all(runs, members);
    fill("GALE::runs_found", space, found, Offset(0));
    for_teams("GALE::external_runs", space, teams, warps_of_team, cells,
              FindRuns<Memory>{segments_of, cells, all, found.data()});
    const auto counts = on_host(found);
    const bool fit = counts(0) <= runs && counts(1) <= members;
    runs = counts(0);
    members = counts(1);
    if (!fit) continue;
    all.keys = first_of(all.keys, static_cast<std::size_t>(runs));
    return all;
  }
}

}  // namespace

template <class Space>
Array<Id, MemoryOf<Space>> segments_of_blocks(const Space& space, const Borrowed<Id, MemoryOf<Space>>& vertex_begin,
                                              Offset vertices) {
  constexpr int bits = SegmentOfVertex::block_bits;
  const auto blocks = allocate<Array<Id, MemoryOf<Space>>>("GALE::segment_of", (vertices >> bits) + 1);
  const auto segments = static_cast<Id>(vertex_begin.extent(0)) - 1;
  parallel_for(
      "GALE::segment_of", space, blocks.extent(0), KOKKOS_LAMBDA(Offset block) {
        blocks(block) = bisect(Id(0), segments, [&](Id segment) { return vertex_begin(segment + 1) <= block << bits; });
      });
  return blocks;
}

template <class Space>
Csr<Id, MemoryOf<Space>> find_external_cells(const Space& space, const Csr<Quad, MemoryOf<Space>, Id>& cells_of_lowest,
                                             const Borrowed<Id, MemoryOf<Space>>& vertex_begin) {
  using Memory = MemoryOf<Space>;
  using Offsets = Array<Offset, Memory>;
  const auto& cells = cells_of_lowest.entries;
  const auto blocks = segments_of_blocks(space, vertex_begin, cells_of_lowest.rows());
  const Runs<Memory> runs =
      find_runs(space, ExternalSegments{cells.data(), {blocks.data(), vertex_begin.data()}}, cells.extent(0));
  const auto keys = runs.keys;
  const auto in_order = stable_sort_places(space, "GALE::run_order", keys);
  const auto count = static_cast<Offset>(keys.extent(0)), segments = static_cast<Offset>(vertex_begin.extent(0)) - 1;
  const auto to = allocate<Offsets>("GALE::run_to", count + 1);
  const auto sizes = runs.count;
  const Offset members = exclusive_scan(
      "GALE::run_to", space, count, to, KOKKOS_LAMBDA(Offset run) { return sizes(in_order(run)); });
  const Csr<Id, Memory> external{allocate<Offsets>("GALE::external_begin", segments + 1),
                                 allocate<Array<Id, Memory>>("GALE::external", members)};
  const auto begin = external.offsets;
  parallel_for(
      "GALE::external_begin", space, segments + 1, KOKKOS_LAMBDA(Offset segment) {
        begin(segment) = to(bisect(Offset(0), count, [&](Offset run) { return pair_first(keys(run)) < segment; }));
      });
  for_teams("GALE::external", space, (count + CopyRuns<Memory>::runs_of_team - 1) / CopyRuns<Memory>::runs_of_team,
            warps_of_team, members, CopyRuns<Memory>{runs, in_order, to, external.entries});
  return external;
}

#define GALE_INSTANTIATE(Space)                                                                                       \
  template Array<Id, MemoryOf<Space>> segments_of_blocks(const Space&, const Borrowed<Id, MemoryOf<Space>>&, Offset); \
  template Csr<Id, MemoryOf<Space>> find_external_cells(const Space&, const Csr<Quad, MemoryOf<Space>, Id>&,          \
                                                        const Borrowed<Id, MemoryOf<Space>>&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
