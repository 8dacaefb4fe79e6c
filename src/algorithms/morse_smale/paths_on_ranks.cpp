#include <algorithm>
#include <numeric>
#include <tuple>
#include <type_traits>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/paths_here.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/exchange/messages.hpp>

namespace gale::detail {

namespace {

/// Where the path from an exit comes to, as other ranks are told.
struct ToldStop {
  Id exit;
  std::int32_t rank;
  std::int64_t at;
};

/// The cells that have a ghost.
template <class Space>
Array<Id, MemoryOf<Space>> shared_cells(const Space& space, const Mesh& mesh) {
  const CellReader cells = mesh.cell_reader<MemoryOf<Space>>();
  const Interval owned = mesh.owned_vertices();
  return selected(
      "GALE::shared_cells", space, mesh.cells(), KOKKOS_LAMBDA(Offset t) {
        const Quad corners = cells(static_cast<Id>(t));  // which ascend
        return !owned.has(corners.a) || !owned.has(corners.d);
      });
}

/// Finds a cell's highest corner; a triangle's third one counts twice.
template <class Memory>
struct HighestCorner {
  CellReader corners;
  Array<const std::uint64_t, Memory> keys;

  KOKKOS_FUNCTION Id operator()(Id cell) const {
    const Quad of = corners(cell);
    Id best = of.a;
    for (int k = 1; k < 4; ++k) {
      if (keys(of[k]) > keys(best)) best = of[k];
    }
    return best;
  }
};

}  // namespace

PathSimplices::PathSimplices(const DiscreteGradient& gradient, Kind kind)
    : order_(gradient.order()),
      mesh_(gradient.mesh()),
      are_vertices_(kind == Kind::falling_vertices),
      successors_(are_vertices_ ? gradient.store().vertex_successors() : gradient.store().cell_successors()),
      critical_(are_vertices_ ? gradient.critical().vertices : gradient.critical().cells),
      input_(are_vertices_ ? mesh().vertices_in_input() : mesh().cells_in_input()),
      vertex_input_(mesh().vertices_in_input()) {
  if (are_vertices_ || mesh().grid() != nullptr) return;
  shared_ = in_worker_or_host_space(
      mesh(), [&](const auto& space) -> Array<Id, HostMemory> { return on_host(shared_cells(space, mesh())); });
  for (std::size_t i = 0; i < shared_.extent(0); ++i)
    shared_cells_.insert(static_cast<std::uint64_t>(input_[shared_(i)])).first = shared_(i);
}

PathSimplices::PathSimplices(const VertexOrder& order, const Mirrored<Id>& successors, const std::vector<Id>& ends)
    : order_(order),
      mesh_(order.mesh()),
      are_vertices_(true),
      successors_(successors),
      critical_(ends),
      input_(mesh_.vertices_in_input()),
      vertex_input_(input_) {}

std::unique_ptr<const PathSimplices> PathSimplices::make(const DiscreteGradient& gradient, Kind kind) {
  std::unique_ptr<const PathSimplices> made;
  together(gradient.mesh().exchange().ranks(), [&] { made = std::make_unique<const PathSimplices>(gradient, kind); });
  return made;
}

GlobalId PathSimplices::global(Id simplex) const {
  return are_vertices_ ? mesh().vertex_id(input_[simplex]) : mesh().cell_id(input_[simplex]);
}

Id PathSimplices::local(GlobalId id) const {
  if (are_vertices_) return mesh().vertices_of_input()[mesh().vertex_of(id)];
  const Id cell = mesh().exchange().cell_of(id);
  return mesh().grid() != nullptr ? cell : *shared_cells_.find(static_cast<std::uint64_t>(cell));
}

Interval PathSimplices::inner() const {
  const Interval owned = mesh().owned_vertices();
  if (are_vertices_) return owned;
  return mesh().grid() == nullptr ? Interval{0, 0} : mesh().grid()->cells_within(owned);
}

std::vector<Id> PathSimplices::highest_corners(const std::vector<Id>& cells) const {
  return in_worker_or_host_space(successors_.on_device(), [&](const auto& space) -> std::vector<Id> {
    using Memory = MemoryOf<std::decay_t<decltype(space)>>;
    return results_at("GALE::highest_corners", space, cells,
                      HighestCorner<Memory>{mesh().cell_reader<Memory>(), order_.keys_in<Memory>()});
  });
}

std::vector<int> PathSimplices::owners(const std::vector<Id>& simplices) const {
  std::vector<int> owners(simplices.size());
  if (simplices.empty()) return owners;
  const std::vector<Id> corners = are_vertices_ ? std::vector<Id>() : highest_corners(simplices);
  const std::vector<Id>& highest = are_vertices_ ? simplices : corners;
  parallel_for("GALE::owners", HostExecutionSpace(), static_cast<Offset>(simplices.size()),
               [&](Offset i) { owners[i] = mesh().exchange().owner(vertex_input_[highest[i]]); });
  return owners;
}

PathsOnRanks::PathsOnRanks(const PathSimplices& simplices, const Array<const std::int64_t, HostMemory>& names,
                           const std::vector<Id>& others, Offset most_told)
    : simplices_(simplices), criticals_(static_cast<Id>(simplices.critical().size())), names_(names) {
  begin(others);
  if (!follow_told(most_told)) return;
  while (jump()) {
  }
}

PathsOnRanks::PathsOnRanks(const PathSimplices& simplices, const std::vector<Id>& others)
    : simplices_(simplices), criticals_(static_cast<Id>(simplices.critical().size())) {
  together(ranks(), [&] { names_ = tabulated<std::int64_t>("GALE::no_names", criticals_, [](Offset) { return 0; }); });
  begin(others);
}

/// Follows paths in the part, and finds where they go on from its exits.
void PathsOnRanks::begin(const std::vector<Id>& others) {
  Array<Id, HostMemory> reached;
  together(ranks(), [&] {
    const PathsHere here = follow_here(simplices_, others);
    exits_ = here.exits;
    ends_ = here.ends;
    starts_ = here.starts;
    reached = here.reached;
    stops_ = allocate<Array<PathStop, HostMemory>>("GALE::path_stops", exits_.extent(0));
    fill("GALE::path_stops", HostExecutionSpace(), stops_, PathStop());
    links_ = allocate<Array<ExitLink, HostMemory>>("GALE::exit_links", exits_.extent(0));
  });
  ask_owners(reached);
}

std::vector<Id> PathsOnRanks::ends_of(const std::vector<Id>& simplices) const {
  return detail::ends_of(ends_, simplices_, simplices);
}

ExitLinks PathsOnRanks::exits_from(const std::vector<Id>& simplices) const {
  ExitLinks found{exits_, links_, {}};
  for (const Id end : ends_of(simplices)) {
    if (end >= criticals_) found.wanted.push_back(end - criticals_);
  }
  sort_distinct("GALE::sort_exits", found.wanted);
  return found;
}

/// Where a path that ends here so is.
PathStop PathsOnRanks::stop_here(Id end) const {
  if (end == no_id) return {};
  if (end < criticals_) return {PathStop::critical, names_(end)};
  return {ranks().rank(), end - criticals_};
}

/// The first round: some exits, by their places, learn where their paths come to on the ranks that own them. Nothing is
/// done if there are none on any rank.
void PathsOnRanks::ask_owners(const Array<Id, HostMemory>& reached) {
  const Offset count = reached.extent(0);
  if (ranks().sum(count) == 0) return;
  std::vector<Id> simplices;
  std::vector<int> owners;
  together(ranks(), [&] {
    simplices.resize(count);
    parallel_for("GALE::open_exits", HostExecutionSpace(), count, [&](Offset i) { simplices[i] = exits_(reached(i)); });
    owners = simplices_.owners(simplices);
  });
  const auto stops = ask_for_all<PathStop>(
      ranks(), "GALE::first_stops", count, [&](Id i) { return owners[i]; },
      [&](Id i) { return simplices_.global(simplices[i]); },
      [&](const auto& asked, const auto& answers) {
        std::vector<Id> starts(asked.count());
        parallel_for("GALE::asked_starts", HostExecutionSpace(), asked.count(),
                     [&](Offset i) { starts[i] = simplices_.local(asked.entries(i)); });
        const std::vector<Id> ends = ends_of(starts);
        parallel_for("GALE::answered_stops", HostExecutionSpace(), asked.count(),
                     [&](Offset i) { answers(i) = stop_here(ends[i]); });
      });
  together(ranks(), [&] {
    open_ = collected<Id>("GALE::open_exits", count, [&](Offset i, const auto& add) {
      const Id exit = reached(i);
      const bool goes_on = !stops(i).is_end();
      stops_(exit) = stops(i);
      links_(exit) = {owners[i], goes_on ? static_cast<Id>(stops(i).at) : no_id};
      if (goes_on) add(exit);
    });
  });
  ++rounds_;
}

/// The second round, where few paths haven't ended: all ranks are told where these come to, so that each goes on to an
/// exit from which the next rank knows the end. False, and nothing done, if all have ended on all ranks.
bool PathsOnRanks::follow_told(Offset most_told) {
  const std::vector<std::int64_t> counts = ranks().all(static_cast<std::int64_t>(open_.size()));
  std::vector<Offset> begin(ranks().size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), begin.begin() + 1);
  if (begin.back() == 0) return false;
  if (begin.back() * ranks().size() > most_told) return true;
  std::vector<ToldStop> own;
  together(ranks(), [&] {
    own.resize(open_.size());
    parallel_for("GALE::told_stops", HostExecutionSpace(), own.size(), [&](Offset i) {
      const PathStop& stop = stops_(open_[i]);
      own[i] = {open_[i], static_cast<std::int32_t>(stop.rank), stop.at};
    });
  });
  const std::vector<ToldStop> told = std::get<0>(lists_of_all(ranks(), "GALE::told_stops", own));
  together(ranks(), [&] {
    parallel_for("GALE::follow_told", HostExecutionSpace(), open_.size(), [&](Offset i) {
      PathStop& stop = stops_(open_[i]);
      for (;;) {
        const auto last = told.begin() + begin[stop.rank + 1];
        const auto next = std::lower_bound(told.begin() + begin[stop.rank], last, stop.at,
                                           [](const ToldStop& one, std::int64_t exit) { return one.exit < exit; });
        if (next == last || next->exit != stop.at) return;
        stop = {next->rank, next->at};
      }
    });
  });
  ++rounds_;
  return true;
}

/// A further round: each exit whose path hasn't ended learns from the rank that this has come to where it goes from
/// there. False, and nothing done, if all have ended on all ranks.
bool PathsOnRanks::jump() {
  if (ranks().sum(static_cast<std::int64_t>(open_.size())) == 0) return false;
  const Offset count = static_cast<Offset>(open_.size());
  const auto next = ask<PathStop>(
      ranks(), "GALE::next_stops", count, [&](Id i) { return stops_(open_[i]).rank; },
      [&](Id i) { return stops_(open_[i]).at; }, [&](std::int64_t exit) { return stops_(exit); });
  together(ranks(), [&] {
    open_ = collected<Id>("GALE::open_exits", count, [&](Offset i, const auto& add) {
      stops_(open_[i]) = next(i);
      if (!next(i).is_end()) add(open_[i]);
    });
  });
  ++rounds_;
  return true;
}

}  // namespace gale::detail
