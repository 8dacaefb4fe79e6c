#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/distributed/sharing/layer_ghosts.hpp>
#include <gale/distributed/sharing/local_grid.hpp>
#include <gale/distributed/sharing/local_mesh.hpp>
#include <gale/distributed/sharing/local_vertices.hpp>
#include <gale/distributed/sharing/own_octree.hpp>
#include <gale/distributed/sharing/valid_part.hpp>
#include <gale/distributed/sharing/vertex_directory.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale {

namespace detail {

/// A value that is made when somebody first asks for it, by a function that was set before.
template <class T>
class OnDemand {
 public:
  void made_by(std::function<T()> make) { make_ = std::move(make); }
  const T& get() const {
    return value_.get([this] { return make_ ? make_() : T(); });
  }

 private:
  std::function<T()> make_;
  OnceMade<T> value_;
};

}  // namespace detail

namespace {

/// Who hands over and owns which vertex. `ids`: the interval of those that this rank hands over, if they are one.
template <class Index>
detail::VertexDirectory directory_of(const Communicator& ranks, const MeshPart<Index>& part,
                                     const std::optional<detail::IdInterval>& ids, bool repartition) {
  if (repartition) return {ranks, part.vertex_ids, detail::curve_partition(ranks, part.vertex_ids, part.points)};
  if (const auto given = detail::GivenIntervals::of(ranks, ids)) return {ranks, *given};
  Array<int, HostMemory> owners;
  detail::together(ranks, [&] {
    owners =
        detail::tabulated<int>("GALE::given_owners", part.vertex_ids.extent(0), [&](Offset) { return ranks.rank(); });
  });
  return {ranks, part.vertex_ids, owners};
}

/// Whether a part's ids are those that a local mesh would have: they ascend, and those of vertices count from 0.
template <class Index>
bool is_numbered_as_local(const MeshPart<Index>& part) {
  const auto& vertices = part.vertex_ids;
  const auto& cells = part.cell_ids;
  const Offset gaps = reduce_sum("GALE::count_gaps", HostExecutionSpace(), vertices.extent(0),
                                 [&](Offset i) { return Offset(vertices(i) != i); });
  const Offset descents = reduce_sum("GALE::count_descents", HostExecutionSpace(), cells.extent(0),
                                     [&](Offset i) { return Offset(cells(i) <= (i == 0 ? -1 : cells(i - 1))); });
  return gaps == 0 && descents == 0;
}

}  // namespace

/// How the mesh lies on the ranks, and what this one asks of the others.
class DistributedMesh::Sharing final : public Exchange {
 public:
  explicit Sharing(const Communicator& all);

  /// Makes this rank's part, with `self` for what it asks of others.
  template <class Index>
  Mesh make(const MeshPart<Index>& part, const PartitionOptions& options, const std::shared_ptr<const Exchange>& self);
  Mesh make(const GridLayers& part, const PartitionOptions& options, const std::shared_ptr<const Exchange>& self);

  const Ranks& ranks() const override { return ranks_; }
  GlobalId vertices() const override { return vertices_; }
  GlobalId cells() const override { return cells_; }
  GlobalId vertex_id(Id vertex) const override { return held_.id(vertex); }
  GlobalId cell_id(Id cell) const override { return places_.id(cell); }
  Id vertex_of(GlobalId id) const override { return held_.find(id); }
  Id cell_of(GlobalId id) const override {
    return places_.are_counted() ? places_.counted(id) : cell_index_.get().find(id);
  }
  int owner(Id vertex) const override {
    const Offset ghost = held_.ghost_if_any(vertex);
    return ghost < 0 ? ranks_.rank() : ghost_owners_(ghost);
  }
  Array<int, HostMemory> owners_of(const Array<const GlobalId, HostMemory>& ids) const override;
  Offset given_vertices() const override { return given_vertices_; }
  const detail::ExchangePlan& from_givers() const override { return from_givers_; }
  const detail::ExchangePlan& from_owners() const override { return from_owners_; }

  // What few ask for.
  detail::OnDemand<Array<const GlobalId, HostMemory>> vertex_ids, cell_ids;
  detail::OnDemand<Array<const int, HostMemory>> owners;
  detail::OnDemand<Points<double, HostMemory>> points;
  CellRows<Id> corners;

