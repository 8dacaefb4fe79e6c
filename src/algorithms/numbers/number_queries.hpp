#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/require_ids.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Simplices of N vertices whose numbers are asked for, by the segment of the vertex that has the lowest input id in
/// each.
template <std::size_t N>
class NumberQueries {
 public:
  using Simplex = std::array<Id, N>;

  /// The `index`-th of the simplices, and its vertex with the lowest input id.
  struct Query {
    Id vertex, index;
    bool operator<(const Query& other) const { return vertex < other.vertex; }
  };

  /// `simplices` must outlive it. Throws gale::Error for a vertex that the mesh doesn't have.
  NumberQueries(const Mesh& mesh, const std::vector<Simplex>& simplices)
      : simplices_(simplices),
        input_(mesh.vertex_input().data()),
        end_("GALE::number_queries_end", mesh.segments() + 1) {
    require_ids("simplices to number", simplices.size());
    const auto count = static_cast<Offset>(simplices.size());
    queries_ = allocate<Array<Query, HostMemory>>("GALE::number_queries", count);
    numbers_.resize(simplices.size());
    const Kokkos::DefaultHostExecutionSpace host;
    parallel_for("GALE::count_number_queries", host, count, [&](Offset i) {
      require_vertices(mesh, simplices[i]);
      atomic_add(&end_(mesh.segment_of(0, ascending(i)[0])), Id(1));
    });
    exclusive_scan("GALE::place_number_queries", host, mesh.segments(), end_, [&](Offset s) { return end_(s); });
    parallel_for("GALE::fill_number_queries", host, count, [&](Offset i) {
      const Id vertex = ascending(i)[0];
      queries_(atomic_add(&end_(mesh.segment_of(0, vertex)), Id(1))) = {vertex, static_cast<Id>(i)};
    });
  }

  /// Those of a segment, not sorted until someone does it.
  Query* begin(Id segment) const { return queries_.data() + (segment == 0 ? 0 : end_(segment - 1)); }
  Query* end(Id segment) const { return queries_.data() + end_(segment); }

  /// The vertices of a simplex (GALE's), by ascending input id.
  Simplex ascending(Offset index) const {
    Simplex simplex = simplices_[index];
    std::sort(simplex.begin(), simplex.end(), [this](Id a, Id b) { return input_[a] < input_[b]; });
    return simplex;
  }

  /// Sets the place of a simplex among those with the same first vertex. Throws gale::Error if it is no_id.
  void set_place(Id index, Id place) {
    if (place == no_id) refuse(ascending(index));
    numbers_[index] = place;
  }

  /// When all places are set: the numbers, from those of the first simplex of each input vertex.
  std::vector<Id> take_numbers(const Array<Id, HostMemory>& begin) {
    parallel_for("GALE::add_numbers", Kokkos::DefaultHostExecutionSpace(), numbers_.size(),
                 [&](Offset i) { numbers_[queries_(i).index] += begin(input_[queries_(i).vertex]); });
    return std::move(numbers_);
  }

 private:
  static void require_vertices(const Mesh& mesh, const Simplex& simplex) {
    for (const Id vertex : simplex) {
      if (vertex >= 0 && vertex < mesh.vertices()) continue;
      throw Error("no vertex " + std::to_string(vertex) + " to number a simplex of: there are " +
                  std::to_string(mesh.vertices()));
    }
  }

  [[noreturn]] void refuse(const Simplex& simplex) const {
    std::string vertices;
    for (const Id vertex : simplex) vertices += ' ' + std::to_string(input_[vertex]);
    throw Error("no simplex of the mesh has just the input vertices" + vertices);
  }

  const std::vector<Simplex>& simplices_;
  const Id* input_;
  Array<Id, HostMemory> end_;  ///< one past the last query of each segment
  Array<Query, HostMemory> queries_;
  std::vector<Id> numbers_;
};

}  // namespace gale::detail
