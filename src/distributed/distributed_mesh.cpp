#include <algorithm>
#include <mutex>
#include <string>

#include <gale/base/require_ids.hpp>
#include <gale/distributed/curve_partition.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/distributed/exchange_plan.hpp>
#include <gale/distributed/local_mesh.hpp>
#include <gale/mesh/morton_codes.hpp>

namespace gale {

namespace {

template <class Ids>
void require_no_negative(const Ids& ids) {
  const GlobalId least =
      reduce_min("GALE::least_id", HostSpace(), ids.extent(0), GlobalId(0), [&](Offset i) { return ids(i); });
  if (least < 0) throw Error("ids are 0 or more, not " + std::to_string(least));
}

/// Throws gale::Error for what one rank can see is wrong with its part but for the tetrahedra's vertices.
template <class Index>
void validate(const MeshPart<Index>& part) {
  require_ids("vertices", static_cast<Offset>(part.vertex_ids.extent(0)));
  require_ids("tetrahedra", static_cast<Offset>(part.tetrahedra.extent(0)));
  require_no_negative(part.vertex_ids);
  require_no_negative(part.tetrahedron_ids);
  detail::bounding_box<double>(HostSpace(), part.points);
}

/// Who hands over and owns which vertex.
template <class Index>
detail::VertexDirectory directory_of(const Communicator& ranks, const MeshPart<Index>& part, bool repartition) {
  if (repartition) return {ranks, part.vertex_ids, detail::curve_partition(ranks, part.vertex_ids, part.points)};
  if (const auto given = detail::GivenIntervals::of(ranks, part.vertex_ids)) return {ranks, *given};
  Array<int, HostMemory> owners;
  detail::together(ranks, [&] {
    owners = allocate<Array<int, HostMemory>>("GALE::given_owners", part.vertex_ids.extent(0));
    fill("GALE::given_owners", HostSpace(), owners, ranks.rank());
  });
  return {ranks, part.vertex_ids, owners};
}

/// Whether a part's ids are those that a local mesh would have: they ascend, and those of vertices count from 0.
template <class Index>
bool is_numbered_as_local(const MeshPart<Index>& part) {
  const auto& vertices = part.vertex_ids;
  const auto& tetrahedra = part.tetrahedron_ids;
  const Offset gaps = reduce_sum("GALE::count_gaps", HostSpace(), vertices.extent(0),
                                 [&](Offset i) { return Offset(vertices(i) != i); });
  const Offset descents = reduce_sum("GALE::count_descents", HostSpace(), tetrahedra.extent(0), [&](Offset i) {
    return Offset(tetrahedra(i) <= (i == 0 ? -1 : tetrahedra(i - 1)));
  });
  return gaps == 0 && descents == 0;
}

/// 0, 1, ..., count - 1.
Array<const GlobalId, HostMemory> counted(Offset count) {
  const auto ids = allocate<Array<GlobalId, HostMemory>>("GALE::tetrahedron_ids", count);
  parallel_for("GALE::tetrahedron_ids", HostSpace(), count, [&](Offset i) { ids(i) = i; });
  return ids;
}

}  // namespace

struct DistributedMesh::Data {
  Communicator ranks;
  GlobalId vertices = 0, tetrahedra = 0;
  Offset given_vertices = 0;
  Array<const GlobalId, HostMemory> vertex_ids;
  mutable Array<const GlobalId, HostMemory> tetrahedron_ids;
  mutable std::once_flag counts_tetrahedra;  ///< where nobody gave them ids: by the first who asks
  Array<const int, HostMemory> owners;
  Points<double, HostMemory> points;
  Tetrahedra<Id, HostMemory> corners;
  detail::ExchangePlan from_givers, from_owners;
  std::unique_ptr<const Mesh> local;

  explicit Data(const Communicator& all) : ranks(all) {}