 private:
  template <class Index>
  Mesh deal(MeshPart<Index> part, const PartitionOptions& options, const std::shared_ptr<const Exchange>& self);
  template <class Index>
  Mesh take(const MeshPart<Index>& part, const PartitionOptions& options, const std::shared_ptr<const Exchange>& self);
  detail::ExchangePlan::Run share(const detail::VertexDirectory& directory,
                                  Array<detail::VertexEntry, HostMemory> of_owned);
  detail::OwnAndGhosts share_points(const HostPoints& given, const detail::ExchangePlan::Run& run) const;

  Communicator ranks_;
  GlobalId vertices_ = 0, cells_ = 0;
  Offset given_vertices_ = 0;
  detail::LocalVertices held_;
  detail::CellPlaces places_;
  detail::OwnAndGhosts placed_;
  Array<int, HostMemory> ghost_owners_;
  std::optional<detail::GivenIntervals> given_;
  detail::ExchangePlan from_givers_, from_owners_;
  detail::OnDemand<detail::GlobalIndex> cell_index_;
};

DistributedMesh::Sharing::Sharing(const Communicator& all) : ranks_(all) {
  vertex_ids.made_by([this] {
    return detail::tabulated<GlobalId>("GALE::vertex_ids", held_.count(),
                                       [&](Offset i) { return held_.id(static_cast<Id>(i)); });
  });
  cell_ids.made_by([this] { return places_.ids(); });
  cell_index_.made_by([this] { return detail::GlobalIndex(cell_ids.get()); });
  points.made_by([this] { return placed_.by_id(held_); });
  owners.made_by([this] {
    return held_.tabulated<int>(
        "GALE::owners", [this](Offset) { return ranks_.rank(); }, ghost_owners_);
  });
}

Array<int, HostMemory> DistributedMesh::Sharing::owners_of(const Array<const GlobalId, HostMemory>& ids) const {
  struct Nothing {};
  Array<int, HostMemory> owners;
  detail::GlobalIds owned;
  detail::together(ranks_, [&] {
    if (given_) {
      owners =
          detail::tabulated<int>("GALE::owners_of_ids", ids.extent(0), [&](Offset i) { return given_->giver(ids(i)); });
    } else {
      owned = detail::tabulated<GlobalId>("GALE::owned_ids", held_.owned_count(),
                                          [&](Offset i) { return held_.id(held_.owned(i)); });
    }
  });
  if (given_) return owners;
  const detail::HomeTable<int> table(
      ranks_, owned, [](Id) { return Nothing(); }, [](int rank, Nothing) { return rank; });
  return table.find(ranks_, ids, -1);
}

/// Plans how values come to this rank: each local vertex's from who handed it over, each ghost's from its owner. A rank
/// that hands over what it owns, one after the other, wants the ghosts' alone: then the run isn't empty.
detail::ExchangePlan::Run DistributedMesh::Sharing::share(const detail::VertexDirectory& directory,
                                                          Array<detail::VertexEntry, HostMemory> of_owned) {
  const bool in_place = directory.given() && !held_.interval().is_empty();
  detail::ExchangePlan::Run run;
  if (in_place)
    run = {held_.owned(0), held_.interval().begin - directory.given()->of(ranks_.rank()).begin, held_.owned_count()};
  const auto of_ghosts = directory.find(held_.ghosts());
  Array<Id, HostMemory> ghosts, slots;
  Array<detail::VertexEntry, HostMemory> entries;  // of slots
  detail::together(ranks_, [&] {
    ghosts = detail::tabulated<Id>("GALE::ghosts", held_.ghost_count(), [&](Offset i) { return held_.ghost(i); });
    ghost_owners_ =
        detail::tabulated<int>("GALE::ghost_owners", held_.ghost_count(), [&](Offset i) { return of_ghosts(i).owner; });
    slots = in_place ? ghosts : iota("GALE::all_vertices", HostExecutionSpace(), held_.count());
    entries = in_place ? of_ghosts : held_.tabulated<detail::VertexEntry>("GALE::entries_of_all", of_owned, of_ghosts);
    of_owned = {};
  });
  from_givers_ = detail::ExchangePlan(
      ranks_, run, slots, [&](Id i) { return entries(i).giver; }, [&](Id i) { return entries(i).place; },
      [](GlobalId place) { return static_cast<Id>(place); });
  // Where all know that a ghost comes from its owner, the same values travel.
  const bool gives_own = directory.given() && (in_place || held_.owned_count() == 0);
  if (ranks_.least(std::int64_t(gives_own)) == 1) {
    detail::together(ranks_, [&] { from_owners_ = from_givers_.between_slots(); });
  } else {
    from_owners_ = detail::ExchangePlan(
        ranks_, {}, ghosts, [&](Id i) { return ghost_owners_(i); }, [&](Id i) { return held_.ghosts()(i); },
        [&](GlobalId id) { return held_.find(id); });
  }
  return run;
}

