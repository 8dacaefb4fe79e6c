#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/numbered_set.hpp>
#include <gale/algorithms/excerpt/passed_simplices.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>

namespace gale::detail {

namespace {

/// The simplices of a wider gradient that are passed, and their numbers in the excerpt: both kinds by global id.
class PassedSimplices {
 public:
  PassedSimplices(const WiderGradient& wider, const MorseSmaleComplex& complex)
      : wider_(wider), is_passed_(wider.vertices()), cells_(wider.cells()) {
    mark(complex);
    number_cells();
    number_vertices();
  }

  Id number(Id vertex) const { return number_[vertex]; }
  Id cell_number(Id cell) const { return number_of_cell_[cells_[wider_.cell_name(cell)]]; }

  template <std::size_t N>
  std::array<Id, N> numbers(std::array<Id, N> simplex) const {
    for (Id& vertex : simplex) vertex = number(vertex);
    return simplex;
  }

  template <int corners>
  Mesh make_mesh() const {
    const auto vertex_ids = allocate<GlobalIds>("GALE::passed_vertices", vertex_count_);
    const auto cell_ids = allocate<GlobalIds>("GALE::passed_cells", cell_of_.size());
    const auto rows = allocate<typename CellCorners<corners, Id, HostMemory>::non_const_type>("GALE::passed_corners",
                                                                                              cell_of_.size());
    for_each_vertex([&](Id vertex, Id number) { vertex_ids(number) = wider_.vertex_id(vertex); });
    parallel_for("GALE::passed_cells", HostExecutionSpace(), cell_of_.size(), [&](Offset i) {
      cell_ids(i) = wider_.cell_id(cell_of_[i]);
      for (int k = 0; k < corners; ++k) rows(i, k) = number(corners_[i][k]);
    });
    return excerpt_mesh<corners>(vertex_ids, cell_ids, rows);
  }

  VertexOrder order_of(const Mesh& mesh) const {
    std::vector<std::uint64_t> values(vertex_count_);
    for_each_vertex([&](Id vertex, Id number) { values[number] = wider_.value(vertex); });
    return excerpt_order(mesh, [&](Id v) { return values[v]; });
  }

 private:
  bool mark_vertex(Id vertex) { return is_passed_.insert(vertex); }
  bool mark_cell(Id cell) {
    if (!cells_.insert(wider_.cell_name(cell))) return false;
    marked_cells_.push_back(cell);
    return true;
  }

  /// Marks what is on paths, before anything else is: where one comes to what is marked, so is the rest of it.
  template <class Mark>
  static void mark_paths(const Separatrices<Id>& paths, const Mark& mark) {
    for (Id i = 0; i < paths.count(); ++i) {
      for (const Id* at = paths.first(i); at != paths.last(i) && mark(*at); ++at) {
      }
    }
  }

  template <class Simplices>
  void mark_vertices_of(const Simplices& simplices) {
    for (const auto& simplex : simplices) {
      for (const Id vertex : simplex) mark_vertex(vertex);
    }
  }

  void mark(const MorseSmaleComplex& complex) {
    const CriticalSimplices& critical = wider_.critical();
    mark_paths(complex.descending, [&](Id vertex) { return mark_vertex(vertex); });
    mark_paths(complex.ascending, [&](Id cell) { return mark_cell(cell); });
    mark_vertices_of(complex.connectors.cells);
    for (const Id vertex : critical.vertices) mark_vertex(vertex);
    mark_vertices_of(critical.edges);
    mark_vertices_of(critical.triangles);
    for (const Id cell : critical.cells) mark_cell(cell);
    for (const Id cell : critical.star) mark_cell(cell);
  }

