#include <gale/relations/detail/global_rows.hpp>

#include <limits>

#include <gale/base/error.hpp>

// The one translation unit that includes Kokkos-Kernels: it takes long to compile.

#ifdef GALE_ENABLE_KOKKOS_KERNELS

#include <KokkosKernels_Handle.hpp>
#include <KokkosKernels_config.h>
#include <KokkosSparse_spgemm_numeric.hpp>
#include <KokkosSparse_spgemm_symbolic.hpp>
#if __has_include(<KokkosSparse_Utils.hpp>)
#include <KokkosSparse_Utils.hpp>
#else  // 3.x
#include <KokkosKernels_SparseUtils.hpp>
#endif

#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/base/sort_rows.hpp>

namespace gale::detail {

namespace {

#if __has_include(<KokkosSparse_Utils.hpp>)
using KokkosSparse::Impl::transpose_graph;
#else
using KokkosKernels::Impl::transpose_graph;
#endif
#if KOKKOSKERNELS_VERSION >= 40600  // 3.x doesn't define it
using KokkosSparse::spgemm_numeric;
using KokkosSparse::spgemm_symbolic;
#else
using KokkosSparse::Experimental::spgemm_numeric;
using KokkosSparse::Experimental::spgemm_symbolic;
#endif

using Offsets = Array<Offset, ProducerMemory>;
using Ids = Array<Id, ProducerMemory>;
using ConstOffsets = Array<const Offset, ProducerMemory>;
using ConstIds = Kokkos::View<const Id*, ProducerMemory, Kokkos::MemoryUnmanaged>;

/// The values of our matrices, which nobody reads: as small as the atomics of the space allow.
using Scalar = std::conditional_t<is_device<ProducerSpace>, float, signed char>;
using Scalars = Array<Scalar, ProducerMemory>;

using Handle =
    KokkosKernels::Experimental::KokkosKernelsHandle<Offset, Id, Scalar, ProducerSpace, ProducerMemory, ProducerMemory>;

/// A graph whose row i is ids[begin(i)] to ids[begin(i + 1) - 1]. The ids may be someone else's.
struct Graph {
  Offsets begin;
  Ids owned;
  ConstIds ids;

  Graph(const Offsets& row_begin, const ConstIds& of_others) : begin(row_begin), ids(of_others) {}
  Graph(const Offsets& row_begin, const Ids& own) : begin(row_begin), owned(own), ids(own.data(), own.extent(0)) {}

