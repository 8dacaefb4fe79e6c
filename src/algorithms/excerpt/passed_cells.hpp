#pragma once

#include <cstddef>
#include <vector>

#include <gale/algorithms/critical_simplices.hpp>
#include <gale/algorithms/excerpt/numbered_set.hpp>
#include <gale/algorithms/excerpt/wider_simplices.hpp>
#include <gale/algorithms/separatrices.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Marks what is on paths, before anything else is: where one comes to what is marked, its rest is being marked by
/// whoever has marked that. mark(simplex) says whether it wasn't; bring_near(simplex) is told what comes soon.
template <class Mark, class BringNear>
void mark_paths(const Separatrices<Id>& paths, const Mark& mark, const BringNear& bring_near) {
  constexpr std::ptrdiff_t ahead = 8;
  parallel_for("GALE::mark_paths", HostExecutionSpace(), paths.count(), [&](Offset i) {
    const Id* const last = paths.last(static_cast<Id>(i));
    for (const Id* at = paths.first(static_cast<Id>(i)); at != last && mark(*at); ++at) {
      if (last - at > ahead) bring_near(at[ahead]);
    }
  });
}

/// The cells of a wider gradient that are passed, and their numbers in the excerpt, by global id. Refers to the
/// simplices.
class PassedCells {
 public:
  /// Has those on paths upwards, and critical ones.
  PassedCells(const WiderSimplices& wider, const CriticalSimplices& critical, const Separatrices<Id>& ascending);

  /// How many these are.
  Offset count() const { return static_cast<Offset>(cell_of_.size()); }

  /// The cell with a number, of those given at first, and the number of a cell.
  Id operator[](Offset number) const { return cell_of_[number]; }
  Id number(Id cell) const { return number_of_[passed_[wider_.cell_name(cell)]]; }

  /// Has numbers be GALE's ids in the mesh that was made of the cells in their order.
  void renumber(const Mesh& mesh);

 private:
  void mark(const CriticalSimplices& critical, const Separatrices<Id>& ascending);
  std::vector<Id> by_name() const;
  void give_numbers();

  const WiderSimplices& wider_;
  NumberedSet passed_;         ///< by name
  std::vector<Id> cell_of_;    ///< by number
  std::vector<Id> number_of_;  ///< by name
};

}  // namespace gale::detail
