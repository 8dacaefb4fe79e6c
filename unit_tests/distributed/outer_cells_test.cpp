#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>
#include <gale/distributed/sharing/local_corners.hpp>

// Cells that are written before a rank knows its ghosts.

namespace gale::test {

namespace {

using Cell = std::vector<GlobalId>;

constexpr GlobalId first_of_all = 1000;

/// Different vertices around `at`, so many apart at most, in any order.
Cell cell_around(GlobalId at, GlobalId reach, int corners, std::mt19937& random) {
  std::set<GlobalId> vertices;
  while (static_cast<int>(vertices.size()) < corners)
    vertices.insert(std::max<GlobalId>(at + static_cast<GlobalId>(random() % reach), first_of_all));
  Cell cell(vertices.begin(), vertices.end());
  std::shuffle(cell.begin(), cell.end(), random);
  return cell;
}

/// What all ranks hand over: intervals of vertices, and cells.
struct AllParts {
  GlobalId vertices = 0;  ///< of each rank
  int corners = 4;
  std::vector<std::vector<Cell>> cells;         ///< by rank
  std::vector<std::vector<GlobalId>> cell_ids;  ///< by rank

  GlobalId end() const { return first_of_all + vertices * static_cast<GlobalId>(cells.size()); }
  detail::IdInterval own(int rank) const {
    return {first_of_all + vertices * rank, first_of_all + vertices * (rank + 1)};
  }
  bool touches(const Cell& cell, int rank) const {
    return std::any_of(cell.begin(), cell.end(), [&](GlobalId v) { return own(rank).contains(v); });
  }

  /// Numbers cells from rank to rank, or so that ranks have ids in turns.
  void name_cells(bool in_turns) {
    GlobalId counted = 0;
    for (std::size_t rank = 0; rank < cells.size(); ++rank) {
      for (std::size_t t = 0; t < cells[rank].size(); ++t)
        cell_ids[rank].push_back(in_turns ? static_cast<GlobalId>(t * cells.size() + rank) : counted++);
    }
  }

  /// A cell of each id that a rank is to hold.
  std::map<GlobalId, Cell> held_by(int rank) const {
    std::map<GlobalId, Cell> held;
    for (std::size_t from = 0; from < cells.size(); ++from) {
      for (std::size_t t = 0; t < cells[from].size(); ++t) {
        if (touches(cells[from][t], rank)) held[cell_ids[from][t]] = cells[from][t];
      }
    }
    return held;
  }
};

/// Which cells ranks hand over: those of their own vertices alone, those at borders, too, or none of their own.
enum class Mix { inner, few_outer, all_outer, anywhere };

AllParts parts_of(int ranks, int corners, Mix mix, Offset cells_of_each, bool in_turns) {
  std::mt19937 random(41);
  AllParts all{200, corners, std::vector<std::vector<Cell>>(ranks), std::vector<std::vector<GlobalId>>(ranks)};
  const GlobalId reach = 12;
  for (Offset t = 0; t < cells_of_each; ++t) {
    for (int rank = 0; rank < ranks; ++rank) {
      const detail::IdInterval own = all.own(rank);
      GlobalId at = own.begin + static_cast<GlobalId>(random() % (all.vertices - reach));
      if (mix == Mix::few_outer && t % 9 == 0) at = own.end - 6;
      if (mix == Mix::all_outer) at = own.end - 1 - static_cast<GlobalId>(random() % 3);
      if (mix == Mix::anywhere)
        at = first_of_all + static_cast<GlobalId>(random() % (all.end() - first_of_all - reach));
      Cell cell = cell_around(std::min(at, all.end() - reach), reach, corners, random);
      if (mix == Mix::inner && !std::all_of(cell.begin(), cell.end(), [&](GlobalId v) { return own.contains(v); }))
        continue;
      all.cells[rank].push_back(cell);
    }
  }
  all.name_cells(in_turns);
  return all;
}

/// What one rank hands over, with what its Views read.
template <class Index>
struct OnePart {
  std::vector<GlobalId> ids;
  std::vector<Index> corners;
  MeshPart<Index> part;

