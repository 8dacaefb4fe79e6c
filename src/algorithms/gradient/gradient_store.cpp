#include <algorithm>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

namespace {

/// What all consumers found.
template <class T>
std::vector<T> gathered(std::vector<ConsumerFound>& parts, HostList<T> FoundSimplices<HostList>::*member) {
  std::vector<std::vector<T>> lists;
  for (auto& part : parts) lists.push_back(std::move(part.*member));
  return concatenated(std::move(lists));
}

/// Sorts entries by their keys, which are unique.
template <class T, class Key>
void sort_by(const std::vector<Key>& keys, std::vector<T>& all) {
  auto keyed = unwritten<std::pair<Key, T>>(all.size());
  parallel_for("GALE::critical_keys", HostExecutionSpace(), all.size(), [&](Offset i) {
    keyed[i] = {keys[i], all[i]};
  });
  parallel_sort("GALE::sort_critical", keyed.begin(), keyed.end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
  parallel_for("GALE::critical", HostExecutionSpace(), all.size(), [&](Offset i) { all[i] = keyed[i].second; });
}

/// Simplices as users write them.
template <std::size_t N>
std::vector<std::array<Id, N>> written_simplices(const Mesh& mesh, const std::vector<std::array<Id, N>>& simplices) {
  std::vector<Id> vertices;
  reserve(vertices, N * simplices.size());
  for (const auto& simplex : simplices) vertices.insert(vertices.end(), simplex.begin(), simplex.end());
  const std::vector<Id> input = mesh.input_of_vertices(vertices);
  auto all = unwritten<std::array<Id, N>>(simplices.size());
  parallel_for("GALE::written_simplices", HostExecutionSpace(), all.size(), [&](Offset i) {
    std::copy_n(&input[N * i], N, all[i].begin());
    all[i] = ascending(all[i]);
  });
  return all;
}

/// Critical facets of cells, triangles or edges, as users write them, and cells.
template <std::size_t N>
std::vector<std::pair<std::array<Id, N>, Id>> written_stars(const Mesh& mesh, const std::vector<InStar>& stars) {
  auto facets = unwritten<std::array<Id, N>>(stars.size());
  std::vector<Id> cells(stars.size());
  parallel_for("GALE::facets_in_stars", HostExecutionSpace(), stars.size(), [&](Offset i) {
    std::copy_n(stars[i].simplex.begin(), N, facets[i].begin());
    cells[i] = stars[i].cell;
  });
  facets = written_simplices(mesh, facets);
  cells = mesh.input_of_cells(cells);
  auto all = unwritten<std::pair<std::array<Id, N>, Id>>(stars.size());
  parallel_for("GALE::written_stars", HostExecutionSpace(), stars.size(), [&](Offset i) {
    all[i] = {facets[i], cells[i]};
  });
  return all;
}

/// The row of each vertex that kernels found.
template <class Memory>
struct FoundRows {
  Array<const Id, Memory> words;
  Array<const Offset, Memory> begin;

  KOKKOS_FUNCTION EdgePairRow operator()(Id vertex) const {
    return EdgePairRow(const_cast<Id*>(words.data()) + begin(vertex));  // nobody writes to these
  }
};

/// The codes of a grid's rows. Ghosts have no lower neighbours.
template <class Space>
Mirrored<std::uint64_t> encoded_in(const Space& space, const GradientStore& store) {
  using Memory = MemoryOf<Space>;
  const Mesh& mesh = store.mesh;
  const Interval owned = mesh.owned_vertices();
  const EncodeRows<Memory, FoundRows<Memory>> encode{
      mesh.grid()->in<Memory>(),
      mesh.grid()->kinds_in<Memory>(),
      store.order.keys_in<Memory>().data(),
      store.vertex_successors().in<Memory>().data(),
      owned,
      {store.pair_words().in<Memory>(), store.pairs_begin().in<Memory>()},
      allocate<Array<std::uint64_t, Memory>>("GALE::pair_codes", mesh.vertices())};
  if (owned.size() < mesh.vertices()) fill("GALE::pair_codes", space, encode.codes, PairCode().bits());
  parallel_for("GALE::encode_rows", space, owned.size(), encode);
  space.fence();
  return encode.codes;
}

}  // namespace

GradientStore::GradientStore(const Mesh& mesh_, const VertexOrder& order_, int consumers)
    : mesh(mesh_),
      order(order_),
      consumed_vertices_(allocate<Array<Id, HostMemory>>("GALE::vertex_successor", mesh.vertices())),
      consumed_cells_(allocate<Array<Id, HostMemory>>("GALE::cell_successor", mesh.cells())),
      vertex_successors_(consumed_vertices_),
      cell_successors_(consumed_cells_),
      are_pairs_consumers_(true),
      pairs_(mesh.dimension() == 3 ? mesh.vertices() : 0, consumers),
      found_(consumers) {
  require_same_mesh("the vertex order", order.mesh(), mesh);
  mark_ghosts(HostExecutionSpace(), mesh, consumed_vertices_, consumed_cells_);
  pairs_are_here_([] {});
}

GradientStore::GradientStore(const VertexOrder& order_, const DeviceGradient& found)
    : mesh(order_.mesh()),
      order(order_),
      vertex_successors_(found.vertex_successor),
      cell_successors_(found.cell_successor),
      pair_words_(found.pair_words),
      pairs_begin_(found.pairs_begin),
      found_{found.critical} {
  finish();
}

GradientStore::GradientStore(const VertexOrder& order_, CriticalSimplices known)
    : mesh(order_.mesh()),
      order(order_),
      critical(std::move(known)),
      consumed_vertices_(allocate<Array<Id, HostMemory>>("GALE::vertex_successor", mesh.vertices())),
      consumed_cells_(allocate<Array<Id, HostMemory>>("GALE::cell_successor", mesh.cells())),
      vertex_successors_(consumed_vertices_),
      cell_successors_(consumed_cells_) {
  fill("GALE::no_successors", HostExecutionSpace(), consumed_vertices_, DiscreteGradient::elsewhere);
  fill("GALE::no_successors", HostExecutionSpace(), consumed_cells_, DiscreteGradient::elsewhere);
  for (const Id vertex : critical.vertices) consumed_vertices_(vertex) = no_id;
  for (const Id cell : critical.cells) consumed_cells_(cell) = no_id;
  count_critical();
}

std::shared_ptr<GradientStore> GradientStore::on_host(const VertexOrder& order, const DeviceGradient& found,
                                                      int consumers) {
  const auto store = std::make_shared<GradientStore>(order.mesh(), order, consumers);
  store->consumed_vertices_ = gale::on_host(found.vertex_successor);
  store->consumed_cells_ = gale::on_host(found.cell_successor);
  store->vertex_successors_ = store->consumed_vertices_;
  store->cell_successors_ = store->consumed_cells_;
  if (order.mesh().dimension() == 3)
    store->pairs_ = EdgePairs(gale::on_host(found.pair_words), gale::on_host(found.pairs_begin), consumers);
  store->found_[0] = found.critical;
  return store;
}

const Mirrored<std::uint64_t>& GradientStore::codes(bool for_kernels) const {
  return codes_.get([&] {
    if (for_kernels) return encoded_in(WorkerSpace(), *this);
    return in_worker_or_host_space(pair_words_.on_device(),
                                   [&](const auto& space) { return encoded_in(space, *this); });
  });
}

const EdgePairs& GradientStore::pairs() const {
  pairs_are_here_([this] {
    if (has_codes()) {
      pairs_ = EdgePairs(std::make_shared<GridCodes>(mesh.grid()->in<HostMemory>(), codes().in<HostMemory>()),
                         {0, mesh.vertices()});
    } else if (is_from_kernels()) {
      pairs_ = EdgePairs(pair_words_.in<HostMemory>(), pairs_begin_.in<HostMemory>(), 0);
    } else if (mesh.dimension() == 3) {
      pairs_ = EdgePairs(EdgePairs(), {}, mesh.vertices());
    }
  });
  return pairs_;
}

void GradientStore::bring_pairs_to_host() const {
  if (has_codes()) {
    codes().bring_to_host();
  } else if (is_from_kernels()) {
    pair_words_.bring_to_host();
    pairs_begin_.bring_to_host();
  }
}

VertexSteps GradientStore::vertex_steps() const {
  const GridCodes* const codes = mesh.dimension() == 3 ? pairs().codes() : nullptr;
  return codes != nullptr ? VertexSteps{nullptr, codes} : VertexSteps{vertex_successors().in<HostMemory>().data()};
}

void GradientStore::finish() {
  using Found = FoundSimplices<HostList>;
  critical.triangles = gathered(found_, &Found::triangles);
  sort_by(written_simplices(mesh, critical.triangles), critical.triangles);
  critical.edges = gathered(found_, &Found::edges);
  sort_by(written_simplices(mesh, critical.edges), critical.edges);
  critical.vertices = gathered(found_, &Found::vertices);
  sort_by(mesh.input_of_vertices(critical.vertices), critical.vertices);
  critical.cells = gathered(found_, &Found::cells);
  sort_by(mesh.input_of_cells(critical.cells), critical.cells);
  std::vector<InStar> stars = gathered(found_, &Found::stars);
  if (mesh.dimension() == 3) {
    sort_by(written_stars<3>(mesh, stars), stars);
  } else {
    sort_by(written_stars<2>(mesh, stars), stars);
  }
  for (const auto& some : found_)
    further_successors.insert(further_successors.end(), some.further_successors.begin(), some.further_successors.end());
  std::sort(further_successors.begin(), further_successors.end());
  found_.clear();
  critical.dimension = mesh.dimension();
  reserve(critical.star, stars.size());
  reserve(critical.star_begin, 1 + (mesh.dimension() == 3 ? critical.triangles.size() : critical.edges.size()));
  auto next = stars.begin();
  const auto add_star = [&](const std::array<Id, 3>& facet) {
    for (; next != stars.end() && next->simplex == facet; ++next) critical.star.push_back(next->cell);
    critical.star_begin.push_back(static_cast<Id>(critical.star.size()));
  };
  if (mesh.dimension() == 3) {
    for (const auto& triangle : critical.triangles) add_star(triangle);
  } else {
    for (const auto& [high, low] : critical.edges) add_star({high, low, no_id});
  }
  count_critical();
}

void GradientStore::count_critical() {
  const auto found = critical.counts();
  std::copy(found.begin(), found.end(), counts.begin());
}

void GradientStore::share_counts() { mesh.exchange().ranks().sum(counts.data(), static_cast<int>(counts.size())); }

std::size_t GradientStore::bytes() const {
  const std::size_t words =
      vertex_successors_.size() + cell_successors_.size() + pair_words_.size() + 2 * pairs_begin_.size();
  return words * sizeof(Id) + (are_pairs_consumers_ ? pairs_.bytes() : 0);
}

}  // namespace gale::detail
