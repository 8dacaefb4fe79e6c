#pragma once

#include <type_traits>

#include <gale/mesh/simplices.hpp>
#include <gale/relations/relation.hpp>

namespace gale {

/// A row of a face relation: `size` ids, ascending.
template <int size>
struct FaceRow {
  Id ids[size];  ///< GALE's ids

  /// The i-th entry, counted from 0.
  KOKKOS_FUNCTION Id operator[](int i) const { return ids[i]; }

  /// The first entry.
  KOKKOS_FUNCTION const Id* begin() const { return ids; }

  /// One past the last entry.
  KOKKOS_FUNCTION const Id* end() const { return ids + size; }
};

/// Entries of each row of a face relation.
KOKKOS_FUNCTION constexpr int face_count(Relation relation) {
  return relation == Relation::EV                               ? 2
         : relation == Relation::FV || relation == Relation::FE ? 3
         : relation == Relation::TE                             ? 6
                                                                : 4;
}

/// The row of a simplex (GALE's id, which is assumed to be one) in one of the face relations EV, FV, FE, TV, TE and TF:
/// a look-up of a few steps, by host threads and in kernels. `simplices` has what `needs_of(relation)` says; TV and
/// those from T also the tetrahedra.
template <Relation relation, class Memory>
KOKKOS_INLINE_FUNCTION FaceRow<face_count(relation)> face_row(const Simplices<Memory>& simplices, Id simplex) {
  static_assert(face_relations.has(relation));
  const auto& s = simplices;
  if constexpr (relation == Relation::EV) {
    return {{s.edge_low(simplex), s.edge_high(simplex)}};
  } else if constexpr (relation == Relation::FV) {
    if (s.dimension == 2) {
      const Quad three = s.cell(simplex);
      return {{three.a, three.b, three.c}};
    }
    const Id edge = s.triangle_edge(simplex);
    return {{s.edge_low(edge), s.edge_high(edge), s.triangle_apex(simplex)}};
  } else if constexpr (relation == Relation::FE) {
    const Id edge = s.triangle_edge(simplex), apex = s.triangle_apex(simplex);
    return {{edge, s.edge_of(s.edge_low(edge), apex), s.edge_of(s.edge_high(edge), apex)}};
  } else {
    const auto [a, b, c, d] = s.cell(simplex);
    if constexpr (relation == Relation::TV) {
      return {{a, b, c, d}};
    } else if constexpr (relation == Relation::TE) {
      return {{s.edge_of(a, b), s.edge_of(a, c), s.edge_of(a, d), s.edge_of(b, c), s.edge_of(b, d), s.edge_of(c, d)}};
    } else {
      const Id ab = s.edge_of(a, b), ac = s.edge_of(a, c), bc = s.edge_of(b, c);
      return {{s.triangle_of(ab, c), s.triangle_of(ab, d), s.triangle_of(ac, d), s.triangle_of(bc, d)}};
    }
  }
}

namespace detail {

/// Returns use(constant) of a relation to faces, which is known to the compiler there.
template <class Use>
auto with_faces_of(Relation relation, const Use& use) {
  switch (relation) {
    case Relation::EV:
      return use(std::integral_constant<Relation, Relation::EV>());
    case Relation::FV:
      return use(std::integral_constant<Relation, Relation::FV>());
    case Relation::FE:
      return use(std::integral_constant<Relation, Relation::FE>());
    case Relation::TV:
      return use(std::integral_constant<Relation, Relation::TV>());
    case Relation::TE:
      return use(std::integral_constant<Relation, Relation::TE>());
    default:
      return use(std::integral_constant<Relation, Relation::TF>());
  }
}

}  // namespace detail

}  // namespace gale