/// Brings points to those who hold them.
detail::OwnAndGhosts DistributedMesh::Sharing::share_points(const HostPoints& given,
                                                            const detail::ExchangePlan::Run& run) const {
  const auto fetched = given.visit([&](const auto& rows) {
    return from_givers_.fetch<detail::SentPoint>(ranks_, [&](Id at) {
      return detail::SentPoint{{rows(at, 0), rows(at, 1), rows(at, 2)}};
    });
  });
  detail::OwnAndGhosts all;
  detail::together(ranks_, [&] { all = detail::own_and_ghosts(held_, given, run, from_givers_, fetched); });
  return all;
}

/// Sends everything to where it belongs.
template <class Index>
Mesh DistributedMesh::Sharing::deal(MeshPart<Index> part, const PartitionOptions& options,
                                    const std::shared_ptr<const Exchange>& self) {
  std::optional<detail::IdInterval> ids;
  detail::together(ranks_, [&] {
    detail::require_part(part);
    ids = detail::valid_interval(part.vertex_ids);
  });
  const int corners_of_each = detail::corners_of_all(ranks_, part);
  const Offset most_local = ranks_.least(std::int64_t(options.most_local));
  if (part.cells.extent(0) == 0) part.cells = CellRows<Index>(nullptr, 0, corners_of_each);
  std::optional<detail::VertexDirectory> directory = directory_of(ranks_, part, ids, options.repartition);
  detail::OwnedVertices all_owned = directory->owned();
  const detail::OwnedIds& owned = all_owned.ids;
  detail::OwnOctree octree(part.points, *directory, owned.interval, ranks_.rank());
  detail::ReadCells<WorkerMemory> read;
  detail::together(ranks_, [&] {
    octree.require_finite();
    read = detail::read_cells(part, owned.interval);
  });
  octree.begin(options.capacity);
  const detail::LocalCells<Index> held_cells(ranks_, part, *directory, owned.interval, read.outer, most_local);
  read.outer = {};
  detail::together(ranks_, [&] { held_ = detail::LocalVertices(owned, held_cells.vertices_beside(owned)); });
  detail::require_local(ranks_, "vertices", held_.count(), most_local);
  vertices_ = directory->vertices();
  cells_ = ranks_.sum(part.cells.extent(0));
  given_ = directory->given();
  placed_ = share_points(part.points, share(*directory, std::exchange(all_owned.entries, {})));
  directory.reset();
  Segmentation own;
  detail::together(ranks_, [&] { own = octree.get(placed_.owned, options.capacity); });
  std::optional<Mesh> mesh;
  detail::together(ranks_, [&] {
    places_ = held_cells.places();
    if (options.keep_corners) corners = detail::local_corners(held_cells, held_);
    const Segmentation ghosts = detail::octree_of(placed_.ghosts, options.capacity);
    const Segmentation segmentation = detail::local_segmentation(held_, own, ghosts);
    mesh = detail::local_mesh(held_cells, held_, std::exchange(read.rows, {}), segmentation, self);
  });
  return *mesh;
}

/// Takes a part that is the whole mesh, numbered without gaps, as it is.
template <class Index>
Mesh DistributedMesh::Sharing::take(const MeshPart<Index>& part, const PartitionOptions& options,
                                    const std::shared_ptr<const Exchange>& self) {
  const Mesh mesh = detail::mesh_of_rows(part.cells, detail::octree_of(part.points, options.capacity), self);
  if (options.keep_corners) {
    const auto rows =
        allocate<CellRows<Id>::non_const_type>("GALE::local_cells", part.cells.extent(0), part.cells.extent(1));
    Kokkos::deep_copy(rows, part.cells);
    corners = rows;
  }
  vertices_ = part.vertex_ids.extent(0);
  cells_ = part.cells.extent(0);
  held_ = detail::LocalVertices(detail::OwnedIds(detail::IdInterval{0, vertices_}), {});
  places_ = detail::CellPlaces({cells_, {}, part.cell_ids, 0}, {});
  placed_.owned = part.points;
  from_givers_ = detail::ExchangePlan::of_one_rank(vertices_);
  return mesh;
}

