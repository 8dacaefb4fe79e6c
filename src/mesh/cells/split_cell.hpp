#pragma once

#include <type_traits>

#include <gale/base/kokkos.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/cells/cell_shapes.hpp>

// How one cell is split, for hosts and devices. `key(id)` orders vertices on all ranks alike, `at(k)` is the k-th
// vertex of a cell or a face, `emit` takes the vertices of what is found. Nothing is emitted that has a vertex twice.

namespace gale::detail {

/// Emits the triangles of a polygon: the fan from its lowest vertex.
template <class Key, class At, class Emit>
KOKKOS_FORCEINLINE_FUNCTION void split_polygon(int corners, const Key& key, const At& at, const Emit& emit) {
  int lowest = 0;
  for (int k = 1; k < corners; ++k) {
    if (key(at(k)) < key(at(lowest))) lowest = k;
  }
  const auto behind = [corners](int k) { return k + 1 == corners ? 0 : k + 1; };
  const Id a = at(lowest);
  int place = behind(lowest);
  Id b = at(place);
  for (int k = 2; k < corners; ++k) {
    place = behind(place);
    const Id c = at(place);
    if (a != b && b != c && a != c) emit(a, b, c);
    b = c;
  }
}

/// Triangles of a cell's faces.
struct FaceTriangles {
  Id vertices[CellShape::most_triangles][3];
  int count = 0;

  KOKKOS_FORCEINLINE_FUNCTION void add(Id a, Id b, Id c) {
    vertices[count][0] = a;
    vertices[count][1] = b;
    vertices[count++][2] = c;
  }

  /// Has none of those that two faces share: there a cell that names vertices twice is folded together.
  KOKKOS_INLINE_FUNCTION void drop_pairs() {
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        if (!are_one(i, j)) continue;
        move(--count, j);
        move(--count, i);
        j = i;
      }
    }
  }

 private:
  KOKKOS_INLINE_FUNCTION bool has(int i, Id v) const {
    return vertices[i][0] == v || vertices[i][1] == v || vertices[i][2] == v;
  }
  KOKKOS_INLINE_FUNCTION bool are_one(int i, int j) const {
    return has(i, vertices[j][0]) && has(i, vertices[j][1]) && has(i, vertices[j][2]);
  }
  KOKKOS_INLINE_FUNCTION void move(int from, int to) {
    for (int k = 0; k < 3; ++k) vertices[to][k] = vertices[from][k];
  }
};

/// Whether a cell of that shape names a vertex twice.
template <class At>
KOKKOS_FORCEINLINE_FUNCTION bool names_twice(const CellShape& shape, const At& at) {
  bool found = false;
  for (int k = shape.first + 1; k < shape.end; ++k) {
    for (int j = shape.first; j < k; ++j) found |= at(j) == at(k);
  }
  return found;
}

/// Emits the tetrahedra of a cell of that shape: the cone from its lowest vertex over the triangles of those faces that
/// don't touch it.
template <class Key, class At, class Emit>
KOKKOS_FORCEINLINE_FUNCTION void split_cone(const CellShape& shape, const Key& key, const At& at, const Emit& emit) {
  Id apex = at(shape.first);
  for (int k = shape.first + 1; k < shape.end; ++k) {
    if (key(at(k)) < key(apex)) apex = at(k);
  }
  FaceTriangles all;
  for (int face = 0; face < shape.faces; ++face) {
    const int begin = shape.face_begin[face], end = shape.face_begin[face + 1];
    bool touches = false;
    for (int k = begin; k < end; ++k) touches |= at(shape.corners[k]) == apex;
    if (touches) continue;
    split_polygon(
        end - begin, key, [&](int k) { return at(shape.corners[begin + k]); },
        [&](Id a, Id b, Id c) { all.add(a, b, c); });
  }
  if (names_twice(shape, at)) all.drop_pairs();
  for (int i = 0; i < all.count; ++i) emit(apex, all.vertices[i][0], all.vertices[i][1], all.vertices[i][2]);
}

