#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/numbered_set.hpp>
#include <gale/algorithms/excerpt/passed_cells.hpp>
#include <gale/algorithms/excerpt/passed_simplices.hpp>
#include <gale/algorithms/excerpt/triangle_names.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

namespace {

/// Has each of a list be what rename(it) says.
template <class T, class Rename>
void rename_all(std::vector<T>& list, const Rename& rename) {
  parallel_for("GALE::name_in_excerpt", HostExecutionSpace(), list.size(),
               [&](Offset i) { list[i] = rename(list[i]); });
}

/// The simplices of a wider gradient that are passed, and their numbers in the excerpt: both kinds by global id. Where
/// cells have as many corners (four each) as there are vertices, or more, all vertices are taken: to leave some out
/// would cost more than it saves. Keeps what the excerpt is made of, as long as it is wanted.
class PassedSimplices {
 public:
  /// Begins with what is on paths, and with critical simplices: cells have numbers then.
  PassedSimplices(const WiderGradient& wider, const Separatrices<Id>& descending, const Separatrices<Id>& ascending)
      : wider_(wider.simplices()), cells_(*wider_, wider.critical(), ascending), vertex_count_(wider_->vertices()) {
    if (4 * cells_.count() < wider_->vertices()) mark_vertices(wider.critical(), descending);
  }

  /// Adds what is on connectors, and returns these with numbers. Afterwards vertices have numbers.
  Separatrices<TriangleVertices> finish(FoundConnectors connectors) {
    if (vertices_) {
      mark_all_of(connectors);
      vertices_->number();
      vertex_count_ = vertices_->count();
    }
    return numbered(std::move(connectors));
  }

  Id number(Id vertex) const { return vertices_ ? (*vertices_)[wider_->names()[vertex]] : wider_->names()[vertex]; }
  Id cell_number(Id cell) const { return cells_.number(cell); }

  template <std::size_t N>
  std::array<Id, N> numbers(std::array<Id, N> simplex) const {
    for (Id& vertex : simplex) vertex = number(vertex);
    return simplex;
  }

  /// Makes the mesh.
  Mesh make_mesh() const { return wider_->mesh().dimension() == 3 ? make_mesh_of<4>() : make_mesh_of<3>(); }

  /// Whether GALE's ids of cells in the mesh that was made are their numbers.
  bool keeps_order_of_cells(const Mesh& mesh) const {
    const OtherIds input = mesh.cells_in_input();
    return reduce_sum("GALE::cells_of_excerpt", HostExecutionSpace(), mesh.cells(),
                      [&](Offset t) { return Offset(input[static_cast<Id>(t)] != t); }) == 0;
  }

  /// Has cells' numbers be GALE's ids in the mesh that was made.
  void renumber_cells(const Mesh& mesh) { cells_.renumber(mesh); }

  VertexOrder order_of(const Mesh& mesh) const {
    if (wider_->has_short_values()) {
      const std::vector<std::uint32_t> values = values_as<std::uint32_t>();
      return VertexOrder(mesh, values.data(), values.size());
    }
    const std::vector<std::uint64_t> values = values_as<std::uint64_t>();
    return excerpt_order(mesh, [&](Id v) { return values[v]; });
  }

 private:
  template <int corners>
  Mesh make_mesh_of() const {
    const auto vertex_ids = allocate<GlobalIds>("GALE::passed_vertices", vertex_count_);
    const Offset cells = cells_.count();
    const auto cell_ids = allocate<GlobalIds>("GALE::passed_cells", cells);
    const auto rows =
        allocate<typename CellCorners<corners, Id, HostMemory>::non_const_type>("GALE::passed_corners", cells);
    for_each_vertex([&](Id vertex, Id number) { vertex_ids(number) = wider_->vertex_id(vertex); });
    for_parts("GALE::passed_cells", cells, threads_for(cells), [&](int, Offset begin, Offset end) {
      auto corners_of = wider_->corners_in_turn();
      for (Offset i = begin; i < end; ++i) {
        stop_if_asked_at(i);
        cell_ids(i) = wider_->cell_id(cells_[i]);
        const std::array<Id, 4> of = corners_of(cells_[i]);
        for (int k = 0; k < corners; ++k) rows(i, k) = number(of[k]);
      }
    });
    return excerpt_mesh<corners>(vertex_ids, cell_ids, rows, std::max(vertex_count_, 1));
  }

  bool mark(Id vertex) { return vertices_->insert(wider_->names()[vertex]); }

  /// Marks the vertices of simplices.
  template <class Simplex>
  void mark_all_of(const std::vector<Simplex>& simplices) {
    parallel_for("GALE::mark_passed", HostExecutionSpace(), simplices.size(), [&](Offset i) {
      for (const Id vertex : simplices[i]) mark(vertex);
    });
  }

