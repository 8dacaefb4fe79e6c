#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/transfer.hpp>
#include <gale/distributed/sharing/local_mesh.hpp>

namespace gale::detail {

namespace {

/// Throws if two cells have the same vertices, by their global ids.
void refuse_twins(const CellRows<Id>& cells, const CellPlaces& places) {
  std::vector<std::pair<std::array<Id, 4>, GlobalId>> all(cells.extent(0));
  for (std::size_t t = 0; t < all.size(); ++t) {
    auto& [corners, id] = all[t];
    for (std::size_t k = 0; k < cells.extent(1); ++k) corners[k] = cells(t, k);
    std::sort(corners.begin(), corners.end());
    id = places.id(static_cast<Offset>(t));
  }
  std::sort(all.begin(), all.end());
  for (std::size_t t = 1; t < all.size(); ++t) {
    if (all[t].first != all[t - 1].first) continue;
    throw Error("cells " + std::to_string(all[t - 1].second) + " and " + std::to_string(all[t].second) +
                " have the same vertices");
  }
}

/// The local input ids of some of a rank's vertices; an interval of them where there is no array.
template <class Memory>
struct OwnedInputIds {
  Id first;
  Array<const Id, Memory> ids;

  KOKKOS_FUNCTION Id operator()(Id i) const { return ids.extent(0) == 0 ? first + i : ids(i); }
};

/// Owned vertices segment after segment, then the ghosts likewise.
template <class Space>
Mirrored<Id> joined(const Space& space, const LocalVertices& vertices, const Mirrored<Id>& owned,
                    const Mirrored<Id>& ghosts) {
  using Here = MemoryOf<Space>;
  const auto all = allocate<Array<Id, Here>>("GALE::vertex_input", vertices.count());
  OwnedInputIds<Here> owned_ids{0, {}};
  if (vertices.owned_count() > 0) owned_ids = {vertices.owned(0), in_memory<Here>(vertices.owned_ids())};
  const Array<const Id, Here> order = owned.in<Here>();
  parallel_for(
      "GALE::owned_input", space, vertices.owned_count(), KOKKOS_LAMBDA(Offset i) { all(i) = owned_ids(order(i)); });
  const Offset count = vertices.ghost_count(), before = vertices.owned_count();
  const Array<const Id, HostMemory> ghost_order = ghosts.in<HostMemory>();
  const auto here = in_memory<Here>(
      tabulated<Id>("GALE::ghost_input", count, [&](Offset i) { return vertices.ghost(ghost_order(i)); }));
  parallel_for(
      "GALE::append_ghosts", space, count, KOKKOS_LAMBDA(Offset i) { all(before + i) = here(i); });
  space.fence();
  return all;
}

}  // namespace

Segmentation octree_of(const HostPoints& points, int capacity) {
  return points.visit([&](const auto& rows) { return octree_segmentation(rows, capacity); });
}

Segmentation local_segmentation(const LocalVertices& vertices, const Segmentation& owned, const Segmentation& ghosts) {
  const Mirrored<Id> vertex_input = in_worker_or_host_space(owned.vertex_input.on_device(), [&](const auto& space) {
    return joined(space, vertices, owned.vertex_input, ghosts.vertex_input);
  });
  const Id inner = owned.segments(), outer = ghosts.segments();
  const auto vertex_begin = allocate<Array<Id, HostMemory>>("GALE::vertex_begin", inner + outer + Offset(1));
  const auto inner_begin = owned.vertex_begin.in<HostMemory>(), outer_begin = ghosts.vertex_begin.in<HostMemory>();
  for (Id s = 0; s < inner; ++s) vertex_begin(s) = inner_begin(s);
  for (Id s = 0; s <= outer; ++s) vertex_begin(inner + s) = owned.vertices() + outer_begin(s);
  return {vertex_input, vertex_begin, inner};
}

template <class Index>
Mesh local_mesh(const LocalCells<Index>& cells, const LocalVertices& vertices, Array<const Quad, WorkerMemory> rows,
                const Segmentation& segmentation, const std::shared_ptr<const Exchange>& exchange) {
  try {
    return in_worker_or_host_space(true, [&](const auto& space) {
      const auto corners = corners_in(space, cells, vertices, std::exchange(rows, {}));
      return mesh_of_rows(corners, segmentation, exchange);
    });
  } catch (const OutOfMemory&) {
    throw;
  } catch (const Error&) {
    cells.require_cells();
    refuse_twins(local_corners(cells, vertices), cells.places());
    throw;
  }
}

#define GALE_INSTANTIATE(Index)                                                                             \
  template Mesh local_mesh(const LocalCells<Index>&, const LocalVertices&, Array<const Quad, WorkerMemory>, \
                           const Segmentation&, const std::shared_ptr<const Exchange>&)
GALE_INSTANTIATE(std::int32_t);
GALE_INSTANTIATE(std::int64_t);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
