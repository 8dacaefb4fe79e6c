#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/cells/cell_messages.hpp>
#include <gale/mesh/cells/split_cell.hpp>
#include <gale/mesh/cells/split_cells.hpp>

namespace gale {

namespace detail {

namespace {

/// Entries of a cell: places among them are Ids.
constexpr Offset most_entries = 0x7fffffff;

/// Splits a cell into simplices of so many corners, wherever it is.
template <int Corners, class Index, class Memory>
struct CellSplitter {
  Cells<Index, Memory> cells;
  Array<const GlobalId, Memory> ids;
  Offset points;
  CellRules rules;

  /// Whether the cell can't be split, or has what is not there.
  KOKKOS_FUNCTION bool is_bad(Offset cell) const {
    const Offset begin = cells.offsets(cell), end = cells.offsets(cell + 1);
    if (begin < 0 || end < begin || end > static_cast<Offset>(cells.connectivity.extent(0))) return true;
    const int type = cells.types(cell);
    const CellRule rule = rules.rule[type];
    if (rule == CellRule::skip) return false;
    if (rule == CellRule::unknown || rule == CellRule::refuse) return true;
    const Offset size = end - begin;
    if (rule == CellRule::polyhedron) {
      const Index* const entries = cells.connectivity.data() + begin;
      return size > most_entries || fault_of_polyhedron(entries, size, points) != FaceFault::none;
    }
    if (rules.points[type] != 0 ? size != rules.points[type] : size < 3 || size > most_entries) return true;
    bool is_outside = false;
    for (Offset k = begin; k < end; ++k) {
      const Offset point = cells.connectivity(k);
      is_outside |= point < 0 || point >= points;
    }
    return is_outside;
  }

  /// Emits the simplices of a cell that isn't bad.
  template <class Emit>
  KOKKOS_FORCEINLINE_FUNCTION void split(Offset cell, const Emit& emit) const {
    const int type = cells.types(cell);
    const Index* const corners = cells.connectivity.data() + cells.offsets(cell);
    const GlobalId* const given = ids.extent(0) == 0 ? nullptr : ids.data();  // data() of no ids may not be null
    const auto at = [corners](int k) { return static_cast<Id>(corners[k]); };
    const auto key = [given](Id vertex) { return given == nullptr ? GlobalId(vertex) : given[vertex]; };
    if constexpr (Corners == 4) {
      switch (rules.rule[type]) {
        case CellRule::simplex:
          return emit(at(0), at(1), at(2), at(3));
        case CellRule::cone:
          return split_cone(rules.shapes[rules.shape[type]], key, at, emit);
        case CellRule::quadratic_cone:
          return split_quadratic_tetrahedron(rules.shapes[rules.shape[type]], key, at, emit);
        case CellRule::polyhedron:
          return split_polyhedron(key, at, emit);
        default:
          return;
      }
    } else {
      const auto size = static_cast<int>(cells.offsets(cell + 1) - cells.offsets(cell));
      split_flat(rules.rule[type], size, key, at, emit);
    }
  }
};

/// Counts the simplices of each cell; -1 for a bad one.
template <class Splitter, class Counts>
struct CountSimplices {
  Splitter splitter;
  Counts counts;

  KOKKOS_FUNCTION void operator()(Offset cell) const {
    Offset count = 0;
    if (splitter.is_bad(cell)) {
      count = -1;
    } else {
      splitter.split(cell, [&](auto...) { ++count; });
    }
    counts(cell) = count;
  }
};

template <class Counts>
struct FirstBad {
  Counts counts;
  Offset none;
  KOKKOS_FUNCTION Offset operator()(Offset cell) const { return counts(cell) < 0 ? cell : none; }
};

template <class Splitter, class Counts, class Simplices, class Ids>
struct WriteSimplices {
  Splitter splitter;
  Counts begin;
  Simplices simplices;
  Ids cells;