/// Emits the tetrahedra of a quadratic one, whose middle points come after its corners: on the edges 01, 12, 02, 03,
/// 13, 23.
template <class Key, class At, class Emit>
KOKKOS_FORCEINLINE_FUNCTION void split_quadratic_tetrahedron(const CellShape& shape, const Key& key, const At& at,
                                                             const Emit& emit) {
  const auto corner = [&](int a, int b, int c, int d) {
    const Id v[4] = {at(a), at(b), at(c), at(d)};
    const bool differ = v[0] != v[1] && v[0] != v[2] && v[0] != v[3] && v[1] != v[2] && v[1] != v[3] && v[2] != v[3];
    if (differ) emit(v[0], v[1], v[2], v[3]);
  };
  corner(0, 4, 6, 7);
  corner(4, 1, 5, 8);
  corner(6, 5, 2, 9);
  corner(7, 8, 9, 3);
  split_cone(shape, key, at, emit);
}

/// Emits the tetrahedra of a polyhedron: `at(0)` is how many faces it has, each how many corners, and these.
template <class Key, class At, class Emit>
KOKKOS_INLINE_FUNCTION void split_polyhedron(const Key& key, const At& at, const Emit& emit) {
  const int faces = at(0);
  Id apex = at(2);
  for (int face = 0, begin = 1; face < faces; ++face) {
    const int end = begin + 1 + at(begin);
    for (int k = begin + 1; k < end; ++k) {
      if (key(at(k)) < key(apex)) apex = at(k);
    }
    begin = end;
  }
  for (int face = 0, begin = 1; face < faces; ++face) {
    const int end = begin + 1 + at(begin);
    bool touches = false;
    for (int k = begin + 1; k < end; ++k) touches |= at(k) == apex;
    if (!touches) {
      split_polygon(
          end - begin - 1, key, [&](int k) { return at(begin + 1 + k); },
          [&](Id a, Id b, Id c) { emit(apex, a, b, c); });
    }
    begin = end;
  }
}

/// Emits the triangles of a flat cell of `size` points.
template <class Key, class At, class Emit>
KOKKOS_FORCEINLINE_FUNCTION void split_flat(CellRule rule, int size, const Key& key, const At& at, const Emit& emit) {
  const auto triangle = [&](int a, int b, int c) {
    const Id v[3] = {at(a), at(b), at(c)};
    if (v[0] != v[1] && v[1] != v[2] && v[0] != v[2]) emit(v[0], v[1], v[2]);
  };
  switch (rule) {
    case CellRule::simplex:
      return emit(at(0), at(1), at(2));
    case CellRule::fan:
      return split_polygon(size, key, at, emit);
    case CellRule::pixel:
      return split_polygon(
          size, key, [&](int k) { return at(k < 2 ? k : 5 - k); }, emit);
    case CellRule::strip:
      for (int k = 0; k + 2 < size; ++k) triangle(k, k + 1 + k % 2, k + 2 - k % 2);
      return;
    case CellRule::quadratic_triangle:
      triangle(0, 3, 5);
      triangle(3, 1, 4);
      triangle(5, 4, 2);
      triangle(3, 4, 5);
      return;
    default:
      return;
  }
}

/// What is wrong with the faces of a polyhedron.
enum class FaceFault { none, counts, point, open };

/// Looks for it in `size` entries of any values, as Cells have them. A polyhedron is closed where each of its edges is
/// in an even number of faces: then their hashes cancel out. Time O(size).
template <class Index>
KOKKOS_INLINE_FUNCTION FaceFault fault_of_polyhedron(const Index* entries, Offset size, Offset points) {
  if (size < 1 || entries[0] < 1) return FaceFault::counts;
  const Offset faces = entries[0];
  std::uint64_t edges = 0;
  Offset begin = 1;
  for (Offset face = 0; face < faces; ++face) {
    if (begin >= size || entries[begin] < 3 || entries[begin] > size - begin - 1) return FaceFault::counts;
    const Offset corners = entries[begin++];
    for (Offset k = 0; k < corners; ++k) {
      const Offset v = entries[begin + k], w = entries[begin + (k + 1 == corners ? 0 : k + 1)];
      if (v < 0 || v >= points) return FaceFault::point;
      if (v == w) continue;
      auto hash = static_cast<std::uint64_t>(v < w ? v : w) << 32 ^ static_cast<std::uint64_t>(v < w ? w : v);
      hash = (hash ^ hash >> 31) * 0x9e3779b97f4a7c15u;
      hash = (hash ^ hash >> 29) * 0xbf58476d1ce4e5b9u;
      edges ^= hash ^ hash >> 32;
    }
    begin += corners;
  }
  if (begin != size) return FaceFault::counts;
  return edges == 0 ? FaceFault::none : FaceFault::open;
}

}  // namespace gale::detail
