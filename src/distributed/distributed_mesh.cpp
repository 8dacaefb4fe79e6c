#include <algorithm>
#include <future>
#include <string>

#include <gale/base/device.hpp>
#include <gale/base/require_ids.hpp>
#include <gale/distributed/curve_partition.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/distributed/exchange_plan.hpp>
#include <gale/distributed/local_mesh.hpp>
#include <gale/distributed/local_vertices.hpp>
#include <gale/distributed/on_demand.hpp>
#include <gale/distributed/own_and_ghosts.hpp>
#include <gale/mesh/octree.hpp>

namespace gale {

namespace {

/// Sums of an id and a count, and of two ids, are ids.
constexpr GlobalId greatest_id = (GlobalId(1) << 62) - 1;

template <class Ids>
void require_global_ids(const Ids& ids) {
  const Offset count = ids.extent(0);
  const Offset bad = reduce_min("GALE::bad_id", HostExecutionSpace(), count, count,
                                [&](Offset i) { return ids(i) < 0 || ids(i) > greatest_id ? i : count; });
  if (bad == count) return;
  const std::string bounds = ids(bad) < 0 ? "0 or more" : "at most " + std::to_string(greatest_id);
  throw Error("ids are " + bounds + ", not " + std::to_string(ids(bad)));
}

/// Throws gale::Error for what one rank can see is wrong with its part but for the tetrahedra's vertices.
template <class Index>
void validate(const MeshPart<Index>& part) {
  require_ids("vertices", static_cast<Offset>(part.vertex_ids.extent(0)));
  require_ids("tetrahedra", static_cast<Offset>(part.tetrahedra.extent(0)));
  require_global_ids(part.vertex_ids);
  require_global_ids(part.tetrahedron_ids);
  part.points.visit([](const auto& rows) {
    detail::require_finite<typename std::decay_t<decltype(rows)>::non_const_value_type>(HostExecutionSpace(), rows);
  });
}

/// The octree of some points, which grows on a thread of its own, by a quarter of this one's threads.
std::future<Segmentation> octree_meanwhile(const HostPoints& points, int capacity) {
  const int few = std::max(host_threads() / 4, 1);
  return std::async(std::launch::async | std::launch::deferred, [points, capacity, few] {
    use_device();
    const ThreadLimit limit(few);
    return detail::octree_of(points, capacity);
  });
}

/// Who hands over and owns which vertex.
template <class Index>
detail::VertexDirectory directory_of(const Communicator& ranks, const MeshPart<Index>& part, bool repartition) {
  if (repartition) return {ranks, part.vertex_ids, detail::curve_partition(ranks, part.vertex_ids, part.points)};
  if (const auto given = detail::GivenIntervals::of(ranks, part.vertex_ids)) return {ranks, *given};
  Array<int, HostMemory> owners;
  detail::together(ranks, [&] {
    owners = allocate<Array<int, HostMemory>>("GALE::given_owners", part.vertex_ids.extent(0));
    fill("GALE::given_owners", HostExecutionSpace(), owners, ranks.rank());
  });
  return {ranks, part.vertex_ids, owners};
}

/// Whether a part's ids are those that a local mesh would have: they ascend, and those of vertices count from 0.
template <class Index>
bool is_numbered_as_local(const MeshPart<Index>& part) {
  const auto& vertices = part.vertex_ids;
  const auto& tetrahedra = part.tetrahedron_ids;
  const Offset gaps = reduce_sum("GALE::count_gaps", HostExecutionSpace(), vertices.extent(0),
                                 [&](Offset i) { return Offset(vertices(i) != i); });
  const Offset descents = reduce_sum("GALE::count_descents", HostExecutionSpace(), tetrahedra.extent(0), [&](Offset i) {
    return Offset(tetrahedra(i) <= (i == 0 ? -1 : tetrahedra(i - 1)));
  });
  return gaps == 0 && descents == 0;
}

}  // namespace

struct DistributedMesh::Data {
  Communicator ranks;
  GlobalId vertices = 0, tetrahedra = 0;
  Offset given_vertices = 0;
  detail::LocalVertices held;
  detail::TetrahedronPlaces places;
  detail::OwnAndGhosts placed;
  Array<int, HostMemory> ghost_owners;
  Tetrahedra<Id, HostMemory> corners;
  detail::ExchangePlan from_givers, from_owners;
  std::unique_ptr<const Mesh> local;

  // What few ask for.
  detail::OnDemand<Array<const GlobalId, HostMemory>> vertex_ids, tetrahedron_ids;
  detail::OnDemand<Array<const int, HostMemory>> owners;
  detail::OnDemand<Points<double, HostMemory>> points;

