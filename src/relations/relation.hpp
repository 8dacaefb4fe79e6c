#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gale/base/kokkos.hpp>
#include <gale/export.hpp>
#include <gale/mesh/simplices.hpp>

namespace gale {

/// Which simplices touch which: `XY` gives for an X the Ys that touch it. Adjacent k-simplices share a (k-1)-simplex,
/// vertices an edge.
enum class Relation : std::uint8_t { EV, FV, FE, TV, TE, TF, VE, VF, VT, EF, ET, FT, VV, EE, FF, TT };

/// How many relations there are.
inline constexpr int relation_count = 16;

/// What computes the rows of a relation: a look-up in the tables of simplices, also made by the row kernels; the row
/// kernels alone; or the kernel of stars, which makes several relations at once.
enum class ComputedBy : std::uint8_t { look_up, row_kernel, star_kernel };

/// All that is particular about one relation. To add one, add a line to the table in `traits_of`, and a kernel.
struct RelationTraits {
  char name[3];                 ///< "VV"
  signed char row_dimension;    ///< dimension of the X, of which there is a row each
  signed char entry_dimension;  ///< dimension of the Y, which are the rows' entries
  ComputedBy computed_by;       ///< what computes its rows
  SimplexNeeds needs;           ///< tables of simplices that whoever computes a row reads; triangle_edge see `needs_of`
  short words_of_vertex;        ///< what its blocks take for each vertex of a regular mesh, in words of an Id
};

/// What is particular about a relation. On triangle meshes VF and FV are what VT and TV are elsewhere: see needs_of and
/// star_relations_of.
KOKKOS_FUNCTION constexpr RelationTraits traits_of(Relation relation) {
  using By = ComputedBy;
  constexpr auto vertices = Enumeration::cells, edges = Enumeration::edges, triangles = Enumeration::triangles;
  // A vertex of a regular mesh has 14 neighbours, 36 triangles and 24 tetrahedra. The needs: what is numbered, whether
  // edges are sorted by their higher vertex too, and whether the host needs the tetrahedra.
  constexpr RelationTraits table[relation_count] = {
      {"EV", 1, 0, By::look_up, {edges, false, false}, 21},
      {"FV", 2, 0, By::look_up, {triangles, false, false}, 48},
      {"FE", 2, 1, By::look_up, {triangles, false, false}, 48},
      {"TV", 3, 0, By::look_up, {vertices, false, true}, 30},
      {"TE", 3, 1, By::look_up, {edges, false, true}, 42},
      {"TF", 3, 2, By::look_up, {triangles, false, true}, 30},
      {"VE", 0, 1, By::row_kernel, {edges, true, false}, 16},
      {"VF", 0, 2, By::row_kernel, {triangles, true, false}, 38},
      {"VT", 0, 3, By::star_kernel, {vertices, false, false}, 26},
      {"EF", 1, 2, By::row_kernel, {triangles, true, false}, 44},
      {"ET", 1, 3, By::row_kernel, {edges, true, true}, 44},
      {"FT", 2, 3, By::row_kernel, {triangles, true, true}, 37},
      {"VV", 0, 0, By::star_kernel, {vertices, false, false}, 16},
      {"EE", 1, 1, By::row_kernel, {edges, true, false}, 190},
      {"FF", 2, 2, By::row_kernel, {triangles, true, false}, 160},
      {"TT", 3, 3, By::row_kernel, {edges, true, true}, 31},
  };
  return table[static_cast<int>(relation)];
}

/// Dimension of the simplices that a relation has a row each of.
KOKKOS_FUNCTION constexpr int row_dimension(Relation relation) { return traits_of(relation).row_dimension; }

/// Dimension of the simplices that a relation's rows consist of.
KOKKOS_FUNCTION constexpr int entry_dimension(Relation relation) { return traits_of(relation).entry_dimension; }

/// The name of a relation: "VV".
GALE_EXPORT std::string name_of(Relation relation);

/// The relation of a name; nothing for any other.
GALE_EXPORT std::optional<Relation> relation_named(const std::string& name);

/// A set of relations, a value. Beside them it may have `link_form`: VT in the form that readers of links want, for
/// each cell of a vertex the places of its other vertices in the vertex's VV row.
class RelationSet {
 public:
  /// No relations.
  constexpr RelationSet() = default;

  /// One relation.
  KOKKOS_FUNCTION constexpr RelationSet(Relation relation) : bits_(bit(static_cast<int>(relation))) {}

  /// Whether a relation is among them.
  KOKKOS_FUNCTION constexpr bool has(Relation relation) const { return (bits_ >> static_cast<int>(relation)) & 1; }

  /// Whether the links are among them.
  KOKKOS_FUNCTION constexpr bool has_links() const { return (bits_ >> relation_count) & 1; }

