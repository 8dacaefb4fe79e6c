#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gale/base/kokkos.hpp>

namespace gale {

/// Which simplices touch which: `XY` gives for an X the Ys that touch it. Adjacent k-simplices share a (k-1)-simplex,
/// vertices an edge.
///
/// `link` is a form of the star of a vertex for its readers: per tetrahedron of its `VT` row, in that order, the places
/// of the other three vertices in its `VV` row.
enum class Relation : std::uint8_t { EV, FV, FE, TV, TE, TF, VE, VF, VT, EF, ET, FT, VV, EE, FF, TT, link };

inline constexpr int relation_count = 17;

/// Dimension of the X of a relation XY, of which it has a row each.
KOKKOS_FUNCTION constexpr int row_dimension(Relation relation) {
  constexpr signed char dimensions[relation_count] = {1, 2, 2, 3, 3, 3, 0, 0, 0, 1, 1, 2, 0, 1, 2, 3, 0};
  return dimensions[static_cast<int>(relation)];
}

/// Dimension of its Y, which are the rows' entries.
KOKKOS_FUNCTION constexpr int entry_dimension(Relation relation) {
  constexpr signed char dimensions[relation_count] = {0, 0, 1, 0, 1, 2, 1, 2, 3, 2, 3, 3, 0, 1, 2, 3, 3};
  return dimensions[static_cast<int>(relation)];
}

/// "VV"
std::string name_of(Relation relation);

/// The relation of a name; nothing for any other.
std::optional<Relation> relation_named(const std::string& name);

/// A set of relations, a value.
class RelationSet {
 public:
  constexpr RelationSet() = default;
  KOKKOS_FUNCTION constexpr RelationSet(Relation relation) : bits_(std::uint32_t(1) << static_cast<int>(relation)) {}

  KOKKOS_FUNCTION constexpr bool has(Relation relation) const { return (bits_ >> static_cast<int>(relation)) & 1; }
  KOKKOS_FUNCTION constexpr bool contains(RelationSet other) const { return (bits_ & other.bits_) == other.bits_; }
  KOKKOS_FUNCTION constexpr bool empty() const { return bits_ == 0; }

  /// How many relations it has.
  KOKKOS_FUNCTION constexpr int count() const {
    int members = 0;
    for (std::uint32_t rest = bits_; rest != 0; rest &= rest - 1) ++members;
    return members;
  }

  /// Place of a member among the members.
  KOKKOS_FUNCTION constexpr int index_of(Relation relation) const {
    return RelationSet(bits_ & ((std::uint32_t(1) << static_cast<int>(relation)) - 1), 0).count();
  }

  friend KOKKOS_FUNCTION constexpr RelationSet operator&(RelationSet a, RelationSet b) {
    return RelationSet(a.bits_ & b.bits_, 0);
  }
  friend KOKKOS_FUNCTION constexpr RelationSet operator-(RelationSet a, RelationSet b) {
    return RelationSet(a.bits_ & ~b.bits_, 0);
  }
  friend KOKKOS_FUNCTION constexpr RelationSet operator|(RelationSet a, RelationSet b) {
    return RelationSet(a.bits_ | b.bits_, 0);
  }
  friend KOKKOS_FUNCTION constexpr bool operator==(RelationSet a, RelationSet b) { return a.bits_ == b.bits_; }

 private:
  KOKKOS_FUNCTION constexpr RelationSet(std::uint32_t bits, int) : bits_(bits) {}

  std::uint32_t bits_ = 0;
};

KOKKOS_FUNCTION constexpr RelationSet operator|(Relation a, Relation b) { return RelationSet(a) | RelationSet(b); }

/// Its members, in the order of `Relation`.
std::vector<Relation> members_of(RelationSet relations);

/// "VV, VT"
std::string name_of(RelationSet relations);

inline constexpr RelationSet face_relations =
    Relation::EV | Relation::FV | Relation::FE | Relation::TV | Relation::TE | Relation::TF;
inline constexpr RelationSet coboundary_relations =
    Relation::VE | Relation::VF | Relation::VT | Relation::EF | Relation::ET | Relation::FT;
inline constexpr RelationSet adjacency_relations = Relation::VV | Relation::EE | Relation::FF | Relation::TT;
inline constexpr RelationSet all_relations =
    face_relations | coboundary_relations | adjacency_relations | Relation::link;

/// What one kernel can compute from the star of each of a segment's vertices.
inline constexpr RelationSet star_relations = Relation::VV | Relation::VT | Relation::link;

}  // namespace gale
