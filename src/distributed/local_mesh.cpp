#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gale/distributed/deal.hpp>
#include <gale/distributed/local_mesh.hpp>

namespace gale::detail {

namespace {

/// Throws if two tetrahedra have the same vertices, by their global ids.
void refuse_twins(const Tetrahedra<Id, HostMemory>& tetrahedra, const Array<const GlobalId, HostMemory>& ids) {
  std::vector<std::pair<std::array<Id, 4>, GlobalId>> all(ids.extent(0));
  for (std::size_t t = 0; t < all.size(); ++t) {
    auto& [quad, id] = all[t];
    for (int corner = 0; corner < 4; ++corner) quad[corner] = tetrahedra(t, corner);
    std::sort(quad.begin(), quad.end());
    id = ids(t);
  }
  std::sort(all.begin(), all.end());
  for (std::size_t t = 1; t < all.size(); ++t) {
    if (all[t].first != all[t - 1].first) continue;
    throw Error("tetrahedra " + std::to_string(all[t - 1].second) + " and " + std::to_string(all[t].second) +
                " have the same four vertices");
  }
}

/// The vertices that a rank owns, or those that it doesn't.
Array<Id, HostMemory> members_of(const Array<std::uint8_t, HostMemory>& is_owned, std::uint8_t owned) {
  return by_rank(1, is_owned.extent(0),
                 [&](Id i, const auto& visit) {
                   if (is_owned(i) == owned) visit(0);
                 })
      .members;
}

/// The octree of some of the points: their places among all, segment after segment, and where segments begin.
struct SomeSegments {
  Array<Id, HostMemory> members;
  Array<const Id, HostMemory> order, begin;

  SomeSegments(const Points<double, HostMemory>& points, const Array<std::uint8_t, HostMemory>& is_owned,
               std::uint8_t owned, int capacity) {
    members = members_of(is_owned, owned);
    const auto some =
        allocate<Kokkos::View<double* [3], Kokkos::LayoutRight, HostMemory>>("GALE::some_points", members.extent(0));
    parallel_for("GALE::some_points", HostSpace(), members.extent(0), [&](Offset i) {
      for (int axis = 0; axis < 3; ++axis) some(i, axis) = points(members(i), axis);
    });
    const Segmentation segmentation = octree_segmentation(Points<double, HostMemory>(some), capacity);
    order = segmentation.vertex_input.in<HostMemory>();
    begin = segmentation.vertex_begin.in<HostMemory>();
  }

  Id segments() const { return static_cast<Id>(begin.extent(0)) - 1; }
  Id vertices() const { return static_cast<Id>(members.extent(0)); }
};

}  // namespace

LocalVertices local_vertices(const GlobalIds& owned, const GlobalIds& ghosts) {
  const Offset count = owned.extent(0) + ghosts.extent(0);
  const LocalVertices all{allocate<GlobalIds>("GALE::local_vertices", count),
                          allocate<Array<std::uint8_t, HostMemory>>("GALE::is_owned", count)};
  // Each goes behind those of its own kind, and behind those of the other kind that are less.
  const auto place = [&](const GlobalIds& kind, const GlobalIds& other, std::uint8_t is_owned) {
    const Offset kinds = kind.extent(0), others = other.extent(0);
    for_parts("GALE::merge_vertices", kinds, threads_for(kinds), [&](int, Offset first, Offset last) {
      if (first == last) return;
      Offset less = std::lower_bound(other.data(), other.data() + others, kind(first)) - other.data();
      for (Offset i = first; i < last; ++i) {
        while (less < others && other(less) < kind(i)) ++less;
        all.ids(i + less) = kind(i);
        all.is_owned(i + less) = is_owned;
      }
    });
  };
  place(owned, ghosts, 1);
  place(ghosts, owned, 0);
  return all;
}

Array<Id, HostMemory> ghosts_of(const LocalVertices& vertices) { return members_of(vertices.is_owned, 0); }

Segmentation local_segmentation(const Points<double, HostMemory>& points,
                                const Array<std::uint8_t, HostMemory>& is_owned, int capacity) {
  const SomeSegments owned(points, is_owned, 1, capacity), ghosts(points, is_owned, 0, capacity);
  const auto vertex_input = allocate<Array<Id, HostMemory>>("GALE::vertex_input", points.extent(0));
  const auto vertex_begin =
      allocate<Array<Id, HostMemory>>("GALE::vertex_begin", owned.segments() + ghosts.segments() + Offset(1));
  const auto append = [&](const SomeSegments& some, Id vertices_before, Id segments_before) {
    parallel_for("GALE::append_vertices", HostSpace(), some.vertices(),
                 [&](Offset i) { vertex_input(vertices_before + i) = some.members(some.order(i)); });
    for (Id s = 0; s <= some.segments(); ++s) vertex_begin(segments_before + s) = vertices_before + some.begin(s);
  };
  append(owned, 0, 0);
  append(ghosts, owned.vertices(), owned.segments());
  return {vertex_input, vertex_begin, owned.segments()};
}

template <class Index>
Quads local_corners(const LocalTetrahedra<Index>& tetrahedra, const IdInterval& own, const GlobalIndex& vertices) {
  const auto corners = allocate<Quads>("GALE::local_tetrahedra", tetrahedra.count());
  const GlobalId shift = own.is_empty() ? 0 : vertices.find(own.begin) - own.begin;
  tetrahedra.for_each("GALE::local_tetrahedra", [&](Offset t, const auto& vertex_of) {
    for (int corner = 0; corner < 4; ++corner) {
      const GlobalId vertex = vertex_of(corner);
      corners(t, corner) = own.contains(vertex) ? static_cast<Id>(vertex + shift) : vertices.find(vertex);
    }
  });
  return corners;
}

Mesh local_mesh(const Tetrahedra<Id, HostMemory>& corners, const Array<const GlobalId, HostMemory>& ids,
                const Segmentation& segmentation) {
  try {
    return Mesh(corners, segmentation);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const Error&) {
    refuse_twins(corners, ids);
    throw;
  }
}

template Quads local_corners(const LocalTetrahedra<std::int32_t>&, const IdInterval&, const GlobalIndex&);
template Quads local_corners(const LocalTetrahedra<std::int64_t>&, const IdInterval&, const GlobalIndex&);

}  // namespace gale::detail
