#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/group_by.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Simplices of N vertices whose numbers are asked for. Each belongs to its first vertex, the one with the lowest input
/// id, and is found by that vertex's segment.
template <std::size_t N>
class NumberQueries {
 public:
  using Simplex = std::array<Id, N>;

  /// A simplex by its place in `simplices`, and its first vertex.
  struct Query {
    Id vertex, index;
    bool operator<(const Query& other) const { return vertex < other.vertex; }
  };

  /// `simplices` must outlive it. Throws gale::Error for a vertex that the mesh doesn't have.
  NumberQueries(const Mesh& mesh, const std::vector<Simplex>& simplices)
      : simplices_(simplices), input_(mesh.vertex_input().data()), numbers_(simplices.size()) {
    require_ids("simplices to number", simplices.size());
    const auto count = static_cast<Offset>(simplices.size());
    const Kokkos::DefaultHostExecutionSpace host;
    const auto by_segment = group_by_key<Id>("GALE::number_queries", host, count, mesh.segments(), [&](Id i) {
      require_vertices(mesh, simplices[i]);
      return mesh.segment_of(0, ascending(i)[0]);
    });
    queries_ = {by_segment.offsets, allocate<Array<Query, HostMemory>>("GALE::number_queries", count)};
    parallel_for("GALE::fill_number_queries", host, count, [&](Offset i) {
      const Id index = by_segment.entries(i);
      queries_.entries(i) = {ascending(index)[0], index};
    });
  }

  /// The queries of a segment, in no order.
  Span<Query> of(Id segment) const { return queries_.row(segment); }

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

  /// The place of a simplex, when it is set.
  GlobalId place(Offset index) const { return numbers_[index]; }

  /// When all places are set: the numbers, from those of the first simplex of each input vertex.
  std::vector<GlobalId> take_numbers(const Array<Id, HostMemory>& begin) {
    const auto& all = queries_.entries;
    parallel_for("GALE::add_numbers", Kokkos::DefaultHostExecutionSpace(), numbers_.size(),
                 [&](Offset i) { numbers_[all(i).index] += begin(input_[all(i).vertex]); });
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
  Csr<Query, HostMemory, Id> queries_;  ///< by segment
  std::vector<GlobalId> numbers_;
};

}  // namespace gale::detail