  template <class Index>
  void make(const MeshPart<Index>& part, const PartitionOptions& options);
  template <class Index>
  void deal(const MeshPart<Index>& part, const PartitionOptions& options);
  template <class Index>
  void take(const MeshPart<Index>& part, const PartitionOptions& options);
  void make_plans(const detail::LocalVertices& held, const detail::GlobalIndex& index,
                  const Array<detail::VertexEntry, HostMemory>& entries);
  void fetch_points(const Points<double, HostMemory>& given);
};

/// How values come to this rank: each local vertex' from who handed it over, each ghost's from its owner.
void DistributedMesh::Data::make_plans(const detail::LocalVertices& held, const detail::GlobalIndex& index,
                                       const Array<detail::VertexEntry, HostMemory>& entries) {
  Array<Id, HostMemory> all, ghosts;
  detail::together(ranks, [&] {
    all = iota("GALE::all_vertices", HostSpace(), held.ids.extent(0));
    ghosts = detail::ghosts_of(held);
    const auto known = allocate<Array<int, HostMemory>>("GALE::owners", held.ids.extent(0));
    parallel_for("GALE::owners", HostSpace(), known.extent(0), [&](Offset i) { known(i) = entries(i).owner; });
    owners = known;
  });
  from_givers = detail::ExchangePlan(
      ranks, all, [&](Id i) { return entries(i).giver; }, [&](Id i) { return entries(i).place; },
      [](GlobalId place) { return static_cast<Id>(place); });
  from_owners = detail::ExchangePlan(
      ranks, ghosts, [&](Id i) { return entries(i).owner; }, [&](Id i) { return held.ids(i); },
      [&](GlobalId id) { return index.find(id); });
}

void DistributedMesh::Data::fetch_points(const Points<double, HostMemory>& given) {
  struct Point {
    double coordinates[3];
  };
  Kokkos::View<double* [3], Kokkos::LayoutRight, HostMemory> fetched;
  detail::together(ranks, [&] { fetched = allocate<decltype(fetched)>("GALE::local_points", vertex_ids.extent(0)); });
  from_givers(ranks, reinterpret_cast<const Point*>(given.data()), reinterpret_cast<Point*>(fetched.data()));
  points = fetched;
}

/// Sends everything to where it belongs.
template <class Index>
void DistributedMesh::Data::deal(const MeshPart<Index>& part, const PartitionOptions& options) {
  detail::together(ranks, [&] { validate(part); });
  const detail::VertexDirectory directory = directory_of(ranks, part, options.repartition);
  const detail::GlobalIds owned = directory.owned();
  const detail::IdInterval own = detail::interval_of(owned);
  const detail::LocalTetrahedra<Index> held_tetrahedra(ranks, part, directory, own, options.most_local);
  detail::LocalVertices held;
  detail::GlobalIndex index;
  detail::together(ranks, [&] {
    held = detail::local_vertices(owned, held_tetrahedra.vertices_beside(owned));
    index = detail::GlobalIndex(held.ids);
  });
  detail::require_local(ranks, "vertices", held.ids.extent(0), options.most_local);
  vertices = directory.vertices();
  tetrahedra = ranks.sum(part.tetrahedra.extent(0));
  if (tetrahedra == 0) throw SharedError("the mesh has no tetrahedra");
  vertex_ids = held.ids;
  tetrahedron_ids = held_tetrahedra.ids();
  make_plans(held, index, directory.find(vertex_ids));
  fetch_points(part.points);
  detail::together(ranks, [&] {
    const Tetrahedra<Id, HostMemory> quads = detail::local_corners(held_tetrahedra, own, index);
    if (options.keep_corners) corners = quads;
    local = std::make_unique<const Mesh>(detail::local_mesh(
        quads, tetrahedron_ids, detail::local_segmentation(points, held.is_owned, options.capacity)));
  });
}

/// Takes a part that is the whole mesh, numbered without gaps, as it is.
template <class Index>
void DistributedMesh::Data::take(const MeshPart<Index>& part, const PartitionOptions& options) {
  local = std::make_unique<const Mesh>(part.tetrahedra, octree_segmentation(part.points, options.capacity));
  if (options.keep_corners) {
    const auto quads = allocate<detail::Quads>("GALE::local_tetrahedra", part.tetrahedra.extent(0));
    parallel_for("GALE::local_tetrahedra", HostSpace(), quads.extent(0), [&](Offset t) {
      for (int corner = 0; corner < 4; ++corner) quads(t, corner) = static_cast<Id>(part.tetrahedra(t, corner));
    });
    corners = quads;
  }
  vertices = part.vertex_ids.extent(0);
  tetrahedra = part.tetrahedra.extent(0);
  vertex_ids = part.vertex_ids;
  points = part.points;
  tetrahedron_ids = part.tetrahedron_ids;
  const Array<int, HostMemory> all_mine("GALE::owners", vertices);
  owners = all_mine;
  from_givers = detail::ExchangePlan::of_one_rank(vertices);
}

template <class Index>
void DistributedMesh::Data::make(const MeshPart<Index>& part, const PartitionOptions& options) {
  given_vertices = part.vertex_ids.extent(0);
  const Offset most = std::max(part.vertex_ids.extent(0), part.tetrahedra.extent(0));
  if (ranks.size() == 1 && most <= options.most_local && is_numbered_as_local(part)) {
    take(part, options);
  } else {
    deal(part, options);
  }
}

template <class Index>
DistributedMesh::DistributedMesh(const Communicator& ranks, const MeshPart<Index>& part,
                                 const PartitionOptions& options) {
  const auto data = std::make_shared<Data>(ranks);
  data->make(part, options);
  data_ = data;
}

const Communicator& DistributedMesh::ranks() const { return data_->ranks; }
const Mesh& DistributedMesh::local() const { return *data_->local; }
GlobalId DistributedMesh::vertices() const { return data_->vertices; }
GlobalId DistributedMesh::tetrahedra() const { return data_->tetrahedra; }
const Array<const GlobalId, HostMemory>& DistributedMesh::vertex_ids() const { return data_->vertex_ids; }
const Array<const GlobalId, HostMemory>& DistributedMesh::tetrahedron_ids() const {
  std::call_once(data_->counts_tetrahedra, [this] {
    const Offset held = local().tetrahedra();
    if (static_cast<Offset>(data_->tetrahedron_ids.extent(0)) != held) data_->tetrahedron_ids = counted(held);
  });
  return data_->tetrahedron_ids;
}
const Array<const int, HostMemory>& DistributedMesh::owners() const { return data_->owners; }
const Points<double, HostMemory>& DistributedMesh::points() const { return data_->points; }
const Tetrahedra<Id, HostMemory>& DistributedMesh::corners() const { return data_->corners; }
Offset DistributedMesh::given_vertices() const { return data_->given_vertices; }
const detail::ExchangePlan& DistributedMesh::from_givers() const { return data_->from_givers; }
const detail::ExchangePlan& DistributedMesh::from_owners() const { return data_->from_owners; }

template GALE_EXPORT DistributedMesh::DistributedMesh(const Communicator&, const MeshPart<std::int32_t>&,
                                                      const PartitionOptions&);
template GALE_EXPORT DistributedMesh::DistributedMesh(const Communicator&, const MeshPart<std::int64_t>&,
                                                      const PartitionOptions&);

}  // namespace gale
