#include <gale/base/error.hpp>
#include <gale/runtime/explicit/global_rows.hpp>

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

using Offsets = Array<Offset, WorkerMemory>;
using Ids = Array<Id, WorkerMemory>;
using ConstOffsets = Array<const Offset, WorkerMemory>;
using ConstIds = Kokkos::View<const Id*, WorkerMemory, Kokkos::MemoryUnmanaged>;

/// The values of our matrices, which nobody reads: as small as the atomics of the space allow.
using Scalar = std::conditional_t<is_device<WorkerSpace>, float, signed char>;
using Scalars = Array<Scalar, WorkerMemory>;

using Handle =
    KokkosKernels::Experimental::KokkosKernelsHandle<Offset, Id, Scalar, WorkerSpace, WorkerMemory, WorkerMemory>;

/// A graph as Kokkos-Kernels takes it.
struct Matrix {
  Id rows;
  ConstOffsets begin;
  ConstIds ids;

  explicit Matrix(const GlobalGraph& graph) : rows(graph.rows), begin(row_begin(graph)), ids(graph.ids) {}
};

/// XY and YX, and what the two steps of their product share.
class Product {
 public:
  Product(const GlobalGraph& xy, const GlobalGraph& yx) : xy_(xy), yx_(yx) {
    handle_.create_spgemm_handle(KokkosSparse::SPGEMM_KK);
    handle_.get_spgemm_handle()->set_compression_cut_off(
        0);  // half the time and no memory for VV, whose ids are far apart; no loss for others
  }

  /// Where the rows begin.
  Offsets symbolic() {
    const auto begin = allocate<Offsets>("GALE::product_begin", xy_.rows + Offset(1));
    spgemm_symbolic(&handle_, xy_.rows, yx_.rows, xy_.rows, xy_.begin, xy_.ids, false, yx_.begin, yx_.ids, false,
                    begin);
    return begin;
  }

  /// The rows, in no order. Kokkos-Kernels gives them along with values only.
  Ids numeric(const Offsets& begin) {
    const std::size_t entries = handle_.get_spgemm_handle()->get_c_nnz();
    auto ids = allocate<Ids>("GALE::product", entries);
    const Scalars factors("GALE::product_factors", xy_.ids.extent(0));  // as many in either
    auto values = allocate<Scalars>("GALE::product_values", entries);
    spgemm_numeric(&handle_, xy_.rows, yx_.rows, xy_.rows, xy_.begin, xy_.ids, factors, false, yx_.begin, yx_.ids,
                   factors, false, begin, ids, values);
    return ids;
  }

 private:
  Matrix xy_, yx_;
  Handle handle_;
};

/// The rows of `begin` without one entry in each that has any. Returns how many entries are left.
Offset shorten_rows(const char* label, const Offsets& begin, const Offsets& shorter) {
  return exclusive_scan(
      label, WorkerSpace(), begin.extent(0) - 1, shorter,
      KOKKOS_LAMBDA(Offset i) { return begin(i + 1) > begin(i) ? begin(i + 1) - begin(i) - 1 : Offset(0); });
}

/// Copies each row of `from` but the entry that is the row's own number.
void drop_diagonal(const char* label, const Offsets& from_begin, const Ids& from, const Offsets& begin,
                   const Ids& ids) {
  parallel_for(
      label, WorkerSpace(), begin.extent(0) - 1, KOKKOS_LAMBDA(Offset row) {
        Offset to = begin(row);
        for (Offset i = from_begin(row); i < from_begin(row + 1); ++i) {
          if (from(i) != row) ids(to++) = from(i);
        }
      });
}

}  // namespace

void require_kokkos_kernels() {}

GlobalGraph transpose(Relation relation, const GlobalGraph& faces, Id rows) {
  const std::string label = label_of(relation);
  const Matrix matrix(faces);
  const Offsets begin(label + "_begin", rows + Offset(1));
  const auto ids = allocate<Ids>(label, matrix.ids.extent(0));
  transpose_graph<ConstOffsets, ConstIds, Offsets, Ids, Offsets, WorkerSpace>(matrix.rows, rows, matrix.begin,
                                                                              matrix.ids, begin, ids);
  sort_rows(WorkerSpace(), (label + "_sort").c_str(), begin, ids);
  return {rows, 0, begin, ids};
}

GlobalGraph neighbours(Relation relation, const GlobalGraph& xy, const GlobalGraph& yx) {
  const std::string label = label_of(relation);
  const auto begin = allocate<Offsets>(label + "_begin", xy.rows + Offset(1));
  Ids ids;
  {
    Product product(xy, yx);
    const Offsets with_diagonal = product.symbolic();
    const Offset entries = shorten_rows((label + "_begin").c_str(), with_diagonal, begin);
    require_countable(relation, entries);
    const Ids unsorted = product.numeric(with_diagonal);
    ids = allocate<Ids>(label, entries);
    drop_diagonal(label.c_str(), with_diagonal, unsorted, begin, ids);
  }
  sort_rows(WorkerSpace(), (label + "_sort").c_str(), begin, ids);
  return {xy.rows, 0, begin, ids};
}

}  // namespace gale::detail

#else

namespace gale::detail {

void require_kokkos_kernels() {
  throw Error(
      "the explicit structure is computed with Kokkos-Kernels, which this GALE was built without: configure it with "
      "GALE_ENABLE_KOKKOS_KERNELS=ON");
}

GlobalGraph transpose(Relation, const GlobalGraph&, Id) {
  require_kokkos_kernels();
  return {};
}

GlobalGraph neighbours(Relation, const GlobalGraph&, const GlobalGraph&) {
  require_kokkos_kernels();
  return {};
}

}  // namespace gale::detail

#endif
