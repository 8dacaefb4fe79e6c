#include <sstream>

#include <gale/app/ranks/ranks.hpp>
#include <gale/app/ranks/shared_input.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/io/write.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/mesh/exchange/home_table.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

Array<GlobalId, HostMemory> counted(GlobalId first, Offset count) {
  return detail::tabulated<GlobalId>("GALE::input_ids", count, [&](Offset i) { return first + i; });
}

/// The layers of a grid with their cells written out, which each rank makes by itself. Collective.
DistributedMesh with_written_cells(const Communicator& ranks, const DistributedMesh& grid, const HostPoints& positions,
                                   const PartitionOptions& options) {
  MeshPart<GlobalId> part;
  detail::together(ranks, [&] {
    const Interval owned = grid.owned_vertices();
    const GridView view = grid.grid()->in<HostMemory>();
    const Id cubes = grid.grid()->cubes(), of_cube = view.cells_per_cube();
    // Cubes follow their lowest vertices.
    const auto cubes_before = [&](Id vertex) {
      Id begin = 0, end = cubes;
      while (begin < end) {
        const Id middle = begin + (end - begin) / 2;
        view.corners_of_cube(middle).a < vertex ? begin = middle + 1 : end = middle;
      }
      return begin;
    };
    const Id first_cube = cubes_before(owned.first), last_cube = cubes_before(owned.last);
    const Id first = of_cube * first_cube, count = of_cube * (last_cube - first_cube);
    if (owned.size() > 0) part.vertex_ids = counted(grid.vertex_id(owned.first), owned.size());
    part.points = positions;
    const GlobalId before = owned.size() > 0 ? grid.vertex_id(owned.first) - owned.first : 0;
    const int corners = grid.dimension() + 1;
    const CellRows<GlobalId>::non_const_type cells("GALE::written_cells", count, corners);
    parallel_for("GALE::written_cells", HostExecutionSpace(), last_cube - first_cube, [&](Offset i) {
      const Quad of = view.corners_of_cube(first_cube + static_cast<Id>(i));
      for (Id t = 0; t < of_cube; ++t) {
        const Quad cell = view.cell_of_cube(of, t);
        for (int k = 0; k < corners; ++k)
          cells(of_cube * i + t, k) = owned.has(cell[k]) ? before + cell[k] : grid.vertex_id(cell[k]);
      }
    });
    part.cells = cells;
    if (count > 0) part.cell_ids = counted(grid.cell_id(first), count);
  });
  return DistributedMesh(ranks, part, options);
}

/// Reads all; a grid's layers aren't dealt out yet.
void take_file(const InputOptions& input, SharedInput& shared, std::optional<Grid>& grid,
               io::Dataset::Positions& grid_points) {
  io::Dataset dataset = io::read(input.input, input.read);
  if (input.height) outputs::add_height(dataset, *input.height);
  const std::size_t vertices = dataset.vertices();
  const auto ids = counted(0, dataset.grid ? 0 : static_cast<Offset>(vertices));
  std::visit(
      [&](const auto& points) {
        if (dataset.grid) return;
        shared.part = dataset.dimension() == 3 ? part_of(ids, points, dataset.tetrahedra)
                                               : part_of(ids, points, dataset.triangles);
      },
      dataset.points);
  grid = dataset.grid;
  if (grid) grid_points = dataset.points;
  if (!dataset.cell_arrays.empty()) {
    const auto& cells = std::get<std::vector<Id>>(dataset.cell_arrays[0].values);
    shared.cells = detail::tabulated<GlobalId>("GALE::cells_of_simplices", static_cast<Offset>(cells.size()),
                                               [&](Offset t) { return cells[t]; });
  }
  shared.is_in_float = dataset.points.index() == 0;
  shared.field = select_field(dataset, input);
  std::string contradiction;
  shared.order = outputs::order_values(dataset, shared.field, vertices, &contradiction);
  shared.arrays = std::move(dataset.arrays);
  shared.notices = std::move(dataset.notices);
  if (!contradiction.empty()) shared.notices.push_back(contradiction);
}