  Id rows() const { return static_cast<Id>(begin.extent(0)) - 1; }
};

Graph tetrahedron_vertices(const Mesh& mesh) {
  const Offset rows = mesh.tetrahedra();
  const auto begin = allocate<Offsets>("GALE::TV_begin", rows + 1);
  parallel_for(
      "GALE::TV_begin", ProducerSpace(), rows + 1, KOKKOS_LAMBDA(Offset t) { begin(t) = 4 * t; });
  return {begin, ConstIds(mesh.producer().tetrahedra.data(), 4 * rows)};
}

Graph transpose(const Graph& graph, Id columns) {
  const Offsets begin("GALE::VT_begin", columns + Offset(1));
  const auto ids = allocate<Ids>("GALE::VT", graph.ids.extent(0));
  transpose_graph<ConstOffsets, ConstIds, Offsets, Ids, Offsets, ProducerSpace>(graph.rows(), columns, graph.begin,
                                                                                graph.ids, begin, ids);
  sort_rows("GALE::VT_sort", begin, ids);
  return {begin, ids};
}

/// The rows of `begin` without one entry in each that has any. Returns how many entries are left.
Offset shorten_rows(const Offsets& begin, const Offsets& shorter) {
  return exclusive_scan(
      "GALE::VV_begin", ProducerSpace(), begin.extent(0) - 1, shorter,
      KOKKOS_LAMBDA(Offset v) { return begin(v + 1) > begin(v) ? begin(v + 1) - begin(v) - 1 : Offset(0); });
}

Graph without_diagonal(const Graph& graph, const Offsets& begin, Offset entries) {
  const auto ids = allocate<Ids>("GALE::VV", entries);
  const auto from_begin = graph.begin;
  const auto from = graph.ids;
  parallel_for(
      "GALE::VV", ProducerSpace(), graph.rows(), KOKKOS_LAMBDA(Offset v) {
        Offset to = begin(v);
        for (Offset i = from_begin(v); i < from_begin(v + 1); ++i) {
          if (from(i) != v) ids(to++) = from(i);
        }
      });
  return {begin, ids};
}

/// Which vertices share a tetrahedron.
Graph neighbours(const Graph& vt, const Graph& tv) {
  const Id vertices = vt.rows(), tetrahedra = tv.rows();
  const ConstOffsets vt_begin = vt.begin, tv_begin = tv.begin;
  Handle handle;
  handle.create_spgemm_handle(KokkosSparse::SPGEMM_KK);
  handle.get_spgemm_handle()->set_compression_cut_off(0);  // four far vertices don't compress: half the time, no memory
  const auto begin = allocate<Offsets>("GALE::product_begin", vertices + Offset(1));
  spgemm_symbolic(&handle, vertices, tetrahedra, vertices, vt_begin, vt.ids, false, tv_begin, tv.ids, false, begin);

  const auto vv_begin = allocate<Offsets>("GALE::VV_begin", vertices + Offset(1));
  const Offset entries = shorten_rows(begin, vv_begin);
  require_countable(Relation::VV, entries);

  const std::size_t product_entries = handle.get_spgemm_handle()->get_c_nnz();
  auto ids = allocate<Ids>("GALE::product", product_entries);
  const Scalars factors("GALE::product_factors", tv.ids.extent(0));
  auto values = allocate<Scalars>("GALE::product_values", product_entries);
  spgemm_numeric(&handle, vertices, tetrahedra, vertices, vt_begin, vt.ids, factors, false, tv_begin, tv.ids, factors,
                 false, begin, ids, values);
  const auto vv = without_diagonal({begin, ids}, vv_begin, entries);
  sort_rows("GALE::VV_sort", vv.begin, vv.owned);
  return vv;
}

GlobalRows to_host(const Graph& graph) {
  const auto begin = graph.begin;
  const auto offsets = allocate<Ids>("GALE::offsets", begin.extent(0));
  parallel_for(
      "GALE::offsets", ProducerSpace(), begin.extent(0),
      KOKKOS_LAMBDA(Offset i) { offsets(i) = static_cast<Id>(begin(i)); });
  return {on_host(offsets), on_host(graph.owned)};
}

}  // namespace

GlobalStars global_stars(const Mesh& mesh, bool with_vv) {
  require_countable(Relation::VT, 4 * Offset(mesh.tetrahedra()));
  const Graph tv = tetrahedron_vertices(mesh);
  const Graph vt = transpose(tv, mesh.vertices());
  GlobalStars stars;
  if (with_vv) stars.vv = to_host(neighbours(vt, tv));
  stars.vt = to_host(vt);
  return stars;
}

}  // namespace gale::detail

#else

namespace gale::detail {

GlobalStars global_stars(const Mesh&, bool) {
  throw Error(
      "the explicit structure is computed with Kokkos-Kernels, which this GALE was built without: configure it with "
      "GALE_ENABLE_KOKKOS_KERNELS=ON");
}

}  // namespace gale::detail

#endif

namespace gale::detail {

void require_countable(Relation relation, Offset entries) {
  constexpr Offset most = std::numeric_limits<Id>::max();
  if (entries <= most) return;
  throw Error("the explicit structure can't hold the " + std::to_string(entries) + " entries of " + name_of(relation) +
              ": at most " + std::to_string(most) + " fit");
}

}  // namespace gale::detail
