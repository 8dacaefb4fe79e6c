#include <algorithm>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/gradient_sweep.hpp>
#include <gale/algorithms/gradient/grid_pairs.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/base/error.hpp>

namespace gale {

namespace {

/// The one of `vertices` that isn't among `others`.
Id odd_one(const Quad& vertices, const Quad& others) {
  int corner = 0;
  const auto is_other = [&](Id vertex) {
    return vertex == others.a || vertex == others.b || vertex == others.c || vertex == others.d;
  };
  while (is_other(vertices[corner])) ++corner;
  return vertices[corner];
}

/// Calls visit(triangle) for the triangles that touch a vertex, until that returns true: of a grid they are known, else
/// they are those of the vertex's segment that do.
template <class Visit>
void find_triangle_at(const Mesh& mesh, Id vertex, const Visit& visit) {
  if (const Grid* const grid = mesh.grid()) {
    detail::GridCursor at(grid->in<HostMemory>());
    at.go_to(vertex);
    const detail::StarKind& kind = grid->kinds_in<HostMemory>()[at.kind()];
    for (int i = 0; i < kind.cells; ++i) {
      if (visit(at.cell(kind.cell[i]))) return;
    }
    return;
  }
  const auto& encoded = mesh.encoded();
  const Id segment = mesh.segment_of(0, vertex);
  const auto found = [&](Id t) {
    const Quad cell = encoded.cell(t);
    return (cell.a == vertex || cell.b == vertex || cell.c == vertex) && visit(t);
  };
  for (Id t = encoded.internal_begin(segment); t < encoded.internal_begin(segment + 1); ++t) {
    if (found(t)) return;
  }
  for (Offset i = encoded.external_begin(segment); i < encoded.external_begin(segment + 1); ++i) {
    if (found(encoded.external(i))) return;
  }
}

/// An edge of a triangle that is paired with it: its vertices, the higher one first, and the triangle's third one.
struct EdgeOfTriangle {
  Id high, low, third;
};

/// Calls visit(EdgeOfTriangle) for the edges at a vertex that are paired with triangles, until that returns true. On
/// triangle meshes.
template <class Visit>
void find_paired_edge(const DiscreteGradient& gradient, Id vertex, const Visit& visit) {
  const std::uint64_t* const keys = gradient.order().keys();
  find_triangle_at(gradient.mesh(), vertex, [&](Id t) {
    const Id successor = gradient.cell_successor(t);
    if (successor == no_id || successor == DiscreteGradient::elsewhere) return false;
    const Id third = gradient.pair_of_cell(t).vertex;
    const Quad cell = gradient.mesh().cell_reader()(t);
    const Id one = cell.a == third ? cell.b : cell.a, other = cell.c == third ? cell.b : cell.c;
    const bool is_higher = keys[one] > keys[other];
    return visit(EdgeOfTriangle{is_higher ? one : other, is_higher ? other : one, third});
  });
}

}  // namespace

DiscreteGradient::DiscreteGradient(std::shared_ptr<const detail::GradientStore> store)
    : store_(std::move(store)), successors_(&store_->host_successors) {}

const Mesh& DiscreteGradient::mesh() const { return store_->mesh; }
const VertexOrder& DiscreteGradient::order() const { return store_->order; }
const CriticalSimplices& DiscreteGradient::critical() const { return store_->critical; }
const std::array<GlobalId, 4>& DiscreteGradient::counts() const { return store_->counts; }
const Array<const Id, HostMemory>& DiscreteGradient::vertex_successors() const {
  return store_->vertex_successors().in<HostMemory>();
}
const Array<const Id, HostMemory>& DiscreteGradient::cell_successors() const {
  return store_->cell_successors().in<HostMemory>();
}
const Id* DiscreteGradient::fetch_vertex_successors() const {
  const Id* const data = vertex_successors().data();
  successors_->vertex.store(data, std::memory_order_release);
  return data;
}
const Id* DiscreteGradient::fetch_cell_successors() const {
  const Id* const data = cell_successors().data();
  successors_->cell.store(data, std::memory_order_release);
  return data;
}
std::size_t DiscreteGradient::bytes() const { return store_->bytes(); }

Id DiscreteGradient::triangle_of_edge(Id a, Id b) const {
  const std::uint64_t* const keys = store_->order.keys();
  return keys[a] < keys[b] ? triangle_of_lower_edge(b, a) : triangle_of_lower_edge(a, b);
}

Id DiscreteGradient::triangle_of_lower_edge(Id high, Id low) const {
  if (mesh().dimension() == 2) {
    Id third = no_id;
    find_paired_edge(*this, high, [&](const EdgeOfTriangle& edge) {
      if (edge.high != high || edge.low != low) return false;
      third = edge.third;
      return true;
    });
    return third;
  }
  const detail::PairedEdges row = store_->pairs()[high];
  const Id place = row.find(low);
  return place == no_id ? no_id : row.third(place);  // excerpts have rows without edges
}

void DiscreteGradient::for_each_edge_pair(Id high, const std::function<void(Id low, Id third)>& visit) const {
  if (mesh().dimension() == 2) {
    return find_paired_edge(*this, high, [&](const EdgeOfTriangle& edge) {
      if (edge.high == high) visit(edge.low, edge.third);
      return false;
    });
  }
  store_->pairs()[high].for_each_pair(visit);
}

Partner DiscreteGradient::pair_of_vertex(Id vertex) const {
  const Id other = vertex_successor(vertex);
  return {other == no_id ? -1 : 1, other};
}

Partner DiscreteGradient::pair_of_edge(Id a, Id b) const {
  const std::uint64_t* const keys = store_->order.keys();
  if (keys[a] < keys[b]) std::swap(a, b);
  if (vertex_successor(a) == b) return {0, b};
  const Id third = triangle_of_lower_edge(a, b);
  return {third == no_id ? -1 : 2, third};
}

Partner DiscreteGradient::pair_of_cell(Id cell) const {
  const Id successor = cell_successor(cell);
  if (successor == no_id) return {-1, no_id};
  const CellReader cells = store_->mesh.cell_reader();
  const int facet = store_->mesh.dimension() - 1;
  if (leaves(successor)) return {facet, cells(cell)[detail::corner_outside(successor)]};
  return {facet, odd_one(cells(cell), cells(successor))};
}

Partner DiscreteGradient::pair_of_triangle(Id tetrahedron, int corner, const Row& others) const {
  if (mesh().dimension() == 2) throw Error("pair_of_triangle is for meshes of tetrahedra: triangles are cells here");
  const CellReader cells = store_->mesh.cell_reader();
  const Quad vertices = cells(tetrahedron);
  Id triangle[3];
  for (int i = 0, k = 0; i < 4; ++i) {
    if (i != corner) triangle[k++] = vertices[i];
  }
  for (int i = 0; i < 3; ++i) {
    const Id a = triangle[(i + 1) % 3], b = triangle[(i + 2) % 3];
    if (triangle_of_edge(a, b) == triangle[i]) return {1, triangle[i]};
  }
  const Id opposite = vertices[corner];
  if (pair_of_cell(tetrahedron).vertex == opposite) return {3, opposite};
  for (const Id other : others) {
    const Id apex = odd_one(cells(other), vertices);
    if (pair_of_cell(other).vertex == apex) return {3, apex};
  }
  return {-1, no_id};
}

namespace {

/// What threads of the host find: pair(store, consumers) has as many of these fill a store. Collective.
template <class Pair>
DiscreteGradient found_by(const VertexOrder& order, const SweepOptions& options, const Pair& pair) {
  const ThreadLimit limit(options.threads);
  std::shared_ptr<detail::GradientStore> store;
  detail::together(order.mesh().exchange().ranks(), [&] {
    detail::require_thread_count(options.threads);
    store = std::make_shared<detail::GradientStore>(order.mesh(), order, options.threads);
    pair(*store, options.threads);
    store->finish();
  });
  store->share_counts();
  return DiscreteGradient(store);
}

}  // namespace

DiscreteGradient find_discrete_gradient(const VertexOrder& order, const ComputeOptions& options, Computed* computed) {
  detail::Computing computing(order.mesh(), options, computed);
  const auto by_kernels = [&](const DeviceSweepOptions& sweep) {
    return find_discrete_gradient(WorkerSpace(), order, sweep);
  };
  if (computing.is_of_grid()) {
    return computing.find_alone(by_kernels, [&] {
      return found_by(order, options, [&](detail::GradientStore& store, int consumers) {
        detail::pair_all_on_grid(store, consumers, options);
      });
    });
  }
  return computing.find(discrete_gradient_relations_of(order.mesh().dimension()), by_kernels,
                        [&](Structure& structure) { return find_discrete_gradient(structure, order, options); });
}

DiscreteGradient find_discrete_gradient(Structure& structure, const VertexOrder& order, const SweepOptions& options) {
  detail::require_same_mesh("the vertex order", order.mesh(), structure.mesh());
  return found_by(order, options, [&](detail::GradientStore& store, int consumers) {
    std::vector<std::unique_ptr<detail::GradientSweep>> sweeps;
    for (int i = 0; i < consumers; ++i) sweeps.push_back(std::make_unique<detail::GradientSweep>(store, i));
    structure.for_each_segment(discrete_gradient_relations_of(structure.mesh().dimension()), options,
                               [&](int consumer, const SegmentRows& rows) { sweeps[consumer]->pair(rows); });
  });
}

}  // namespace gale
