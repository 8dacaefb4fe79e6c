#include <algorithm>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/gradient_sweep.hpp>

namespace gale {

namespace {

/// The one of `vertices` that isn't among `others`.
Id odd_one(const Id* vertices, const Id* others) {
  return *std::find_if(vertices, vertices + 4,
                       [others](Id vertex) { return std::find(others, others + 4, vertex) == others + 4; });
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
const Array<const Id, HostMemory>& DiscreteGradient::tetrahedron_successors() const {
  return store_->tetrahedron_successors().in<HostMemory>();
}
const Id* DiscreteGradient::fetch_vertex_successors() const {
  const Id* const data = vertex_successors().data();
  successors_->vertex.store(data, std::memory_order_release);
  return data;
}
const Id* DiscreteGradient::fetch_tetrahedron_successors() const {
  const Id* const data = tetrahedron_successors().data();
  successors_->tetrahedron.store(data, std::memory_order_release);
  return data;
}
std::size_t DiscreteGradient::bytes() const { return store_->bytes(); }

Id DiscreteGradient::triangle_of_edge(Id a, Id b) const {
  const std::uint64_t* const keys = store_->order.keys();
  return keys[a] < keys[b] ? triangle_of_lower_edge(b, a) : triangle_of_lower_edge(a, b);
}

Id DiscreteGradient::triangle_of_lower_edge(Id high, Id low) const {
  const detail::EdgePairRow row = store_->pairs()[high];
  return row.third(row.find(low));
}

void DiscreteGradient::for_each_edge_pair(Id high, const std::function<void(Id low, Id third)>& visit) const {
  const detail::EdgePairRow row = store_->pairs()[high];
  for (Id i = 0; i < row.size(); ++i) {
    const Id third = row.third(i);
    if (third != no_id) visit(row.ids()[i], third);
  }
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

Partner DiscreteGradient::pair_of_tetrahedron(Id tetrahedron) const {
  const Id successor = tetrahedron_successor(tetrahedron);
  if (successor == no_id) return {-1, no_id};
  const auto& vertices = store_->mesh.encoded().tetrahedra;
  if (leaves(successor)) return {2, vertices(tetrahedron, detail::corner_outside(successor))};
  return {2, odd_one(&vertices(tetrahedron, 0), &vertices(successor, 0))};
}

Partner DiscreteGradient::pair_of_triangle(Id tetrahedron, int corner, const Row& others) const {
  const auto& vertices = store_->mesh.encoded().tetrahedra;
  Id triangle[3];
  for (int i = 0, k = 0; i < 4; ++i) {
    if (i != corner) triangle[k++] = vertices(tetrahedron, i);
  }
  for (int i = 0; i < 3; ++i) {
    const Id a = triangle[(i + 1) % 3], b = triangle[(i + 2) % 3];
    if (triangle_of_edge(a, b) == triangle[i]) return {1, triangle[i]};
  }
  const Id opposite = vertices(tetrahedron, corner);
  if (pair_of_tetrahedron(tetrahedron).vertex == opposite) return {3, opposite};
  for (const Id other : others) {
    const Id apex = odd_one(&vertices(other, 0), &vertices(tetrahedron, 0));
    if (pair_of_tetrahedron(other).vertex == apex) return {3, apex};
  }
  return {-1, no_id};
}

DiscreteGradient find_discrete_gradient(const VertexOrder& order, const ComputeOptions& options, Computed* computed) {
  return detail::Computing(order.mesh(), options, computed)
      .find(
          discrete_gradient_relations,
          [&](const DeviceSweepOptions& sweep) { return find_discrete_gradient(WorkerSpace(), order, sweep); },
          [&](Structure& structure) { return find_discrete_gradient(structure, order, options); });
}

DiscreteGradient find_discrete_gradient(Structure& structure, const VertexOrder& order, const SweepOptions& options) {
  const ThreadLimit limit(options.threads);
  const int consumers = std::max(options.threads, 1);
  std::shared_ptr<detail::GradientStore> store;
  detail::together(order.mesh().exchange().ranks(), [&] {
    store = std::make_shared<detail::GradientStore>(structure.mesh(), order, consumers);
    std::vector<std::unique_ptr<detail::GradientSweep>> sweeps;
    for (int i = 0; i < consumers; ++i) sweeps.push_back(std::make_unique<detail::GradientSweep>(*store, i));
    structure.for_each_segment(discrete_gradient_relations, options,
                               [&](int consumer, const SegmentRows& rows) { sweeps[consumer]->pair(rows); });
    store->finish();
  });
  store->share_counts();
  return DiscreteGradient(store);
}

}  // namespace gale