  KOKKOS_FUNCTION void operator()(Offset cell) const {
    Offset place = begin(cell);
    splitter.split(cell, [&](auto... vertices) {
      const Id corners[] = {vertices...};
      for (int k = 0; k < static_cast<int>(sizeof...(vertices)); ++k) simplices(place, k) = corners[k];
      cells(place++) = static_cast<Id>(cell);
    });
  }
};

/// Whether a cell begins elsewhere than where simplices that follow each other do, or is another one.
template <class Index, class Memory>
struct FirstOther {
  Cells<Index, Memory> cells;
  int type, corners;
  Offset none;

  KOKKOS_FUNCTION Offset operator()(Offset cell) const {
    return cells.types(cell) == type && cells.offsets(cell) == corners * cell ? none : cell;
  }
};

template <class Index, class Memory>
bool are_simplices(const Cells<Index, Memory>& cells, int type, int corners) {
  const Offset count = cells.types.extent(0);
  if (corners * count != static_cast<Offset>(cells.connectivity.extent(0)) ||
      static_cast<Offset>(cells.offsets.extent(0)) != count + 1)
    return false;
  const Offset other = reduce_min("GALE::are_simplices", SpaceOf<Memory>(), count, count,
                                  FirstOther<Index, Memory>{cells, type, corners, count});
  if (other < count) return false;
  Offset end = 0;
  Kokkos::deep_copy(end, Kokkos::subview(cells.offsets, count));
  return end == corners * count;
}

/// Copies simplices that follow each other; returns the place of one that has a vertex that there is not.
template <int Corners, class Index, class Memory>
struct CopySimplices {
  Array<const Index, Memory> from;
  Kokkos::View<Id* [Corners], Kokkos::LayoutRight, Memory> to;
  Offset points, none;

