#include <limits>

#include <gale/base/error.hpp>
#include <gale/runtime/explicit/explicit_relations.hpp>

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
#include <gale/base/sort.hpp>

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

using WholeRows = Csr<Id, WorkerMemory>;
using Offsets = WholeRows::Offsets;
using Entries = Array<Id, WorkerMemory>;
using ConstOffsets = Array<const Offset, WorkerMemory>;
using ConstEntries = Kokkos::View<const Id*, WorkerMemory, Kokkos::MemoryUnmanaged>;

/// The values of our matrices, which nobody reads: as small as the atomics of the space allow.
using Scalar = std::conditional_t<is_device<WorkerSpace>, float, signed char>;
using Scalars = Array<Scalar, WorkerMemory>;

using Handle =
    KokkosKernels::Experimental::KokkosKernelsHandle<Offset, Id, Scalar, WorkerSpace, WorkerMemory, WorkerMemory>;

/// A relation as Kokkos-Kernels takes it.
struct Matrix {
  Id rows;
  ConstOffsets begin;
  ConstEntries ids;

  explicit Matrix(const Csr<const Id, WorkerMemory>& all)
      : rows(static_cast<Id>(all.rows())), begin(all.offsets), ids(all.entries) {}
};

/// XY and YX, and what the two steps of their product share.
class Product {
 public:
  Product(const Csr<const Id, WorkerMemory>& xy, const Csr<const Id, WorkerMemory>& yx) : xy_(xy), yx_(yx) {
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
  WholeRows numeric(const Offsets& begin) {
    const std::size_t entries = handle_.get_spgemm_handle()->get_c_nnz();
    auto ids = allocate<Entries>("GALE::product", entries);
    const Scalars factors("GALE::product_factors", xy_.ids.extent(0));  // as many in either
    auto values = allocate<Scalars>("GALE::product_values", entries);
    spgemm_numeric(&handle_, xy_.rows, yx_.rows, xy_.rows, xy_.begin, xy_.ids, factors, false, yx_.begin, yx_.ids,
                   factors, false, begin, ids, values);
    return {begin, ids};
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
void drop_diagonal(const char* label, const WholeRows& from, const WholeRows& rows) {
  parallel_for(
      label, WorkerSpace(), rows.rows(), KOKKOS_LAMBDA(Offset row) {
        Offset to = rows.offsets(row);
        for (Offset i = from.offsets(row); i < from.offsets(row + 1); ++i) {
          if (from.entries(i) != row) rows.entries(to++) = from.entries(i);
        }
      });
}

}  // namespace

void require_kokkos_kernels() {}

Csr<const Id, WorkerMemory> transpose(Relation relation, const Csr<const Id, WorkerMemory>& faces, Id rows) {
  const std::string label = label_of(relation);
  const Matrix matrix(faces);
  const WholeRows all = {Offsets(label + "_begin", rows + Offset(1)), allocate<Entries>(label, matrix.ids.extent(0))};
  transpose_graph<ConstOffsets, ConstEntries, Offsets, Entries, Offsets, WorkerSpace>(
      matrix.rows, rows, matrix.begin, matrix.ids, all.offsets, all.entries);
  sort_rows(WorkerSpace(), (label + "_sort").c_str(), all);
  return all;
}

Csr<const Id, WorkerMemory> neighbours(Relation relation, const Csr<const Id, WorkerMemory>& xy,
                                       const Csr<const Id, WorkerMemory>& yx) {
  const std::string label = label_of(relation);
  WholeRows all;
  all.offsets = allocate<Offsets>(label + "_begin", xy.rows() + 1);
  {
    Product product(xy, yx);
    const Offsets with_diagonal = product.symbolic();
    const Offset entries = shorten_rows((label + "_begin").c_str(), with_diagonal, all.offsets);
    require_countable(relation, entries);
    const WholeRows unsorted = product.numeric(with_diagonal);
    all.entries = allocate<Entries>(label, entries);
    drop_diagonal(label.c_str(), unsorted, all);
  }
  sort_rows(WorkerSpace(), (label + "_sort").c_str(), all);
  return all;
}

}  // namespace gale::detail

#else

namespace gale::detail {

void require_kokkos_kernels() {
  throw Error(
      "the explicit structure is computed with Kokkos-Kernels, which this GALE was built without: configure it with "
      "GALE_ENABLE_KOKKOS_KERNELS=ON");
}

Csr<const Id, WorkerMemory> transpose(Relation, const Csr<const Id, WorkerMemory>&, Id) {
  require_kokkos_kernels();
  return {};
}

Csr<const Id, WorkerMemory> neighbours(Relation, const Csr<const Id, WorkerMemory>&,
                                       const Csr<const Id, WorkerMemory>&) {
  require_kokkos_kernels();
  return {};
}

}  // namespace gale::detail

#endif

namespace gale::detail {

std::string label_of(Relation relation) { return "GALE::" + name_of(relation); }

void require_countable(Relation relation, Offset entries) {
  constexpr Offset most = std::numeric_limits<Id>::max();
  if (entries <= most) return;
  throw Error("the explicit structure can't hold the " + std::to_string(entries) + " entries of " + name_of(relation) +
              ": at most " + std::to_string(most) + " fit");
}

}  // namespace gale::detail