/// Has the other ranks have the arrays of the first, without values.
void share_names(const Ranks& ranks, SharedInput& shared) {
  std::vector<io::PointArray> all = shared.arrays;
  all.push_back(shared.field);
  all.push_back(shared.order);
  const std::string description = ranks.broadcast(described(all), 0);
  shared.is_in_float = ranks.least(std::int64_t(shared.is_in_float)) == 1;
  if (ranks.rank() == 0) return;
  shared.arrays = empty_arrays(description);
  const auto take_last = [&] {
    io::PointArray last = std::move(shared.arrays.back());
    shared.arrays.pop_back();
    return last;
  };
  shared.order = take_last();
  shared.field = take_last();
}

}  // namespace

std::string described(const std::vector<io::PointArray>& arrays) {
  std::ostringstream text;
  for (const io::PointArray& array : arrays)
    text << array.values.index() << ' ' << array.components << ' ' << array.name.size() << ' ' << array.name;
  return text.str();
}

std::vector<io::PointArray> empty_arrays(const std::string& description) {
  std::vector<io::PointArray> arrays;
  std::istringstream text(description);
  int type = 0, components = 0;
  std::size_t length = 0;
  while (text >> type >> components >> length) {
    std::string name(length, ' ');
    text.get();
    text.read(name.data(), static_cast<std::streamsize>(length));
    arrays.push_back({name, components, io::detail::no_values(static_cast<io::detail::ValueType>(type))});
  }
  return arrays;
}

namespace {

SharedInput read_shared(const Ranks& ranks, InputOptions input, const WantedOfInput& wanted) {
  SharedInput shared;
  if (input.read.grids == io::GridCells::written) input.read.grids = io::GridCells::computed;
  if (input.read.grids == io::GridCells::computed && !wanted.arrays && !input.height)
    input.read.grids = io::GridCells::computed_alone;
  begin_step("reading", input.input);
  std::optional<io::PieceNames> pieces;
  detail::together(ranks, [&] { pieces = io::piece_names(input.input); });
  if (pieces) return read_pieces(ranks, input, *pieces);
  std::optional<Grid> grid;
  io::Dataset::Positions points;
  detail::together(ranks, [&] {
    const auto of = io::grid_points(input.input, input.read);
    if (of) {
      shared = make_layers(ranks, input, *of, wanted);
      return;
    }
    shared.is_dealt_out = true;
    if (ranks.rank() == 0) take_file(input, shared, grid, points);
  });
  if (!shared.is_dealt_out) return shared;
  share_names(ranks, shared);
  if (ranks.least(std::int64_t(ranks.rank() > 0 || grid)) == 1) deal_layers(ranks, grid, points, wanted, shared);
  return shared;
}

/// The values of an array of the part's vertices at all vertices that this rank holds, by input id. Collective.
io::PointArray held_values(const Mesh& mesh, const io::PointArray& array) {
  return outputs::detail::brought(mesh.exchange().from_givers(), mesh.exchange().ranks(), array, mesh.vertices());
}

/// Whether all ranks have values of the vertices that they own, one after the other. Collective.
bool are_of_owned(const Mesh& mesh, const io::PointArray& array) {
  const Offset count = mesh.owned_vertices().size();
  const bool are_own = mesh.exchange().from_givers().run().count == count &&
                       std::visit([&](const auto& values) { return Offset(values.size()) == count; }, array.values);
  return mesh.exchange().ranks().least(std::int64_t(are_own)) == 1;
}

/// The numbers of the input's cells that those of this rank are of, by input id, from those that ranks handed over by
/// `ids`. Collective.
io::PointArray held_cells(const DistributedMesh& mesh, const Array<const GlobalId, HostMemory>& ids,
                          const Array<GlobalId, HostMemory>& cells) {
  const Ranks& ranks = mesh.exchange().ranks();
  const detail::HomeTable<GlobalId> table(
      ranks, ids, [&](Id i) { return cells(i); }, [](int, GlobalId cell) { return cell; });
  const auto found = table.find(ranks, mesh.cell_ids(), -1);
  return {io::global_cell_ids, 1, std::vector<GlobalId>(found.data(), found.data() + found.extent(0))};
}

/// Points, arrays and, if they were kept, cells of what this rank holds. Collective.
io::Dataset held_dataset(const DistributedMesh& mesh, const SharedInput& shared) {
  io::Dataset held;
  detail::together(mesh.exchange().ranks(), [&] {
    const auto fill = [&](auto coordinate) {
      using Coordinate = decltype(coordinate);
      const auto& points = mesh.points();
      held.points = detail::tabulated_rows<Coordinate, 3>("GALE::local_points", points.extent(0),
                                                          [&](Offset i, int axis) { return points(i, axis); });
    };
    shared.is_in_float ? fill(float()) : fill(double());
    const auto take_corners = [&](auto& cells) {
      cells = std::decay_t<decltype(cells)>("GALE::local_cells", mesh.corners().extent(0));
      if (cells.extent(0) > 0) Kokkos::deep_copy(cells, mesh.corners());
    };
    mesh.dimension() == 3 ? take_corners(held.tetrahedra) : take_corners(held.triangles);
  });
  for (const io::PointArray& array : shared.arrays) held.arrays.push_back(held_values(mesh, array));
  return held;
}

VertexOrder order_by(const Mesh& mesh, const io::PointArray& order) {
  return std::visit(
      [&](const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        return VertexOrder(mesh, Array<const Value, HostMemory>(values.data(), values.size()));
      },
      order.values);
}

}  // namespace