  /// Numbers cells, and marks their vertices. Names of the rank's own cells ascend with global ids; others' come after
  /// all of these, and have to be put between them.
  void number_cells() {
    cells_.number();
    const Id count = cells_.count();
    std::vector<Id> by_name(count);
    parallel_for("GALE::cells_by_name", HostExecutionSpace(), count,
                 [&](Offset i) { by_name[cells_[wider_.cell_name(marked_cells_[i])]] = marked_cells_[i]; });
    const auto is_less = [&](Id a, Id b) { return wider_.cell_id(a) < wider_.cell_id(b); };
    const auto others =
        std::find_if(by_name.begin(), by_name.end(), [&](Id cell) { return !wider_.is_own_cell(cell); });
    std::sort(others, by_name.end(), is_less);
    cell_of_.resize(count);
    std::merge(by_name.begin(), others, others, by_name.end(), cell_of_.begin(), is_less);
    number_of_cell_.resize(count);
    corners_.resize(count);
    parallel_for("GALE::corners_of_passed", HostExecutionSpace(), count, [&](Offset i) {
      number_of_cell_[cells_[wider_.cell_name(cell_of_[i])]] = static_cast<Id>(i);
      corners_[i] = wider_.corners(cell_of_[i]);
    });
    mark_vertices_of(corners_);
  }

  void number_vertices() {
    NumberedSet names(wider_.vertices());
    for (Id v = 0; v < wider_.vertices(); ++v) {
      if (is_passed_.has(v)) names.insert(wider_.name(v));
    }
    names.number();
    vertex_count_ = names.count();
    number_.resize(wider_.vertices());
    parallel_for("GALE::number_passed", HostExecutionSpace(), number_.size(), [&](Offset v) {
      number_[v] = is_passed_.has(static_cast<Id>(v)) ? names[wider_.name(static_cast<Id>(v))] : no_id;
    });
  }

  /// Calls visit(vertex, number) for each that is passed.
  template <class Visit>
  void for_each_vertex(const Visit& visit) const {
    parallel_for("GALE::passed_vertices", HostExecutionSpace(), number_.size(), [&](Offset v) {
      if (number_[v] != no_id) visit(static_cast<Id>(v), number_[v]);
    });
  }

  const WiderGradient& wider_;
  NumberedSet is_passed_;  ///< by vertex
  NumberedSet cells_;      ///< by name
  Id vertex_count_ = 0;
  std::vector<Id> number_;  ///< of each vertex; no_id of those that aren't passed
  std::vector<Id> marked_cells_, cell_of_, number_of_cell_;
  std::vector<std::array<Id, 4>> corners_;  ///< by number
};

/// Has each of a list be what rename(it) says.
template <class T, class Rename>
void rename_all(std::vector<T>& list, const Rename& rename) {
  parallel_for("GALE::name_in_excerpt", HostExecutionSpace(), list.size(),
               [&](Offset i) { list[i] = rename(list[i]); });
}

}  // namespace

void name_in_excerpt(const WiderGradient& wider, MorseSmaleComplex& complex) {
  const PassedSimplices passed(wider, complex);
  const Mesh mesh = complex.critical.dimension == 3 ? passed.make_mesh<4>() : passed.make_mesh<3>();
  std::vector<Id> internal(mesh.cells());
  const OtherIds input = mesh.cells_in_input();
  parallel_for("GALE::cells_of_excerpt", HostExecutionSpace(), mesh.cells(),
               [&](Offset t) { internal[input[static_cast<Id>(t)]] = static_cast<Id>(t); });
  const auto vertex = [&](Id one) { return passed.number(one); };
  const auto cell = [&](Id one) { return internal[passed.cell_number(one)]; };
  const auto simplex = [&](const auto& one) { return passed.numbers(one); };
  CriticalSimplices critical = wider.critical();
  rename_all(critical.vertices, vertex);
  rename_all(critical.edges, simplex);
  rename_all(critical.triangles, simplex);
  rename_all(critical.cells, cell);
  rename_all(critical.star, cell);
  const auto store = std::make_shared<GradientStore>(mesh, passed.order_of(mesh), 1);
  store->finish_with(std::move(critical));
  complex.excerpt = DiscreteGradient(store);
  complex.critical = complex.excerpt.critical();
  rename_all(complex.descending.cells, vertex);
  rename_all(complex.connectors.cells, simplex);
  rename_all(complex.ascending.cells, cell);
}

}  // namespace gale::detail
