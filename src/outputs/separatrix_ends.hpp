#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/exchange/places.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/field.hpp>

namespace gale::outputs::detail {

/// A vertex in the order, and the field's value there.
struct Height {
  std::uint64_t key = 0;
  GlobalId vertex = 0;
  double value = 0;

  bool operator<(const Height& other) const { return key != other.key ? key < other.key : vertex < other.vertex; }
};

/// What separatrices say of a critical simplex at one of their ends.
struct End {
  GlobalId cell = -1;
  Height highest, lowest;
  std::int8_t on_surface = 0;
};

/// The height of a vertex, by its input id.
inline Height height_of(const VertexOrder& order, const io::PointArray& field, Id vertex) {
  return {order.keys()[order.mesh().vertices_of_input()[vertex]], order.mesh().vertex_id(vertex),
          value_at(field, vertex)};
}

/// What separatrices say of critical simplices.
inline std::vector<End> ends_of(const std::vector<CriticalSimplex>& simplices, const io::PointArray& field,
                                const VertexOrder& order) {
  const auto height = [&](Id vertex) { return height_of(order, field, vertex); };
  std::vector<End> ends(simplices.size());
  parallel_for("GALE::ends_of_separatrices", HostExecutionSpace(), simplices.size(), [&](Offset i) {
    const CriticalSimplex& simplex = simplices[i];
    ends[i] = {simplex.cell, height(simplex.highest()), height(simplex.lowest()), simplex.on_surface};
  });
  return ends;
}

/// The numbers among those of all ranks of some that come in groups, by the ends where they begin: those of each of
/// `ends` (places in `of`, none in two groups) follow one another.
class NumbersOfAll {
 public:
  /// Collective.
  NumbersOfAll(const Ranks& ranks, const std::vector<Id>& ends, const std::vector<End>& of) : count_(ends.size()) {
    if (ranks.size() == 1) return;
    using Ids = Array<GlobalId, HostMemory>;
    std::vector<std::size_t> first;  // of each group
    Ids cells, counts;
    gale::detail::together(ranks, [&] {
      for (std::size_t i = 0; i < ends.size(); ++i) {
        if (i == 0 || ends[i] != ends[i - 1]) first.push_back(i);
      }
      cells = allocate<Ids>("GALE::ends_of_paths", first.size());
      counts = allocate<Ids>("GALE::paths_of_ends", first.size());
      first.push_back(ends.size());
      for (std::size_t s = 0; s + 1 < first.size(); ++s) {
        cells(s) = of[ends[first[s]]].cell;
        counts(s) = static_cast<GlobalId>(first[s + 1] - first[s]);
      }
    });
    const auto [numbers, count] = gale::detail::sums_before(ranks, cells, counts);
    count_ = count;
    for (std::size_t s = 0; s + 1 < first.size(); ++s) {
      for (std::size_t i = first[s]; i < first[s + 1]; ++i) numbers_.push_back(numbers(s) + GlobalId(i - first[s]));
    }
  }

  GlobalId operator[](Offset i) const { return numbers_.empty() ? i : numbers_[i]; }
  GlobalId count() const { return count_; }

 private:
  GlobalId count_;
  std::vector<GlobalId> numbers_;  // where there are several ranks
};

}  // namespace gale::outputs::detail
