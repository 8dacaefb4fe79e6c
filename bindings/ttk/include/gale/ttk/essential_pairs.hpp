#pragma once

#include <DiscreteMorseSandwich.h>

#include <array>
#include <set>
#include <utility>
#include <vector>

namespace gale::ttk {

/// Adds the pairs of saddles that live for ever, handles and cavities, to what
/// ttk::DiscreteMorseSandwich::computePersistencePairs gives with all three kinds of pairs computed and the boundary
/// not ignored: it adds them for ttk::ExplicitTriangulation alone. Those that are there already aren't added again, so
/// it may be called for any triangulation. The values, their time and the ranks are those that buildGradient() had; the
/// gradient is not computed again, as the triangulation keeps it.
template <class Scalar, class Triangulation>
void add_essential_pairs(std::vector<::ttk::DiscreteMorseSandwich::PersistencePair>& pairs, const Scalar* values,
                         std::size_t time, const ::ttk::SimplexId* order, const Triangulation& mesh) {
  ::ttk::dcg::DiscreteGradient gradient;
  gradient.setDebugLevel(0);
  gradient.preconditionTriangulation(const_cast<Triangulation*>(&mesh));
  gradient.setInputScalarField(values, time);
  gradient.setInputOffsets(order);
  gradient.buildGradient(mesh);
  std::array<std::vector<::ttk::SimplexId>, 4> critical;
  gradient.getCriticalPoints(critical, mesh);

  std::set<::ttk::SimplexId> paired[2];  // 1-saddles and 2-saddles
  for (const auto& pair : pairs) {
    if (pair.type == 0) paired[0].insert(pair.death);
    if (pair.type == 1) paired[0].insert(pair.birth);
    if (pair.type == 1) paired[1].insert(pair.death);
    if (pair.type == 2) paired[1].insert(pair.birth);
  }
  for (const int kind : {0, 1}) {
    for (const auto saddle : critical[kind + 1]) {
      if (paired[kind].count(saddle) == 0) pairs.emplace_back(saddle, -1, kind + 1);
    }
  }
}

}  // namespace gale::ttk
