#include <sstream>

#include <gale/app/ranks/pieces_input.hpp>
#include <gale/app/ranks/shared_input.hpp>
#include <gale/app/step.hpp>
#include <gale/distributed/exchange_plan.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

Array<GlobalId, HostMemory> counted(GlobalId first, Offset count) {
  const auto ids = allocate<Array<GlobalId, HostMemory>>("GALE::input_ids", count);
  parallel_for("GALE::input_ids", HostExecutionSpace(), count, [&](Offset i) { ids(i) = first + i; });
  return ids;
}

template <class Index>
void take_grid(int n, const Communicator& ranks, SharedInput& shared) {
  io::GridPartOf<Index> slab = io::make_grid_part<Index>(n, ranks.rank(), ranks.size());
  const auto ids = counted(slab.first_vertex, static_cast<Offset>(slab.field.size()));
  // Tetrahedra are counted from rank to rank, as in the whole grid.
  shared.held = HeldPart<Index>{slab.tetrahedra, make_part(ids, slab.points, slab.tetrahedra)};
  shared.arrays.push_back({"field", 1, std::move(slab.field)});
}

void take_file(const InputOptions& input, SharedInput& shared) {
  io::Dataset dataset = io::read(input.input, input.read);
  std::visit(
      [&](const auto& points) {
        const auto ids = counted(0, points.extent(0));
        shared.held = HeldPart<std::int32_t>{dataset.tetrahedra, make_part(ids, points, dataset.tetrahedra)};
      },
      dataset.points);
  shared.is_in_float = dataset.points.index() == 0;
  shared.field = outputs::select_field(dataset, input.read.array);
  shared.order = outputs::order_values(dataset, shared.field,
                                       std::get<HeldPart<std::int32_t>>(shared.held).part.vertex_ids.extent(0));
  shared.arrays = std::move(dataset.arrays);
  shared.notices = std::move(dataset.notices);
}

/// Has the other ranks have the arrays of the first, without values.
void share_names(const Communicator& ranks, SharedInput& shared) {
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
    io::PointArray array{name, components, {}};
    io::detail::with_type(static_cast<io::detail::ValueType>(type),
                          [&](auto value) { array.values = std::vector<decltype(value)>(); });
    arrays.push_back(std::move(array));
  }
  return arrays;
}

SharedInput read_shared(const Communicator& ranks, const InputOptions& input) {
  SharedInput shared;
  begin_step("reading", input.input);
  std::optional<io::PieceNames> pieces;
  detail::together(ranks, [&] { pieces = io::piece_names(input.input); });
  if (pieces) return read_pieces(ranks, input, *pieces);
  detail::together(ranks, [&] {
    if (const auto n = io::grid_size(input.input, input.read)) {
      constexpr int most = 1290;  // whose vertices 32 bits number
      *n <= most ? take_grid<std::int32_t>(*n, ranks, shared) : take_grid<std::int64_t>(*n, ranks, shared);
      io::Dataset named;
      named.arrays = shared.arrays;
      shared.field = outputs::select_field(named, input.read.array);
      shared.order = shared.field;
      return;
    }
    shared.is_dealt_out = true;
    if (ranks.rank() == 0) take_file(input, shared);
  });
  if (shared.is_dealt_out) share_names(ranks, shared);
  return shared;
}

io::PointArray local_values(const DistributedMesh& mesh, const io::PointArray& array) {
  return std::visit(
      [&](const auto& values) -> io::PointArray {
        using Values = std::decay_t<decltype(values)>;
        using Value = typename Values::value_type;
        const std::size_t count = mesh.local().vertices(), width = array.components;
        Values all(count * width);
        std::vector<Value> from(mesh.given_vertices()), to(count);
        for (std::size_t component = 0; component < width; ++component) {
          for (std::size_t i = 0; i < from.size(); ++i) from[i] = values[i * width + component];
          mesh.from_givers()(mesh.ranks(), from.data(), to.data());
          for (std::size_t i = 0; i < count; ++i) all[i * width + component] = to[i];
        }
        return {array.name, array.components, std::move(all)};
      },
      array.values);
}

}  // namespace gale::app