template <class Index>
Mesh DistributedMesh::Sharing::make(const MeshPart<Index>& part, const PartitionOptions& options,
                                    const std::shared_ptr<const Exchange>& self) {
  given_vertices_ = part.vertex_ids.extent(0);
  const Offset most = std::max(part.vertex_ids.extent(0), part.cells.extent(0));
  if (ranks_.size() == 1 && most <= options.most_local && is_numbered_as_local(part)) {
    try {
      return take(part, options, self);
    } catch (const OutOfMemory&) {
      throw;
    } catch (const Error&) {
      // Dealing says by global ids what is wrong.
    }
  }
  return deal(part, options, self);
}

Mesh DistributedMesh::Sharing::make(const GridLayers& part, const PartitionOptions& options,
                                    const std::shared_ptr<const Exchange>& self) {
  const detail::LocalGrid local = detail::local_grid(ranks_, part, ranks_.least(std::int64_t(options.most_local)));
  vertices_ = local.all_vertices;
  cells_ = local.all_cells;
  given_vertices_ = local.owned.size();
  given_.emplace(local.owned_ids);
  detail::together(ranks_, [&] {
    held_ = detail::LocalVertices(detail::OwnedIds(local.owned_ids[ranks_.rank()]), local.ghosts);
    places_ = detail::CellPlaces({local.grid->cells(), {}, {}, local.first_cell}, {});
  });
  detail::ExchangePlan::Run run;
  if (local.whole_layer > 0) {
    detail::together(ranks_, [&] {
      const detail::LayerGhosts ghosts(ranks_.rank(), *given_, held_, local.whole_layer);
      ghost_owners_ = ghosts.owners;
      from_givers_ = ghosts.from_owners;
      from_owners_ = from_givers_.between_slots();
      run = from_givers_.run();
    });
  } else {
    run = share(detail::VertexDirectory(ranks_, *given_), {});
  }
  if (ranks_.size() == 1) from_givers_ = detail::ExchangePlan::of_one_rank(given_vertices_);
  std::int64_t with_points[] = {part.positions.count() == given_vertices_, part.positions.count() == 0};
  ranks_.sum(with_points, 2);
  const bool has_points = with_points[0] == ranks_.size(), has_none = with_points[1] == ranks_.size();
  if (!has_points && !has_none) throw SharedError("some ranks hand over other points than those of their layers");
  if (has_points) placed_ = share_points(part.positions, run);
  if (!has_points) points.made_by({});
  std::optional<Mesh> mesh;
  detail::together(ranks_, [&] {
    const int cell_corners = part.points[2] == 1 ? 3 : 4;
    const auto cells = allocate<CellRows<Id>::non_const_type>(
        "GALE::local_cells", options.keep_corners ? local.grid->cells() : 0, cell_corners);
    if (cells.extent(0) > 0) local.grid->write_cells(cells);
    corners = cells;
    mesh = Mesh(*local.grid, options.capacity, local.owned, self);
  });
  return *mesh;
}

template <class Part>
DistributedMesh::Shared DistributedMesh::shared(const Communicator& ranks, const Part& part,
                                                const PartitionOptions& options) {
  const auto sharing = std::make_shared<Sharing>(ranks);
  const Mesh mesh = sharing->make(part, options, sharing);
  return {mesh, sharing};
}

const Array<const GlobalId, HostMemory>& DistributedMesh::vertex_ids() const { return sharing_->vertex_ids.get(); }
const Array<const GlobalId, HostMemory>& DistributedMesh::cell_ids() const { return sharing_->cell_ids.get(); }
const Array<const int, HostMemory>& DistributedMesh::owners() const { return sharing_->owners.get(); }
const Points<double, HostMemory>& DistributedMesh::points() const { return sharing_->points.get(); }
const CellRows<Id>& DistributedMesh::corners() const { return sharing_->corners; }

#define GALE_INSTANTIATE(Part)                                                                           \
  template GALE_EXPORT DistributedMesh::Shared DistributedMesh::shared(const Communicator&, const Part&, \
                                                                       const PartitionOptions&)
GALE_INSTANTIATE(GridLayers);
GALE_INSTANTIATE(MeshPart<std::int32_t>);
GALE_INSTANTIATE(MeshPart<std::int64_t>);
#undef GALE_INSTANTIATE

}  // namespace gale
