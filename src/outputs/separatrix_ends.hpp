#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/order/ordered_bits.hpp>
#include <gale/mesh/exchange/home_table.hpp>
#include <gale/mesh/exchange/places.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/field.hpp>

namespace gale::outputs::detail {

/// A vertex in the order of all ranks, and the field's value there.
struct Height {
  std::uint64_t order = 0;
  GlobalId vertex = -1;
  double value = 0;

  bool operator<(const Height& other) const {
    return order != other.order ? order < other.order : vertex < other.vertex;
  }
};

/// What separatrices say of a critical simplex at one of their ends.
struct End {
  GlobalId cell = -1;
  Height highest, lowest;
  std::int8_t on_surface = 0;
};

/// What separatrices say of this rank's critical simplices.
inline std::vector<End> ends_of(const std::vector<CriticalSimplex>& simplices, const io::Dataset& dataset,
                                const io::PointArray& field, const VertexOrder& order) {
  const Mesh& mesh = order.mesh();
  const io::PointArray& ordered_by = order_array(dataset, field);
  const auto height = [&](Id vertex) -> Height {
    // Keys say nothing to other ranks: where there are several, values do.
    const auto bits = [&](const auto& values) { return std::uint64_t(gale::detail::ordered_bits(values[vertex])); };
    return {mesh.is_part() ? std::visit(bits, ordered_by.values) : order.keys()[mesh.vertices_of_input()[vertex]],
            mesh.vertex_id(vertex), value_at(field, vertex)};
  };
  std::vector<End> ends;
  for (const CriticalSimplex& simplex : simplices)
    ends.push_back({simplex.cell, height(simplex.highest()), height(simplex.lowest()), simplex.on_surface});
  return ends;
}

/// The paths of one kind: what is known of their ends, and their numbers.
template <class Cell>
class PathEnds {
 public:
  PathEnds(const Separatrices<Cell>& paths, std::vector<End> sources, std::vector<End> destinations)
      : paths_(paths), sources_(std::move(sources)), destinations_(std::move(destinations)), count_(paths.count()) {}

  /// Asks other ranks for the ends of this rank's paths, and numbers the paths of all. last_of(i) is the CellId of the
  /// i-th path's last cell. Collective.
  template <class LastOf>
  void ask(const Ranks& ranks, const LastOf& last_of) {
    using Ids = Array<GlobalId, HostMemory>;
    Ids known, wanted, sources, counts;
    std::vector<Offset> first;  // path of each source that has one
    gale::detail::together(ranks, [&] {
      for (Offset i = 0; i < paths_.count(); ++i) {
        if (i == 0 || paths_.sources[i] != paths_.sources[i - 1]) first.push_back(i);
      }
      first.push_back(paths_.count());
      known = allocate<Ids>("GALE::known_ends", destinations_.size());
      wanted = allocate<Ids>("GALE::wanted_ends", paths_.count());
      sources = allocate<Ids>("GALE::path_sources", first.size() - 1);
      counts = allocate<Ids>("GALE::paths_of_sources", first.size() - 1);
      for (std::size_t i = 0; i < destinations_.size(); ++i) known(i) = destinations_[i].cell;
      for (Offset i = 0; i < paths_.count(); ++i) wanted(i) = last_of(i);
      for (std::size_t s = 0; s + 1 < first.size(); ++s) {
        sources(s) = sources_[paths_.sources[first[s]]].cell;
        counts(s) = first[s + 1] - first[s];
      }
    });
    const gale::detail::HomeTable<End> table(
        ranks, known, [&](Id i) { return destinations_[i]; }, [](int, const End& end) { return end; });
    last_ = table.find(ranks, wanted);
    const Ids numbers = gale::detail::sums_before(ranks, sources, counts);
    count_ = numbers(numbers.extent(0) - 1);
    for (std::size_t s = 0; s + 1 < first.size(); ++s) {
      for (Offset i = first[s]; i < first[s + 1]; ++i) numbers_.push_back(numbers(s) + i - first[s]);
    }
  }

  const End& source(Offset i) const { return sources_[paths_.sources[i]]; }
  const End& destination(Offset i) const {
    return last_.extent(0) == 0 ? destinations_[paths_.destinations[i]] : last_(i);
  }

  /// The number of the i-th path among those of all ranks, and how many these are.
  GlobalId number(Offset i) const { return numbers_.empty() ? i : numbers_[i]; }
  GlobalId count() const { return count_; }

 private:
  const Separatrices<Cell>& paths_;
  std::vector<End> sources_, destinations_;
  GlobalId count_;

  // Where there are several ranks, by path.
  Array<End, HostMemory> last_;
  std::vector<GlobalId> numbers_;
};

}  // namespace gale::outputs::detail