  explicit Data(const Communicator& all);

  template <class Index>
  void make(const MeshPart<Index>& part, const PartitionOptions& options);
  template <class Index>
  void deal(const MeshPart<Index>& part, const PartitionOptions& options);
  template <class Index>
  void take(const MeshPart<Index>& part, const PartitionOptions& options);
  detail::OwnAndGhosts share(const detail::VertexDirectory& directory, const HostPoints& given);
};

DistributedMesh::Data::Data(const Communicator& all) : ranks(all) {
  vertex_ids.made_by([this] {
    const auto ids = allocate<detail::GlobalIds>("GALE::vertex_ids", held.count());
    parallel_for("GALE::vertex_ids", HostExecutionSpace(), held.count(),
                 [&](Offset i) { ids(i) = held.id(static_cast<Id>(i)); });
    return ids;
  });
  tetrahedron_ids.made_by([this] { return places.ids(); });
  points.made_by([this] { return placed.by_id(held); });
  owners.made_by([this] {
    const auto known = allocate<Array<int, HostMemory>>("GALE::owners", held.count());
    fill("GALE::owners", HostExecutionSpace(), known, ranks.rank());
    parallel_for("GALE::owners", HostExecutionSpace(), held.ghost_count(),
                 [&](Offset i) { known(held.ghost(i)) = ghost_owners(i); });
    return known;
  });
}

/// How values come to this rank: each local vertex' from who handed it over, each ghost's from its owner; points first.
/// A rank that hands over what it owns, one after the other, wants the ghosts' alone.
detail::OwnAndGhosts DistributedMesh::Data::share(const detail::VertexDirectory& directory, const HostPoints& given) {
  const bool in_place = directory.given() && !held.interval().is_empty();
  detail::ExchangePlan::Run run;
  Array<Id, HostMemory> ghosts, slots;
  detail::together(ranks, [&] {
    ghosts = allocate<Array<Id, HostMemory>>("GALE::ghosts", held.ghost_count());
    parallel_for("GALE::ghosts", HostExecutionSpace(), held.ghost_count(),
                 [&](Offset i) { ghosts(i) = held.ghost(i); });
    slots = in_place ? ghosts : iota("GALE::all_vertices", HostExecutionSpace(), held.count());
    if (!in_place) vertex_ids.get();
  });
  if (in_place)
    run = {held.owned(0), held.interval().begin - directory.given()->of(ranks.rank()).begin, held.owned_count()};
  const auto entries = in_place ? directory.find(held.ghosts()) : directory.find(vertex_ids.get());
  const auto of_ghost = [&](Id i) { return entries(in_place ? i : ghosts(i)); };
  detail::together(ranks, [&] {
    ghost_owners = allocate<Array<int, HostMemory>>("GALE::ghost_owners", held.ghost_count());
    parallel_for("GALE::ghost_owners", HostExecutionSpace(), held.ghost_count(),
                 [&](Offset i) { ghost_owners(i) = of_ghost(static_cast<Id>(i)).owner; });
  });
  from_givers = detail::ExchangePlan(
      ranks, run, slots, [&](Id i) { return entries(i).giver; }, [&](Id i) { return entries(i).place; },
      [](GlobalId place) { return static_cast<Id>(place); });
  from_owners = detail::ExchangePlan(
      ranks, {}, ghosts, [&](Id i) { return ghost_owners(i); }, [&](Id i) { return held.ghosts()(i); },
      [&](GlobalId id) { return held.find(id); });
  const auto fetched = given.visit([&](const auto& rows) {
    return from_givers.fetch<detail::SentPoint>(ranks, [&](Id at) {
      return detail::SentPoint{{rows(at, 0), rows(at, 1), rows(at, 2)}};
    });
  });
  detail::OwnAndGhosts all;
  detail::together(ranks, [&] { all = detail::own_and_ghosts(held, given, run, from_givers, fetched); });
  return all;
}

/// Sends everything to where it belongs.
template <class Index>
void DistributedMesh::Data::deal(const MeshPart<Index>& part, const PartitionOptions& options) {
  detail::together(ranks, [&] { validate(part); });
  const detail::VertexDirectory directory = directory_of(ranks, part, options.repartition);
  const detail::OwnedIds owned = directory.owned();
  // What a rank owns as it hands it over gets its segments on a device while tetrahedra travel.
  const bool in_place = directory.given() && !owned.interval.is_empty();
  std::future<Segmentation> segments;
  if (have_device && in_place) {
    const Offset place = owned.interval.begin - directory.given()->of(ranks.rank()).begin;
    segments = octree_meanwhile(part.points.part(place, owned.count()), options.capacity);
  }
  const detail::LocalTetrahedra<Index> held_tetrahedra(ranks, part, directory, owned.interval, options.most_local);
  detail::together(ranks, [&] { held = detail::LocalVertices(owned, held_tetrahedra.vertices_beside(owned)); });
  detail::require_local(ranks, "vertices", held.count(), options.most_local);
  vertices = directory.vertices();
  tetrahedra = ranks.sum(part.tetrahedra.extent(0));
  if (tetrahedra == 0) throw SharedError("the mesh has no tetrahedra");
  placed = share(directory, part.points);
  detail::together(ranks, [&] {
    places = held_tetrahedra.places();
    if (options.keep_corners) corners = detail::local_corners(held_tetrahedra, held);
    const Segmentation own = segments.valid() ? segments.get() : detail::octree_of(placed.owned, options.capacity);
    const Segmentation ghosts = detail::octree_of(placed.ghosts, options.capacity);
    const Segmentation segmentation = detail::local_segmentation(held, own, ghosts);
    local = std::make_unique<const Mesh>(detail::local_mesh(held_tetrahedra, held, segmentation));
  });
}

/// Takes a part that is the whole mesh, numbered without gaps, as it is.
template <class Index>
void DistributedMesh::Data::take(const MeshPart<Index>& part, const PartitionOptions& options) {
  local = std::make_unique<const Mesh>(part.tetrahedra, part.points.visit([&](const auto& rows) {
    return octree_segmentation(rows, options.capacity);
  }));
  if (options.keep_corners) {
    const auto quads = allocate<detail::Quads>("GALE::local_tetrahedra", part.tetrahedra.extent(0));
    parallel_for("GALE::local_tetrahedra", HostExecutionSpace(), quads.extent(0), [&](Offset t) {
      for (int corner = 0; corner < 4; ++corner) quads(t, corner) = static_cast<Id>(part.tetrahedra(t, corner));
    });
    corners = quads;
  }
  vertices = part.vertex_ids.extent(0);
  tetrahedra = part.tetrahedra.extent(0);
  held = detail::LocalVertices(detail::OwnedIds(detail::IdInterval{0, vertices}), {});
  places = detail::TetrahedronPlaces({tetrahedra, {}, part.tetrahedron_ids, 0}, {});
  placed.owned = part.points;
  from_givers = detail::ExchangePlan::of_one_rank(vertices);
}

template <class Index>
void DistributedMesh::Data::make(const MeshPart<Index>& part, const PartitionOptions& options) {
  given_vertices = part.vertex_ids.extent(0);
  const Offset most = std::max(part.vertex_ids.extent(0), part.tetrahedra.extent(0));
  if (ranks.size() == 1 && most <= options.most_local && is_numbered_as_local(part)) {
    try {
      take(part, options);
      return;
    } catch (const OutOfMemory&) {
      throw;
    } catch (const Error&) {
      // Dealing says by global ids what is wrong.
    }
  }
  deal(part, options);
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
GlobalId DistributedMesh::vertex_id(Id vertex) const { return data_->held.id(vertex); }
Id DistributedMesh::vertex_of(GlobalId id) const { return data_->held.find(id); }
GlobalId DistributedMesh::tetrahedron_id(Id tetrahedron) const { return data_->places.id(tetrahedron); }
const Array<const GlobalId, HostMemory>& DistributedMesh::vertex_ids() const { return data_->vertex_ids.get(); }
const Array<const GlobalId, HostMemory>& DistributedMesh::tetrahedron_ids() const {
  return data_->tetrahedron_ids.get();
}
const Array<const int, HostMemory>& DistributedMesh::owners() const { return data_->owners.get(); }
const Points<double, HostMemory>& DistributedMesh::points() const { return data_->points.get(); }
const Tetrahedra<Id, HostMemory>& DistributedMesh::corners() const { return data_->corners; }
Offset DistributedMesh::given_vertices() const { return data_->given_vertices; }
const detail::ExchangePlan& DistributedMesh::from_givers() const { return data_->from_givers; }
const detail::ExchangePlan& DistributedMesh::from_owners() const { return data_->from_owners; }

template GALE_EXPORT DistributedMesh::DistributedMesh(const Communicator&, const MeshPart<std::int32_t>&,
                                                      const PartitionOptions&);
template GALE_EXPORT DistributedMesh::DistributedMesh(const Communicator&, const MeshPart<std::int64_t>&,
                                                      const PartitionOptions&);

}  // namespace gale
