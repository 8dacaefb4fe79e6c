#include <algorithm>

#include <gale/distributed/sharing/local_vertices.hpp>

namespace gale::detail {

namespace {

using PointRows = Kokkos::View<double* [3], Kokkos::LayoutRight, HostMemory>;

/// Some of the points.
template <class Place>
Points<double, HostMemory> gathered(const PointRows& points, Offset count, const Place& place) {
  return tabulated_rows<double, 3>("GALE::some_points", count,
                                   [&](Offset i, int axis) { return points(place(i), axis); });
}

}  // namespace

LocalVertices::LocalVertices(const OwnedIds& owned, const GlobalIds& ghosts)
    : interval_(owned.interval), owned_count_(owned.count()), ghosts_(ghosts) {
  if (interval_.is_empty()) {
    merge(owned.ids);
    return;
  }
  const GlobalId* const begin = ghosts.data();
  lower_ghosts_ = std::lower_bound(begin, begin + ghosts.extent(0), interval_.begin) - begin;
  index_ = GlobalIndex(ghosts);
}

/// Each goes behind those of its own kind, and behind those of the other kind that are less.
void LocalVertices::merge(const GlobalIds& owned) {
  all_ = allocate<GlobalIds>("GALE::local_vertices", count());
  const auto place = [&](const GlobalIds& kind, const GlobalIds& other) {
    const auto places = allocate<Array<Id, HostMemory>>("GALE::merged_vertices", kind.extent(0));
    visit_merged(kind, other, [&](Offset i, Offset at) {
      places(i) = static_cast<Id>(at);
      all_(at) = kind(i);
    });
    return places;
  };
  owned_ = place(owned, ghosts_);
  ghost_ = place(ghosts_, owned);
  index_ = GlobalIndex(all_, GlobalIndex::Lookups::many);
}

Points<double, HostMemory> OwnAndGhosts::by_id(const LocalVertices& vertices) const {
  if (vertices.ghost_count() == 0) return owned.in_double();
  const auto all = allocate<PointRows>("GALE::local_points", vertices.count());
  const auto put = [&](const HostPoints& some, const auto& place) {
    some.visit([&](const auto& rows) {
      parallel_for("GALE::local_points", HostExecutionSpace(), some.count(), [&](Offset i) {
        for (int axis = 0; axis < 3; ++axis) all(place(i), axis) = rows(i, axis);
      });
    });
  };
  put(owned, [&](Offset i) { return vertices.owned(i); });
  put(ghosts, [&](Offset i) { return vertices.ghost(i); });
  return all;
}

OwnAndGhosts own_and_ghosts(const LocalVertices& vertices, const HostPoints& given, const ExchangePlan::Run& run,
                            const ExchangePlan& plan, const EntriesByRank<SentPoint>& fetched) {
  if (run.count > 0) {
    const auto ghosts = allocate<PointRows>("GALE::ghost_points", vertices.ghost_count());
    parallel_for("GALE::ghost_points", HostExecutionSpace(), fetched.count(), [&](Offset k) {
      const Offset ghost = vertices.ghost_number(plan.slots()(k));
      for (int axis = 0; axis < 3; ++axis) ghosts(ghost, axis) = fetched.entries(k).coordinates[axis];
    });
    return {given.part(run.place, run.count), Points<double, HostMemory>(ghosts)};
  }
  const auto all = allocate<PointRows>("GALE::local_points", vertices.count());
  const Points<double, HostMemory> mine = given.in_double();
  plan.fill(HostExecutionSpace(), reinterpret_cast<const SentPoint*>(mine.data()), fetched,
            reinterpret_cast<SentPoint*>(all.data()));
  return {gathered(all, vertices.owned_count(), [&](Offset i) { return vertices.owned(i); }),
          gathered(all, vertices.ghost_count(), [&](Offset i) { return vertices.ghost(i); })};
}

}  // namespace gale::detail