  /// Marks those of connectors: the device those that it has, if there is room.
  void mark_all_of(FoundConnectors& connectors) {
    try {
      const auto& there = connectors.triangles;
      if (!there.empty()) vertices_->insert_bits(names_passed(there, connectors.names, wider_->vertices()));
    } catch (const OutOfMemory&) {
      connectors.bring();
    }
    mark_all_of(connectors.paths.cells);
  }

  /// Numbers those of connectors likewise.
  Separatrices<TriangleVertices> numbered(FoundConnectors connectors) const {
    try {
      rename_vertices(connectors.triangles, connectors.names, vertices_ ? &*vertices_ : nullptr);
    } catch (const OutOfMemory&) {
      connectors.bring();
    }
    rename_all(connectors.paths.cells, [&](const TriangleVertices& triangle) { return numbers(triangle); });
    connectors.bring();
    return std::move(connectors.paths);
  }

  /// Marks the vertices of what is passed alone.
  void mark_vertices(const CriticalSimplices& critical, const Separatrices<Id>& descending) {
    vertices_.emplace(wider_->vertices());
    mark_paths(
        descending, [&](Id vertex) { return mark(vertex); },
        [&](Id vertex) { vertices_->prefetch(wider_->names()[vertex]); });
    for (const Id vertex : critical.vertices) mark(vertex);
    mark_all_of(critical.edges);
    mark_all_of(critical.triangles);
    const Offset cells = cells_.count();
    for_parts("GALE::mark_passed", cells, threads_for(cells), [&](int, Offset begin, Offset end) {
      auto corners_of = wider_->corners_in_turn();
      for (Offset i = begin; i < end; ++i) {
        stop_if_asked_at(i);
        for (const Id vertex : corners_of(cells_[i])) mark(vertex);
      }
    });
  }

  /// Calls visit(vertex, number) for each that is in the excerpt.
  template <class Visit>
  void for_each_vertex(const Visit& visit) const {
    parallel_for("GALE::passed_vertices", HostExecutionSpace(), wider_->vertices(), [&](Offset v) {
      const Id vertex = static_cast<Id>(v);
      if (!vertices_ || vertices_->has(wider_->names()[vertex])) visit(vertex, number(vertex));
    });
  }

  template <class Value>
  std::vector<Value> values_as() const {
    std::vector<Value> values(vertex_count_);
    for_each_vertex([&](Id vertex, Id number) { values[number] = static_cast<Value>(wider_->value(vertex)); });
    return values;
  }

  const std::shared_ptr<const WiderSimplices> wider_;
  PassedCells cells_;
  std::optional<NumberedSet> vertices_;  ///< by name; none where all are taken
  Id vertex_count_;
};

}  // namespace

void name_in_excerpt(const WiderGradient& wider, const std::function<FoundConnectors()>& find_connectors,
                     MorseSmaleComplex& complex) {
  std::shared_ptr<PassedSimplices> passed;
  FoundConnectors connectors;
  const auto mark = [&] { passed = std::make_shared<PassedSimplices>(wider, complex.descending, complex.ascending); };
  const auto connect = [&] {
    if (find_connectors) connectors = find_connectors();
  };
  if (have_device && find_connectors && complex.gradient.store().is_from_kernels()) {
    meanwhile(mark, connect);
  } else {
    mark();
    connect();
  }
  complex.connectors = passed->finish(std::move(connectors));
  const bool is_grid = complex.gradient.mesh().grid() != nullptr;
  std::optional<Mesh> mesh;
  if (!is_grid) mesh = passed->make_mesh();
  if (!is_grid) passed->renumber_cells(*mesh);
  const auto vertex = [&](Id one) { return passed->number(one); };
  const auto cell = [&](Id one) { return passed->cell_number(one); };
  const auto simplex = [&](const auto& one) { return passed->numbers(one); };
  complex.critical = wider.critical();
  rename_all(complex.critical.vertices, vertex);
  rename_all(complex.critical.edges, simplex);
  rename_all(complex.critical.triangles, simplex);
  rename_all(complex.critical.cells, cell);
  rename_all(complex.critical.star, cell);
  rename_all(complex.descending.cells, vertex);
  rename_all(complex.ascending.cells, cell);
  const auto excerpt_of = [](const VertexOrder& order, const CriticalSimplices& critical) {
    return DiscreteGradient(std::make_shared<GradientStore>(order, critical));
  };
  if (!is_grid) {
    complex.excerpt = excerpt_of(passed->order_of(*mesh), complex.critical);
    return;
  }
  // The cells of a grid keep their order, so that their numbers are known before there is a mesh.
  complex.excerpt = Excerpt([passed, excerpt_of, critical = complex.critical] {
    const Mesh made = passed->make_mesh();
    if (!passed->keeps_order_of_cells(made)) throw Error("the cells of an excerpt of a grid don't keep their order");
    return excerpt_of(passed->order_of(made), critical);
  });
}

}  // namespace gale::detail
