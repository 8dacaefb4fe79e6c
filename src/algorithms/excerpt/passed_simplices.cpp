#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/numbered_set.hpp>
#include <gale/algorithms/excerpt/passed_simplices.hpp>
#include <gale/algorithms/excerpt/triangle_names.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/base/error.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/sort.hpp>
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
      : wider_(wider.simplices()), cells_(wider_->cells()), vertex_count_(wider_->vertices()) {
    mark_cells(wider.critical(), ascending);
    number_cells();
    if (4 * static_cast<Offset>(cell_of_.size()) < wider_->vertices()) mark_vertices(wider.critical(), descending);
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
  Id cell_number(Id cell) const { return number_of_cell_[cells_[wider_->cell_name(cell)]]; }

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
  void renumber_cells(const Mesh& mesh) {
    std::vector<Id> internal(mesh.cells());
    const OtherIds input = mesh.cells_in_input();
    parallel_for("GALE::cells_of_excerpt", HostExecutionSpace(), mesh.cells(),
                 [&](Offset t) { internal[input[static_cast<Id>(t)]] = static_cast<Id>(t); });
    parallel_for("GALE::cells_of_excerpt", HostExecutionSpace(), number_of_cell_.size(),
                 [&](Offset i) { number_of_cell_[i] = internal[number_of_cell_[i]]; });
  }

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
    const auto cell_ids = allocate<GlobalIds>("GALE::passed_cells", cell_of_.size());
    const auto rows = allocate<typename CellCorners<corners, Id, HostMemory>::non_const_type>("GALE::passed_corners",
                                                                                              cell_of_.size());
    for_each_vertex([&](Id vertex, Id number) { vertex_ids(number) = wider_->vertex_id(vertex); });
    const Offset cells = static_cast<Offset>(cell_of_.size());
    for_parts("GALE::passed_cells", cells, threads_for(cells), [&](int, Offset begin, Offset end) {
      auto corners_of = wider_->corners_in_turn();
      for (Offset i = begin; i < end; ++i) {
        stop_if_asked_at(i);
        cell_ids(i) = wider_->cell_id(cell_of_[i]);
        const std::array<Id, 4> of = corners_of(cell_of_[i]);
        for (int k = 0; k < corners; ++k) rows(i, k) = number(of[k]);
      }
    });
    return excerpt_mesh<corners>(vertex_ids, cell_ids, rows, std::max(vertex_count_, 1));
  }

  /// Marks what is on paths, before anything else is: where one comes to what is marked, its rest is being marked by
  /// whoever has marked that. mark(simplex) says whether it wasn't; bring_near(simplex) is told what comes soon.
  template <class Mark, class BringNear>
  static void mark_paths(const Separatrices<Id>& paths, const Mark& mark, const BringNear& bring_near) {
    constexpr std::ptrdiff_t ahead = 8;
    parallel_for("GALE::mark_paths", HostExecutionSpace(), paths.count(), [&](Offset i) {
      const Id* const last = paths.last(static_cast<Id>(i));
      for (const Id* at = paths.first(static_cast<Id>(i)); at != last && mark(*at); ++at) {
        if (last - at > ahead) bring_near(at[ahead]);
      }
    });
  }

  void mark_cells(const CriticalSimplices& critical, const Separatrices<Id>& ascending) {
    const auto mark = [&](Id cell) { return cells_.insert(wider_->cell_name(cell)); };
    mark_paths(ascending, mark, [&](Id cell) { cells_.prefetch(wider_->cell_name(cell)); });
    for (const Id cell : critical.cells) mark(cell);
    for (const Id cell : critical.star) mark(cell);
  }

  /// The cells by their numbers among `cells_`.
  std::vector<Id> cells_by_name() const {
    auto by_name = zeros<Id>(cells_.count());
    if (wider_->mesh().cells_in_input().table == nullptr) {  // names are the cells themselves
      cells_.for_each("GALE::cells_by_name", [&](Id cell, Id number) { by_name[number] = cell; });
    } else {
      parallel_for("GALE::cells_by_name", HostExecutionSpace(), wider_->cells(), [&](Offset t) {
        const Id cell = static_cast<Id>(t), name = wider_->cell_name(cell);
        if (cells_.has(name)) by_name[cells_[name]] = cell;
      });
    }
    return by_name;
  }

  /// Names of the rank's own cells ascend with global ids; others' come after all of these, and have to be put between
  /// them.
  void number_cells() {
    struct Other {
      GlobalId id;
      Id place, own_before;  ///< by name; how many own cells have a lower id
    };
    cells_.number();
    const std::vector<Id> by_name = cells_by_name();
    const auto is_own = [&](Id cell) { return wider_->is_own_cell(cell); };
    const Id own = static_cast<Id>(std::partition_point(by_name.begin(), by_name.end(), is_own) - by_name.begin());
    std::vector<Other> others(by_name.size() - own);
    parallel_for("GALE::other_cells", HostExecutionSpace(), others.size(), [&](Offset i) {
      const Id place = own + static_cast<Id>(i);
      const GlobalId id = wider_->cell_id(by_name[place]);
      others[i] = {id, place, bisect(Id(0), own, [&](Id at) { return wider_->cell_id(by_name[at]) < id; })};
    });
    parallel_sort("GALE::sort_other_cells", others.begin(), others.end(),
                  [](const Other& a, const Other& b) { return a.id < b.id; });
    cell_of_ = zeros<Id>(by_name.size());
    number_of_cell_ = zeros<Id>(by_name.size());
    const auto set_number = [&](Offset place, Offset number) {
      cell_of_[number] = by_name[place];
      number_of_cell_[place] = static_cast<Id>(number);
    };
    for_parts("GALE::number_cells", own, threads_for(own), [&](int, Offset begin, Offset end) {
      auto next = std::partition_point(others.begin(), others.end(),
                                       [&](const Other& other) { return other.own_before <= begin; });
      for (Offset i = begin; i < end; ++i) {
        while (next != others.end() && next->own_before <= i) ++next;
        set_number(i, i + (next - others.begin()));
      }
    });
    parallel_for("GALE::number_cells", HostExecutionSpace(), others.size(),
                 [&](Offset i) { set_number(others[i].place, others[i].own_before + i); });
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
    const Offset cells = static_cast<Offset>(cell_of_.size());
    for_parts("GALE::mark_passed", cells, threads_for(cells), [&](int, Offset begin, Offset end) {
      auto corners_of = wider_->corners_in_turn();
      for (Offset i = begin; i < end; ++i) {
        stop_if_asked_at(i);
        for (const Id vertex : corners_of(cell_of_[i])) mark(vertex);
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
  NumberedSet cells_;                    ///< by name
  std::optional<NumberedSet> vertices_;  ///< by name; none where all are taken
  Id vertex_count_;
  std::vector<Id> cell_of_;         ///< by number
  std::vector<Id> number_of_cell_;  ///< by name
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
