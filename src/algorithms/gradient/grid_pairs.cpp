#include <algorithm>

#include <gale/algorithms/gradient/gradient_sweep.hpp>
#include <gale/algorithms/gradient/grid_pairs.hpp>
#include <gale/mesh/grid.hpp>
#include <gale/runtime/sweep.hpp>

namespace gale::detail {

WholeStar::WholeStar(const StarKind& kind) {
  std::fill_n(&triangle[0][0], edges * 16, no_triangle);
  int count = 0;
  for (int t = 0; t < kind.cells; ++t) {
    of_kind[t] = kind.cell[t];
    int d[3];
    for (int k = 0; k < 3; ++k) d[k] = kind.direction[kind.link[3 * t + k]];
    for (int k = 0; k < 3; ++k) {
      const int one = d[(k + 1) % 3], other = d[(k + 2) % 3];
      const int there = triangle[one][other];
      if (there == no_triangle) {
        triangle[one][other] = triangle[other][one] = static_cast<std::uint8_t>(count);
        around[count++] = Bytes(d[k], 0, t, 0);
      } else {
        around[there] = Bytes(around[there][0], d[k], around[there][2], t);
      }
    }
  }
}

void pair_all_on_grid(GradientStore& store, int consumers, const SweepOptions& options) {
  const Mesh& mesh = store.mesh;
  const Grid& grid = *mesh.grid();
  const StarKind* const kinds = grid.kinds_in<HostMemory>();
  const int dimension = mesh.dimension();
  const WholeStar whole(kinds[grid_kinds - 1]);
  const std::uint64_t* const keys = store.order.keys();
  std::vector<std::unique_ptr<GradientSweep>> others;
  for (int i = 0; i < consumers; ++i) others.push_back(std::make_unique<GradientSweep>(store, i));
  const Id* const begin = mesh.vertex_begin().data();
  sweep(mesh.owned_segments(), options, [&](int consumer, Id segment) {
    const ConsumerSink sink = store.sink(consumer);
    GridStarRows rows;
    GridCursor at(grid.in<HostMemory>());
    for (Id v = begin[segment]; v < begin[segment + 1]; ++v) {
      at.go_to(v);
      const bool is_inner = dimension == 3 && at.kind() == grid_kinds - 1;
      if (!is_inner || !pair_on_grid<false>(sink, whole, keys, at))
        others[consumer]->pair(rows.at(at, kinds[at.kind()], dimension));
    }
  });
}

}  // namespace gale::detail