  OnePart(const AllParts& all, int rank, bool with_ids) {
    const detail::IdInterval own = all.own(rank);
    for (GlobalId id = own.begin; id < own.end; ++id) ids.push_back(id);
    for (const Cell& cell : all.cells[rank]) corners.insert(corners.end(), cell.begin(), cell.end());
    part.vertex_ids = Array<const GlobalId, HostMemory>(ids.data(), ids.size());
    part.cells = CellRows<Index>(corners.data(), all.cells[rank].size(), all.corners);
    if (with_ids) part.cell_ids = Array<const GlobalId, HostMemory>(all.cell_ids[rank].data(), all.cells[rank].size());
  }
};

/// The local input ids of all cells a rank holds, by a set of their vertices and its own.
std::vector<Id> expected_corners(const AllParts& all, int rank) {
  const auto held = all.held_by(rank);
  std::set<GlobalId> vertices;
  for (GlobalId id = all.own(rank).begin; id < all.own(rank).end; ++id) vertices.insert(id);
  for (const auto& [id, cell] : held) vertices.insert(cell.begin(), cell.end());
  std::map<GlobalId, Id> numbers;
  for (const GlobalId id : vertices) numbers.emplace(id, static_cast<Id>(numbers.size()));
  std::vector<Id> corners;
  for (const auto& [id, cell] : held) {
    for (const GlobalId v : cell) corners.push_back(numbers.at(v));
  }
  return corners;
}

/// Compares what is written for `Space`, and then put in place, with what is expected.
template <class Space, class Index>
void expect_placed(const Communicator& ranks, const AllParts& all, bool with_ids) {
  const int rank = ranks.rank();
  const OnePart<Index> mine(all, rank, with_ids);
  const detail::IdInterval own = all.own(rank);
  const auto read = detail::write_cells(Space(), mine.part, own);
  std::vector<Id> outer;
  const auto rows = on_host(read.rows);
  ASSERT_EQ(rows.extent(0), all.cells[rank].size());
  for (std::size_t t = 0; t < rows.extent(0); ++t) {
    const Cell& cell = all.cells[rank][t];
    const bool is_outer = !std::all_of(cell.begin(), cell.end(), [&](GlobalId v) { return own.contains(v); });
    if (is_outer) outer.push_back(static_cast<Id>(t));
    for (int k = 0; k < 4; ++k)
      ASSERT_EQ(rows(t)[k], is_outer ? 0 : cell[std::min(k, all.corners - 1)] - own.begin) << "cell " << t;
  }
  ASSERT_EQ(read.outer.count, static_cast<Offset>(outer.size()));
  for (std::size_t i = 0; i < outer.size(); ++i) ASSERT_EQ(read.outer[i], outer[i]);

  const detail::VertexDirectory directory(ranks, *detail::GivenIntervals::of(ranks, own));
  const detail::LocalCells<Index> cells(ranks, mine.part, directory, own, read.outer, 1 << 30);
  ASSERT_TRUE(cells.places().keep_order());
  const detail::OwnedIds owned(own);
  const detail::LocalVertices vertices(owned, cells.vertices_beside(owned));
  const auto there = detail::corners_of_rows(Space(), cells, vertices, read.rows);
  const auto placed = vector_of(Array<const Id, MemoryOf<Space>>(there.data(), there.size()));
  const std::vector<Id> expected = expected_corners(all, rank);
  ASSERT_EQ(placed.size(), expected.size());
  EXPECT_EQ(placed, expected);
  const auto on_host_alone = detail::local_corners(cells, vertices);
  ASSERT_EQ(on_host_alone.size(), expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), on_host_alone.data()));
}

template <class Index>
void expect_placed_in_each_space(const Communicator& ranks, const AllParts& all, bool with_ids) {
  expect_placed<HostExecutionSpace, Index>(ranks, all, with_ids);
  if constexpr (have_device) expect_placed<WorkerSpace, Index>(ranks, all, with_ids);
}

/// While it lives, loops have three threads, whose parts end anywhere among blocks.
class ThreeThreads {
 public:
  ThreeThreads() { set_host_threads(3); }
  ~ThreeThreads() { set_host_threads(before_); }

 private:
  const int before_ = host_threads();
};

}  // namespace

TEST(OuterCells, are_found_and_placed_as_by_maps) {
  const Communicator ranks(MPI_COMM_WORLD);
  const ThreeThreads threads;
  for (const int corners : {3, 4}) {
    for (const Mix mix : {Mix::inner, Mix::few_outer, Mix::all_outer, Mix::anywhere}) {
      for (const Offset count : {0, 1, 63, 64, 65, 12301}) {
        for (const bool with_ids : {false, true}) {
          const AllParts all = parts_of(ranks.size(), corners, mix, count, with_ids);
          expect_placed_in_each_space<std::int32_t>(ranks, all, with_ids);
          expect_placed_in_each_space<std::int64_t>(ranks, all, with_ids);
        }
      }
    }
  }
}

/// A device gets 131,072 rows at once.
TEST(OuterCells, at_borders_of_chunks_are_found_and_placed) {
  const Communicator ranks(MPI_COMM_WORLD);
  const ThreeThreads threads;
  constexpr Offset chunk = 131072;
  AllParts all{200, 4, std::vector<std::vector<Cell>>(ranks.size()), std::vector<std::vector<GlobalId>>(ranks.size())};
  for (int rank = 0; rank < std::min(ranks.size(), 2); ++rank) {
    const GlobalId begin = all.own(rank).begin, others = all.own(rank == 0 ? ranks.size() - 1 : 0).begin + 100;
    for (Offset t = 0; t < 2 * chunk + 7; ++t)
      all.cells[rank].push_back({begin, begin + 1 + t % 90, begin + 95, begin + 91});
    for (const Offset t : {Offset(0), chunk - 1, chunk, 2 * chunk - 1, 2 * chunk}) all.cells[rank][t][t % 4] = others;
    for (const Offset t : {chunk - 2, chunk + 1, 2 * chunk + 6})
      all.cells[rank][t] = {others, others + 3, others + 1, others + 2};
  }
  all.name_cells(false);
  expect_placed_in_each_space<std::int32_t>(ranks, all, false);
}

}  // namespace gale::test