FieldOnMesh read_on_ranks(const InputOptions& from, int capacity, const WantedOfInput& wanted,
                          const std::function<void(const std::vector<std::string>& notices)>& was_read) {
  const auto& ranks = static_cast<const Communicator&>(Launch::ranks());  // what it is where there are several
  const bool writes_cells = from.read.grids == io::GridCells::written;    // whose segments need points
  SharedInput input = read_shared(ranks, from, {wanted.values, wanted.arrays || writes_cells, wanted.cells});
  was_read(input.notices);
  begin_step("sharing the mesh");
  // Cells without ids are counted from rank to rank.
  Array<const GlobalId, HostMemory> given_ids;
  const bool names_cells = wanted.cells && ranks.least(-std::int64_t(input.cells.extent(0))) < 0;
  if (names_cells) {
    Offset count = 0;
    std::visit(
        [&](const auto& part) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(part)>, GridLayers>) {
            given_ids = part.cell_ids;
            count = static_cast<Offset>(part.cells.extent(0));
          }
        },
        input.part);
    const bool are_counted = ranks.least(-std::int64_t(given_ids.extent(0))) == 0;
    const GlobalId first = ranks.sum_before(count);
    if (are_counted) detail::together(ranks, [&] { given_ids = counted(first, count); });
  }
  PartitionOptions options;
  options.repartition = input.is_dealt_out;  // but for layers of a grid
  options.keep_corners = wanted.cells;
  options.capacity = capacity;
  DistributedMesh mesh =
      std::visit([&](const auto& part) { return DistributedMesh(ranks, part, options); }, input.part);
  const auto* const layers = std::get_if<GridLayers>(&input.part);
  if (layers != nullptr && writes_cells) {
    options.repartition = false;
    mesh = with_written_cells(ranks, mesh, layers->positions, options);
  }
  input.part = {};
  begin_step("ordering the vertices");
  const bool is_rounded = outputs::is_rounded(input.field);
  std::string note;
  std::optional<io::PointArray> held;
  if (input.has_order) {
    held = held_values(mesh, input.field);
    note = outputs::note_of_order(mesh, held_values(mesh, input.order), *held);
  }
  const VertexOrder order = order_by(mesh, input.order);
  io::PointArray field{input.field.name, 1, {}};
  io::Dataset dataset;
  if (wanted.arrays) {
    begin_step("sharing the arrays");
    dataset = held_dataset(mesh, input);
    if (names_cells) dataset.cell_arrays.push_back(held_cells(mesh, given_ids, input.cells));
  }
  auto values = outputs::ValuesOf::held_vertices;
  if (wanted.values && wanted.owned_will_do && are_of_owned(mesh, input.field)) {
    field = std::move(input.field);
    values = outputs::ValuesOf::owned_vertices;
  } else if (wanted.values) {
    field = held ? std::move(*held) : held_values(mesh, input.field);
  }
  return {std::move(dataset), mesh, std::move(field), order, input.has_ids, values, is_rounded, note};
}

}  // namespace gale::app