  /// Whether all of another set are among them.
  KOKKOS_FUNCTION constexpr bool contains(RelationSet other) const { return (bits_ & other.bits_) == other.bits_; }

  /// Whether there is no relation, and there are no links.
  KOKKOS_FUNCTION constexpr bool empty() const { return bits_ == 0; }

  /// How many blocks a segment has of it: one for each relation, and one for the links.
  KOKKOS_FUNCTION constexpr int count() const {
    int members = 0;
    for (std::uint32_t rest = bits_; rest != 0; rest &= rest - 1) ++members;
    return members;
  }

  /// Place of a member's block among these: in the order of `Relation`, the links last.
  KOKKOS_FUNCTION constexpr int index_of(Relation relation) const { return before(static_cast<int>(relation)); }

  /// Place of the links' block among these.
  KOKKOS_FUNCTION constexpr int index_of_links() const { return before(relation_count); }

  /// The links alone; `link_form` is their name.
  KOKKOS_FUNCTION static constexpr RelationSet links() { return RelationSet(bit(relation_count), 0); }

  /// What is in both sets.
  friend KOKKOS_FUNCTION constexpr RelationSet operator&(RelationSet a, RelationSet b) {
    return RelationSet(a.bits_ & b.bits_, 0);
  }

  /// What is in the first set and not in the second.
  friend KOKKOS_FUNCTION constexpr RelationSet operator-(RelationSet a, RelationSet b) {
    return RelationSet(a.bits_ & ~b.bits_, 0);
  }

  /// What is in either set.
  friend KOKKOS_FUNCTION constexpr RelationSet operator|(RelationSet a, RelationSet b) {
    return RelationSet(a.bits_ | b.bits_, 0);
  }

  /// Whether both sets have the same members.
  friend KOKKOS_FUNCTION constexpr bool operator==(RelationSet a, RelationSet b) { return a.bits_ == b.bits_; }

 private:
  KOKKOS_FUNCTION constexpr RelationSet(std::uint32_t bits, int) : bits_(bits) {}
  KOKKOS_FUNCTION static constexpr std::uint32_t bit(int place) { return std::uint32_t(1) << place; }
  KOKKOS_FUNCTION constexpr int before(int place) const { return RelationSet(bits_ & (bit(place) - 1), 0).count(); }

  std::uint32_t bits_ = 0;
};

/// A set of two relations.
KOKKOS_FUNCTION constexpr RelationSet operator|(Relation a, Relation b) { return RelationSet(a) | RelationSet(b); }

/// The links of vertices, as part of a set: `Relation::VV | link_form`.
inline constexpr RelationSet link_form = RelationSet::links();

/// The relations of a set, in the order of `Relation`; the links aren't among them.
GALE_EXPORT std::vector<Relation> members_of(RelationSet relations);

/// Dimension of the rows of one relation, or of the links.
inline int row_dimension(RelationSet one) { return one == link_form ? 0 : row_dimension(members_of(one).front()); }

/// The names of a set's members: "VT, VV, link".
GALE_EXPORT std::string name_of(RelationSet relations);

/// The relations to faces of a simplex, its parts of a lower dimension: rows of one length.
inline constexpr RelationSet face_relations =
    Relation::EV | Relation::FV | Relation::FE | Relation::TV | Relation::TE | Relation::TF;

/// The relations to the simplices of a higher dimension that have a simplex as a face.
inline constexpr RelationSet coboundary_relations =
    Relation::VE | Relation::VF | Relation::VT | Relation::EF | Relation::ET | Relation::FT;

/// The relations between simplices of one dimension.
inline constexpr RelationSet adjacency_relations = Relation::VV | Relation::EE | Relation::FF | Relation::TT;

/// The sixteen relations.
inline constexpr RelationSet all_relations = face_relations | coboundary_relations | adjacency_relations;

/// The relations of meshes of a dimension: sixteen among tetrahedra, nine among triangles.
KOKKOS_FUNCTION constexpr RelationSet relations_of_dimension(int dimension) {
  return dimension == 3 ? all_relations
                        : all_relations - (Relation::TV | Relation::TE | Relation::TF | Relation::VT | Relation::ET |
                                           Relation::FT | Relation::TT);
}

/// The relation from vertices to cells of a dimension: VT or VF.
KOKKOS_FUNCTION constexpr Relation vertex_cells(int dimension) { return dimension == 3 ? Relation::VT : Relation::VF; }

/// What one kernel can compute from the star of each of a segment's vertices, where cells have that dimension.
KOKKOS_FUNCTION constexpr RelationSet star_relations_of(int dimension) {
  return Relation::VV | vertex_cells(dimension) | link_form;
}

/// What it can among tetrahedra.
inline constexpr RelationSet star_relations = star_relations_of(3);

}  // namespace gale
