#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/relation_of.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale {

namespace {

/// The input's numbers of a mesh's simplices, each made once. From any thread.
class KeptNumbers {
 public:
  std::array<const Id*, 2> of(const Mesh& mesh, int one, int other) {
    const auto lock = detail::lock_or_stop(mutex_);
    const auto missing = [&](int dimension) { return numbers_[dimension].data() == nullptr; };
    if (std::min(one, other) == 1 && std::max(one, other) == 2 && missing(1) && missing(2) && mesh.dimension() == 3) {
      const InputNumbers both = input_numbers(mesh);
      numbers_[1] = both.edges;
      numbers_[2] = both.triangles;
    }
    for (const int dimension : {one, other}) {
      if (missing(dimension)) numbers_[dimension] = input_numbers(mesh, dimension);
    }
    return {numbers_[one].data(), numbers_[other].data()};
  }

 private:
  std::mutex mutex_;
  std::array<Array<const Id, HostMemory>, 4> numbers_;
};

detail::RelationNames names_in_input(const Mesh& mesh, Relation relation) {
  const auto kept = mesh.kept("GALE::input_numbers", [] { return std::make_shared<KeptNumbers>(); });
  auto& numbers = *std::const_pointer_cast<KeptNumbers>(std::static_pointer_cast<const KeptNumbers>(kept));
  const auto [rows, entries] = numbers.of(mesh, row_dimension(relation), entry_dimension(relation));
  return {rows, entries};
}

/// The relation from simplices of a dimension to those of a lower one.
Relation to_faces(int dimension, int face_dimension) {
  const auto all = members_of(face_relations);
  return *std::find_if(all.begin(), all.end(), [&](Relation one) {
    return row_dimension(one) == dimension && entry_dimension(one) == face_dimension;
  });
}

}  // namespace

/// In a sweep where the mesh lies on a device, which does the work then. On the host a relation to faces is looked up
/// in the tables of simplices; one from faces is such a relation the other way round; EE and FF are merged from the
/// rows of each simplex's faces; VV and TT come from a sweep.
Csr<const Id, HostMemory> relation_of(const Mesh& mesh, Relation relation, Ids ids, const SweepOptions& options) {
  if (options.threads < 1) throw Error("a relation takes at least 1 thread, not " + std::to_string(options.threads));
  require_relations(relation, mesh.dimension());
  const detail::TrackedViews tracked;  // it lasts, also where a sweep's body asks for it
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
    if (ids == Ids::input) return names_in_input(mesh, one);
    return detail::RelationNames{own_ids(row_dimension(one)), own_ids(entry_dimension(one))};
  };
  const bool has_ghosts = mesh.owned_segments().size() < mesh.segments();
  if (mesh.on_device() || has_ghosts || relation == Relation::VV || relation == Relation::TT) {
    const auto structure = make_structure(mesh, relation);
    return detail::swept_rows(*structure, relation, names_of(relation), options);
  }
  if (entries < rows) {
    return detail::with_offsets(HostExecutionSpace(), detail::face_rows(mesh, relation, names_of, options));
  }
  const bool is_adjacency = entries == rows;
  const Relation down = is_adjacency ? to_faces(rows, rows - 1) : to_faces(entries, rows);
  const auto faces = detail::face_rows(mesh, down, names_of, options);
  const auto cofaces = detail::transposed_rows(faces, detail::count_of(mesh, entry_dimension(down)), options.threads);
  return is_adjacency ? detail::joined_rows(faces, cofaces, options) : cofaces;
}

}  // namespace gale
