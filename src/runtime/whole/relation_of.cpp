#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/relation_of.hpp>
#include <gale/runtime/sweep.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale {

namespace {

/// The input's numbers of a mesh's simplices, each made once, where the mesh is. From any thread.
class KeptNumbers {
 public:
  /// Gives the names of a relation's simplices, for code that runs on `Memory`.
  template <class Memory>
  detail::RelationNames of(const Mesh& mesh, Relation relation) {
    const auto lock = detail::lock_or_stop(mutex_);
    const int rows = row_dimension(relation), entries = entry_dimension(relation);
    const auto is_missing = [&](int dimension) {
      return (rows == dimension || entries == dimension) && dimension < mesh.dimension() && made(dimension).size() == 0;
    };
    const bool edges = is_missing(1), triangles = is_missing(2);
    if (edges || triangles) {
      const auto numbers = detail::make_numbers(mesh, edges, triangles);
      if (edges) made_.edges = numbers.edges;
      if (triangles) made_.triangles = numbers.triangles;
    }
    return {ids<Memory>(mesh, rows), ids<Memory>(mesh, entries)};
  }

 private:
  const Mirrored<Id>& made(int dimension) const { return dimension == 1 ? made_.edges : made_.triangles; }

  template <class Memory>
  const Id* ids(const Mesh& mesh, int dimension) const {
    return dimension == 0                  ? mesh.vertex_input<Memory>().data()
           : dimension == mesh.dimension() ? mesh.cell_input<Memory>().data()
                                           : made(dimension).template in<Memory>().data();
  }

  std::mutex mutex_;
  detail::MadeNumbers made_;
};

template <class Memory>
detail::RelationNames names_in_input(const Mesh& mesh, Relation relation) {
  const auto kept = mesh.kept("GALE::input_numbers", [] { return std::make_shared<KeptNumbers>(); });
  KeptNumbers& numbers = *std::const_pointer_cast<KeptNumbers>(std::static_pointer_cast<const KeptNumbers>(kept));
  return numbers.of<Memory>(mesh, relation);
}

/// The relation from simplices of a dimension to those of a lower one.
Relation to_faces(int dimension, int face_dimension) {
  const auto all = members_of(face_relations);
  return *std::find_if(all.begin(), all.end(), [&](Relation one) {
    return row_dimension(one) == dimension && entry_dimension(one) == face_dimension;
  });
}

}  // namespace

/// Where the mesh lies on a device, kernels make relations to faces and from them, and a sweep others. On the host a
/// relation to faces is looked up in the tables of simplices; one from faces is such a relation the other way round; EE
/// and FF are merged from the rows of each simplex's faces; VV and TT come from a sweep.
Csr<const Id, HostMemory> relation_of(const Mesh& mesh, Relation relation, Ids ids, const SweepOptions& options) {
  detail::require_thread_count(options.threads);
  require_relations(relation, mesh.dimension());
  const detail::TrackedViews tracked;  // lasts, also where a sweep's body asks for it
  const ThreadLimit limit(options.threads);
  const int rows = row_dimension(relation), entries = entry_dimension(relation);
  std::array<Array<Id, HostMemory>, 4> own;  // GALE's ids, where these are wanted
  const auto own_ids = [&](int dimension) {
    auto& ids_there = own[dimension];
    if (ids_there.data() == nullptr)
      ids_there = iota("GALE::own_ids", HostExecutionSpace(), detail::count_of(mesh, dimension));
    return ids_there.data();
  };
  const detail::NamesOf names_of = [&](Relation one) {
    if (ids == Ids::input) return names_in_input<HostMemory>(mesh, one);
    return detail::RelationNames{own_ids(row_dimension(one)), own_ids(entry_dimension(one))};
  };
  const auto swept = [&] {
    const auto structure = make_structure(mesh, relation);
    return detail::swept_rows(*structure, relation, names_of(relation), options);
  };
  const bool is_adjacency = entries == rows, has_ghosts = mesh.owned_segments().size() < mesh.segments();
  if (has_ghosts || relation == Relation::VV || relation == Relation::TT || (mesh.on_device() && is_adjacency))
    return swept();
  const Relation down = is_adjacency ? to_faces(rows, rows - 1) : entries < rows ? relation : to_faces(entries, rows);
  if (mesh.on_device()) {
    return in_worker_or_host_space(mesh, [&](const auto& space) {
      using Space = std::decay_t<decltype(space)>;
      if constexpr (is_device<Space>) {
        const auto names = ids == Ids::input ? names_in_input<MemoryOf<Space>>(mesh, down) : detail::RelationNames{};
        const auto all = detail::kernel_rows(space, mesh, down, down != relation, names);
        detail::ProgressReport(mesh.segments(), options)(mesh.segments());
        return all;
      } else {
        return swept();
      }
    });
  }
  if (entries < rows)
    return detail::with_offsets(HostExecutionSpace(), detail::face_rows(mesh, relation, names_of, options));
  const auto faces = detail::face_rows(mesh, down, names_of, options);
  const auto cofaces = detail::transposed_rows(faces, detail::count_of(mesh, entry_dimension(down)), options.threads);
  return is_adjacency ? detail::joined_rows(faces, cofaces, options) : cofaces;
}

}  // namespace gale
