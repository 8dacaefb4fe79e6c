#include <algorithm>

#include <gale/algorithms/excerpt/passed_cells.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

PassedCells::PassedCells(const WiderSimplices& wider, const CriticalSimplices& critical,
                         const Separatrices<Id>& ascending)
    : wider_(wider), passed_(wider.cells()) {
  mark(critical, ascending);
  give_numbers();
}

void PassedCells::renumber(const Mesh& mesh) {
  std::vector<Id> internal(mesh.cells());
  const OtherIds input = mesh.cells_in_input();
  parallel_for("GALE::cells_of_excerpt", HostExecutionSpace(), mesh.cells(),
               [&](Offset t) { internal[input[static_cast<Id>(t)]] = static_cast<Id>(t); });
  parallel_for("GALE::cells_of_excerpt", HostExecutionSpace(), number_of_.size(),
               [&](Offset i) { number_of_[i] = internal[number_of_[i]]; });
}

void PassedCells::mark(const CriticalSimplices& critical, const Separatrices<Id>& ascending) {
  const auto add = [&](Id cell) { return passed_.insert(wider_.cell_name(cell)); };
  mark_paths(ascending, add, [&](Id cell) { passed_.prefetch(wider_.cell_name(cell)); });
  for (const Id cell : critical.cells) add(cell);
  for (const Id cell : critical.star) add(cell);
}

/// The cells by their numbers among those passed.
std::vector<Id> PassedCells::by_name() const {
  auto cells = zeros<Id>(passed_.count());
  if (wider_.mesh().cells_in_input().table == nullptr) {  // names are the cells themselves
    passed_.for_each("GALE::cells_by_name", [&](Id cell, Id number) { cells[number] = cell; });
  } else {
    parallel_for("GALE::cells_by_name", HostExecutionSpace(), wider_.cells(), [&](Offset t) {
      const Id cell = static_cast<Id>(t), name = wider_.cell_name(cell);
      if (passed_.has(name)) cells[passed_[name]] = cell;
    });
  }
  return cells;
}

/// Names of the rank's own cells ascend with global ids; others' come after all of these, and have to be put between
/// them.
void PassedCells::give_numbers() {
  struct Other {
    GlobalId id;
    Id place, own_before;  ///< by name; how many own cells have a lower id
  };
  passed_.number();
  const std::vector<Id> cells = by_name();
  const auto is_own = [&](Id cell) { return wider_.is_own_cell(cell); };
  const Id own = static_cast<Id>(std::partition_point(cells.begin(), cells.end(), is_own) - cells.begin());
  std::vector<Other> others(cells.size() - own);
  parallel_for("GALE::other_cells", HostExecutionSpace(), others.size(), [&](Offset i) {
    const Id place = own + static_cast<Id>(i);
    const GlobalId id = wider_.cell_id(cells[place]);
    others[i] = {id, place, bisect(Id(0), own, [&](Id at) { return wider_.cell_id(cells[at]) < id; })};
  });
  parallel_sort("GALE::sort_other_cells", others.begin(), others.end(),
                [](const Other& a, const Other& b) { return a.id < b.id; });
  cell_of_ = zeros<Id>(cells.size());
  number_of_ = zeros<Id>(cells.size());
  const auto set_number = [&](Offset place, Offset number) {
    cell_of_[number] = cells[place];
    number_of_[place] = static_cast<Id>(number);
  };
  for_parts("GALE::number_cells", own, threads_for(own), [&](int, Offset begin, Offset end) {
    auto next = std::partition_point(others.begin(), others.end(),
                                     [&](const Other& other) { return other.own_before <= begin; });
    for (Offset i = begin; i < end; ++i) {
      while (next != others.end() && next->own_before <= i) ++next;
      set_number(i, i + (next - others.begin()));
    }
  });
  parallel_for("GALE::number_cells", HostExecutionSpace(), others.size(),
               [&](Offset i) { set_number(others[i].place, others[i].own_before + i); });
}

}  // namespace gale::detail
