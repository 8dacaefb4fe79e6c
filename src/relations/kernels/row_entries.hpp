#pragma once

#include <gale/relations/faces.hpp>
#include <gale/relations/kernels/cofaces.hpp>
#include <gale/relations/kernels/cofaces_by_bisection.hpp>
#include <gale/relations/kernels/ranking.hpp>

namespace gale::detail {

/// Does `for_each_entry` visit the entries in ascending order?
KOKKOS_FUNCTION constexpr bool visits_in_order(Relation relation) {
  return relation != Relation::FF && relation != Relation::TT;
}

/// Lists of more entries are not looked through.
inline constexpr Id longest_looked_through = 128;

/// Are there two ways?
KOKKOS_FUNCTION constexpr bool can_bisect(Relation relation) {
  return relation == Relation::VF || relation == Relation::EF || relation == Relation::ET || relation == Relation::FT ||
         relation == Relation::FF || relation == Relation::TT;
}

/// Calls visit(id) for each entry of the row of a simplex in a relation other than VV, VT and link.
template <Relation relation, class Search, class Memory, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_entry(const Simplices<Memory>& s, Id simplex, const Visit& visit) {
  if constexpr (face_relations.has(relation)) {
    for (const Id entry : face_row<relation>(s, simplex)) visit(entry);
  } else if constexpr (relation == Relation::VE) {
    for_each_edge_at(s, simplex, visit);
  } else if constexpr (relation == Relation::VF) {
    for_each_triangle_of_vertex<Search>(s, simplex, visit);
  } else if constexpr (relation == Relation::EF) {
    Search::for_each_triangle_of_edge(s, simplex, visit);
  } else if constexpr (relation == Relation::ET) {
    Search::for_each_tetrahedron_of(s, s.edge_low(simplex), s.edge_high(simplex), visit);
  } else if constexpr (relation == Relation::FT) {
    const Id edge = s.triangle_edge(simplex);
    Search::for_each_tetrahedron_of(s, s.edge_low(edge), s.edge_high(edge), s.triangle_apex(simplex), visit);
  } else if constexpr (relation == Relation::EE) {
    for_each_adjacent_edge(s, simplex, visit);
  } else if constexpr (relation == Relation::FF) {
    for_each_adjacent_triangle<Search>(s, simplex, visit);
  } else {
    static_assert(relation == Relation::TT);
    Search::for_each_adjacent_tetrahedron(s, simplex, visit);
  }
}

/// How many entries that row has.
template <Relation relation, class Search, class Memory>
KOKKOS_INLINE_FUNCTION Id count_entries(const Simplices<Memory>& s, Id simplex) {
  const auto edges_at = [&s](Id v) {
    return s.lower_begin(v + 1) - s.lower_begin(v) + s.edge_begin(v + 1) - s.edge_begin(v);
  };
  if constexpr (face_relations.has(relation)) {
    return face_count(relation);
  } else if constexpr (relation == Relation::VE) {
    return edges_at(simplex);
  } else if constexpr (relation == Relation::EE) {
    return edges_at(s.edge_low(simplex)) + edges_at(s.edge_high(simplex)) - 2;
  } else {
    Id count = 0;
    for_each_entry<relation, Search>(s, simplex, [&](Id) { ++count; });
    return count;
  }
}

/// Writes them to `row`, ascending.
template <Relation relation, class Search, class Memory>
KOKKOS_INLINE_FUNCTION void write_entries(const Simplices<Memory>& s, Id simplex, Id* row, Id count) {
  constexpr Id few = 32;  // are put in order in a lane's own memory
  if constexpr (visits_in_order(relation)) {
    for_each_entry<relation, Search>(s, simplex, [&](Id id) { *row++ = id; });
  } else if (count <= few) {
    Id ids[few];
    Id placed = 0;
    for_each_entry<relation, Search>(s, simplex, [&](Id id) {
      Id at = placed++;
      for (; at > 0 && ids[at - 1] > id; --at) ids[at] = ids[at - 1];
      ids[at] = id;
    });
    for (Id i = 0; i < count; ++i) row[i] = ids[i];
  } else {
    Id placed = 0;
    for_each_entry<relation, Search>(s, simplex, [&](Id id) { row[placed++] = id; });
    heap_sort(row, count);
  }
}

}  // namespace gale::detail
