#include <algorithm>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include <gale/base/transfer.hpp>
#include <gale/distributed/sharing/outer_cells.hpp>

namespace gale::detail {

namespace {

constexpr Offset block = 64;  ///< cells that are compared with an interval at once

/// Calls visit(begin, end) for the blocks of cells first..last-1.
template <class Visit>
void for_blocks(Offset first, Offset last, const Visit& visit) {
  for (Offset begin = first; begin < last; begin += block) visit(begin, std::min(begin + block, last));
}

}  // namespace

/// The outer ones among a part's cells.
template <class Index>
class OuterCells {
 public:
  OuterCells(const MeshPart<Index>& part, const IdInterval& own)
      : ids_(part.cells.data()), corners_(part.cells.extent(1)), inner_(own) {}

  /// Adds those among cells first..last-1 to `outer`.
  void find(Offset first, Offset last, std::vector<Id>& outer) const {
    for_blocks(first, last, [&](Offset begin, Offset end) {
      if (!inner_.contains(ids_ + corners_ * begin, corners_ * (end - begin))) add(begin, end, outer);
    });
  }

  /// Writes the rows of cells first..last-1, too.
  void write(Offset first, Offset last, Quad* to, std::vector<Id>& outer) const {
    for_blocks(first, last, [&](Offset begin, Offset end) {
      const Index* const ids = ids_ + corners_ * begin;
      bool are_inner = true;
      if (corners_ == 4) {
        are_inner = inner_.write_places(ids, 4 * (end - begin), reinterpret_cast<Id*>(to));
      } else {
        for (Offset t = 0; t < end - begin; ++t) {
          are_inner &= inner_.write_places(ids + 3 * t, 3, reinterpret_cast<Id*>(to + t));
          to[t].d = to[t].c;
        }
      }
      if (!are_inner) {
        const std::size_t before = outer.size();
        add(begin, end, outer);
        for (std::size_t i = before; i < outer.size(); ++i) to[outer[i] - begin] = {0, 0, 0, 0};
      }
      to += end - begin;
    });
  }

 private:
  void add(Offset begin, Offset end, std::vector<Id>& outer) const {
    for (Offset t = begin; t < end; ++t) {
      if (!inner_.contains(ids_ + corners_ * t, corners_)) outer.push_back(static_cast<Id>(t));
    }
  }

  const Index* const ids_;
  const Offset corners_;
  const IndexInterval<Index> inner_;
};

namespace {

SomeCells some_cells(std::vector<std::vector<Id>> parts) {
  const auto places = concatenated(std::move(parts));
  return {static_cast<Offset>(places.size()), array_of("GALE::outer_cells", places)};
}

/// The outer cells alone.
template <class Index>
SomeCells outer_cells(const MeshPart<Index>& part, const IdInterval& own) {
  const Offset count = part.cells.extent(0);
  if (own.is_empty()) return {count, {}};
  const OuterCells<Index> cells(part, own);
  return some_cells(of_parts("GALE::outer_cells", count, [&](Offset first, Offset last) {
    std::vector<Id> mine;
    cells.find(first, last, mine);
    return mine;
  }));
}

/// Writes `count` rows where a device reads them, by write(first, last, to, outer). Returns the outer ones.
template <class Write>
SomeCells write_rows_to_device(Quad* rows, Offset count, const Write& write) {
  std::mutex mutex;
  std::map<Offset, std::vector<Id>> by_first;  // of a piece
  by_first[0];
  write_to_device(rows, static_cast<std::size_t>(count) * sizeof(Quad),
                  [&](char* to, std::size_t begin, std::size_t size) {
                    const auto first = static_cast<Offset>(begin / sizeof(Quad));
                    std::vector<Id> mine;
                    write(first, first + static_cast<Offset>(size / sizeof(Quad)), reinterpret_cast<Quad*>(to), mine);
                    if (mine.empty()) return;
                    const std::lock_guard<std::mutex> lock(mutex);
                    by_first[first] = std::move(mine);
                  });
  std::vector<std::vector<Id>> parts;
  for (auto& [first, part] : by_first) parts.push_back(std::move(part));
  return some_cells(std::move(parts));
}

}  // namespace

template <class Space, class Index>
ReadCells<MemoryOf<Space>> write_cells(const Space&, const MeshPart<Index>& part, const IdInterval& own) {
  const Offset count = part.cells.extent(0);
  const OuterCells<Index> cells(part, own);
  const auto rows = allocate<Array<Quad, MemoryOf<Space>>>("GALE::part_cells", count);
  if constexpr (is_device<Space>) {
    return {write_rows_to_device(rows.data(), count,
                                 [&](Offset first, Offset last, Quad* to, std::vector<Id>& outer) {
                                   cells.write(first, last, to, outer);
                                 }),
            rows};
  } else {
    return {some_cells(of_parts("GALE::part_cells", count,
                                [&](Offset first, Offset last) {
                                  std::vector<Id> mine;
                                  cells.write(first, last, rows.data() + first, mine);
                                  return mine;
                                })),
            rows};
  }
}

template <class Index>
ReadCells<WorkerMemory> read_cells(const MeshPart<Index>& part, const IdInterval& own) {
  if constexpr (have_device) {
    try {
      if (!own.is_empty()) return write_cells(WorkerSpace(), part, own);
    } catch (const OutOfMemory&) {
      // The mesh may fit all the same, without rows beside its cells; else the host makes it.
    }
  }
  return {outer_cells(part, own), {}};
}

#define GALE_INSTANTIATE(Space)                                                                                    \
  template ReadCells<MemoryOf<Space>> write_cells(const Space&, const MeshPart<std::int32_t>&, const IdInterval&); \
  template ReadCells<MemoryOf<Space>> write_cells(const Space&, const MeshPart<std::int64_t>&, const IdInterval&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
template ReadCells<WorkerMemory> read_cells(const MeshPart<std::int32_t>&, const IdInterval&);
template ReadCells<WorkerMemory> read_cells(const MeshPart<std::int64_t>&, const IdInterval&);

}  // namespace gale::detail