  KOKKOS_FUNCTION Offset operator()(Offset simplex) const {
    bool is_outside = false;
    for (int k = 0; k < Corners; ++k) {
      const Offset point = from(Corners * simplex + k);
      is_outside |= point < 0 || point >= points;
      to(simplex, k) = static_cast<Id>(point);
    }
    return is_outside ? simplex : none;
  }
};

template <class Index, class Memory>
[[noreturn]] void refuse_cell(const Cells<Index, Memory>& cells, Offset cell, Offset points, const CellRules& rules) {
  const auto some = [](const auto& array, Offset begin, Offset end) {
    return Kokkos::create_mirror_view_and_copy(HostMemory(), Kokkos::subview(array, std::make_pair(begin, end)));
  };
  const auto ends = some(cells.offsets, cell, cell + 2);
  const Offset begin = ends(0), end = ends(1), size = cells.connectivity.extent(0);
  std::vector<std::int64_t> entries;
  if (begin >= 0 && begin < end && end <= size) {
    const auto found = some(cells.connectivity, begin, end);
    entries.assign(found.data(), found.data() + found.extent(0));
  }
  refuse_cell(cell, some(cells.types, cell, cell + 1)(0), begin, end, size, points, rules, entries);
}

template <class Index, class Memory>
void require_offsets(const Cells<Index, Memory>& cells) {
  const Offset count = cells.types.extent(0), offsets = cells.offsets.extent(0);
  require_ids("cells", count);
  if (offsets != count + 1)
    throw Error("there are " + std::to_string(offsets) + " offsets for " + std::to_string(count) +
                " cells: one more than cells is wanted, the first 0");
  Offset first = 0;
  Kokkos::deep_copy(first, Kokkos::subview(cells.offsets, 0));
  if (first != 0) throw Error("the first cell begins at " + std::to_string(first) + ", not at 0");
}

template <int Corners, class Index, class Memory>
SplitCells<Corners, Memory> split_into(const Cells<Index, Memory>& cells, Offset points,
                                       const Array<const GlobalId, Memory>& ids) {
  using Simplices = Kokkos::View<Id* [Corners], Kokkos::LayoutRight, Memory>;
  constexpr const char* name = Corners == 4 ? "tetrahedra" : "triangles";
  const SpaceOf<Memory> space;
  const CellRules& rules = cell_rules(Corners);
  const Offset count = cells.types.extent(0);
  SplitCells<Corners, Memory> result;
  require_ids("points", points);
  if (ids.extent(0) != 0 && static_cast<Offset>(ids.extent(0)) != points)
    throw Error("there are " + std::to_string(ids.extent(0)) + " ids for " + std::to_string(points) + " points");
  require_offsets(cells);
  if (are_simplices(cells, Corners == 4 ? cell_type::tetrahedron : cell_type::triangle, Corners)) {
    result.simplices = allocate<Simplices>("GALE::simplices", count);
    const Offset bad =
        reduce_min("GALE::copy_simplices", space, count, count,
                   CopySimplices<Corners, Index, Memory>{cells.connectivity, result.simplices, points, count});
    if (bad < count) refuse_cell(cells, bad, points, rules);
    return result;
  }
  using Splitter = CellSplitter<Corners, Index, Memory>;
  using Counts = Array<Offset, Memory>;
  const Splitter splitter{cells, ids, points, rules};
  const auto begin = allocate<Counts>("GALE::simplices_of_cells", count + 1);
  parallel_for("GALE::count_simplices", space, count, CountSimplices<Splitter, Counts>{splitter, begin});
  const Offset bad = reduce_min("GALE::bad_cells", space, count, count, FirstBad<Counts>{begin, count});
  if (bad < count) refuse_cell(cells, bad, points, rules);
  const Offset total = exclusive_scan("GALE::place_simplices", space, count, begin, begin);
  require_ids(name, total);
  result.simplices = allocate<Simplices>("GALE::simplices", total);
  result.cells = allocate<Array<Id, Memory>>("GALE::cells_of_simplices", total);
  parallel_for(
      "GALE::write_simplices", space, count,
      WriteSimplices<Splitter, Counts, Simplices, Array<Id, Memory>>{splitter, begin, result.simplices, result.cells});
  result.notices = notices_of_split(census_of(cells.types), total, Corners);
  wait_for(space, "GALE::split_cells");
  return result;
}

}  // namespace

}  // namespace detail

template <class Index, class Memory>
SplitCells<4, Memory> split_cells(const Cells<Index, Memory>& cells, Offset points,
                                  const Array<const GlobalId, Memory>& ids) {
  return detail::split_into<4>(cells, points, ids);
}

template <class Index, class Memory>
SplitCells<3, Memory> split_polygons(const Cells<Index, Memory>& cells, Offset points,
                                     const Array<const GlobalId, Memory>& ids) {
  return detail::split_into<3>(cells, points, ids);
}

template <class Index, class Memory>
bool are_tetrahedra(const Cells<Index, Memory>& cells) {
  return detail::are_simplices(cells, cell_type::tetrahedron, 4);
}

#define GALE_INSTANTIATE(Index, Memory)                                                            \
  template GALE_EXPORT SplitCells<4, Memory> split_cells(const Cells<Index, Memory>&, Offset,      \
                                                         const Array<const GlobalId, Memory>&);    \
  template GALE_EXPORT SplitCells<3, Memory> split_polygons(const Cells<Index, Memory>&, Offset,   \
                                                            const Array<const GlobalId, Memory>&); \
  template GALE_EXPORT bool are_tetrahedra(const Cells<Index, Memory>&)
GALE_INSTANTIATE(std::int32_t, HostMemory);
GALE_INSTANTIATE(std::int64_t, HostMemory);
#if defined(GALE_HAS_DEVICE)
GALE_INSTANTIATE(std::int32_t, WorkerMemory);
GALE_INSTANTIATE(std::int64_t, WorkerMemory);
#endif
#undef GALE_INSTANTIATE

}  // namespace gale
