#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/io/dataset.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/segmentation.hpp>

namespace gale::outputs::detail {

const io::PointArray* find_array(const io::Dataset& dataset, const std::string& name) {
  for (const auto& array : dataset.arrays) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

std::string names_of_arrays(const io::Dataset& dataset) {
  std::string names;
  for (const auto& array : dataset.arrays) names += (names.empty() ? "" : ", ") + array.name;
  return names.empty() ? "the input has no point arrays" : "the input has " + names;
}

}  // namespace gale::outputs::detail

namespace gale::outputs {

namespace {

using detail::find_array;
using detail::names_of_arrays;

const std::string order_suffix = "_Order";

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The array NAME where `name` is NAME_K, and K; nullptr if it isn't of that form, or there is no such array.
const io::PointArray* find_component(const io::Dataset& dataset, const std::string& name, int& component) {
  const auto bar = name.rfind('_');
  if (bar == std::string::npos || bar + 1 == name.size() || name.size() - bar > 9) return nullptr;
  if (name.find_first_not_of("0123456789", bar + 1) != std::string::npos) return nullptr;
  component = std::stoi(name.substr(bar + 1));
  return find_array(dataset, name.substr(0, bar));
}

io::PointArray first_field(const io::Dataset& dataset) {
  for (const auto& array : dataset.arrays) {
    if (may_be_field(array.name, array.components, holds_segments(array))) return array;
  }
  throw Error("no point array to analyse: " + names_of_arrays(dataset));
}

/// The vertices by their places; throws gale::Error for an array that is no permutation.
std::vector<Id> vertices_in_order(const io::PointArray& order, std::size_t count) {
  std::vector<Id> vertices(count, no_id);
  std::visit(
      [&](const auto& values) {
        if (values.size() != count)
          throw Error("array '" + order.name + "' has " + std::to_string(values.size()) + " values for " +
                      std::to_string(count) + " vertices");
        for (std::size_t v = 0; v < values.size(); ++v) {
          const auto value = values[v];
          const bool inside = value >= 0 && static_cast<double>(value) < static_cast<double>(count);
          const auto place = inside ? static_cast<std::size_t>(value) : count;
          if (place == count || static_cast<decltype(value)>(place) != value || vertices[place] != no_id) {
            throw Error("array '" + order.name + "' is no permutation of 0 to " + std::to_string(count - 1) +
                        ": vertex " + std::to_string(v) + " has " + std::to_string(value));
          }
          vertices[place] = static_cast<Id>(v);
        }
      },
      order.values);
  return vertices;
}

/// Whether the input cells of a mesh are these: corners_of(cell) are the vertices of each, as many as it has corners.
template <int corners, class CornersOf>
bool has_cells(const Mesh& mesh, const CornersOf& corners_of) {
  const OtherIds vertices = mesh.vertices_in_input(), cells = mesh.cells_in_input();
  const CellReader cell = mesh.cell_reader();
  const auto differs = [&](Offset t) -> Offset {
    const Quad quad = cell(static_cast<Id>(t));
    const auto& others = corners_of(cells[static_cast<Id>(t)]);
    for (int k = 0; k < corners; ++k) {
      bool is_there = false;
      for (int i = 0; i < corners; ++i) is_there |= others[i] == vertices[quad[k]];
      if (!is_there) return 1;
    }
    return 0;
  };
  return reduce_sum("GALE::other_cells", HostExecutionSpace(), mesh.cells(), differs) == 0;
}

template <int corners>
bool has_cells(const Mesh& mesh, const io::Dataset& dataset, const Id* rows) {
  if (rows != nullptr) return has_cells<corners>(mesh, [&](Id t) { return rows + Offset(corners) * t; });
  const GridView grid = dataset.grid->in<HostMemory>();
  return has_cells<corners>(mesh, [&](Id t) { return grid.cell(t); });
}

}  // namespace

std::string contradiction(const std::string& field, GlobalId lower, GlobalId before) {
  return "'" + field + order_suffix + "' orders the vertices, though it contradicts '" + field + "': vertex " +
         std::to_string(lower) + " comes after vertex " + std::to_string(before) + ", which has a higher value";
}

bool may_be_field(const std::string& name, int components, bool is_whole) {
  const bool is_segments = is_whole && (name == segments_name || name == ttk_segments_name);
  const bool is_of_pieces = is_whole && (name == "GlobalPointIds" || name == "vtkGhostType");
  return components == 1 && !is_segments && !is_of_pieces && !ends_with(name, order_suffix);
}

io::PointArray select_field(const io::Dataset& dataset, const std::string& name) {
  if (name.empty()) return first_field(dataset);
  if (const auto* const array = find_array(dataset, name)) {
    if (array->components == 1) return *array;
    throw Error("array '" + name + "' has " + std::to_string(array->components) + " components: name one, as " + name +
                "_0");
  }
  int component = 0;
  const auto* const array = find_component(dataset, name, component);
  if (array == nullptr || component >= array->components)
    throw Error("no point array '" + name + "': " + names_of_arrays(dataset));
  return io::extract_component(*array, component);
}

void add_height(io::Dataset& dataset, int axis) {
  if (axis < 0 || axis > 2) throw Error("there is no axis " + std::to_string(axis) + ": 0 is x, 2 is z");
  const auto coordinates = [axis](const auto& points) -> io::PointArray::Values {
    using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
    std::vector<Coordinate> values(points.extent(0));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = points(i, axis);
    return values;
  };
  auto& arrays = dataset.arrays;
  arrays.erase(std::remove_if(arrays.begin(), arrays.end(),
                              [](const io::PointArray& array) { return array.name == height_name; }),
               arrays.end());
  arrays.insert(arrays.begin(), {height_name, 1, std::visit(coordinates, dataset.points)});
}

bool is_rounded(const io::PointArray& field) {
  const auto has_any_beyond = [](const auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    if constexpr (std::is_integral_v<Value> && sizeof(Value) == 8) {
      constexpr auto most = static_cast<Value>(std::uint64_t(1) << std::numeric_limits<double>::digits);
      return std::any_of(values.begin(), values.end(), [](Value value) {
        return value > most || (std::is_signed_v<Value> && value < Value(0) - most);
      });
    } else {
      return false;
    }
  };
  return std::visit(has_any_beyond, field.values);
}

const io::PointArray& order_array(const io::Dataset& dataset, const io::PointArray& field) {
  const auto* const order = find_array(dataset, field.name + order_suffix);
  return order == nullptr || order->components != 1 ? field : *order;
}

const io::PointArray& order_values(const io::Dataset& dataset, const io::PointArray& field, std::size_t vertices,
                                   std::string* note) {
  const io::PointArray& order = order_array(dataset, field);
  if (&order == &field) return field;
  const std::vector<Id> sorted = vertices_in_order(order, vertices);
  if (note == nullptr) return order;
  const Offset count = static_cast<Offset>(vertices);
  const Offset bad = reduce_min("GALE::descents", HostExecutionSpace(), count, count, [&](Offset place) {
    return place > 0 && value_at(field, sorted[place]) < value_at(field, sorted[place - 1]) ? place : count;
  });
  if (bad < count) *note = contradiction(field.name, sorted[bad], sorted[bad - 1]);
  return order;
}

Mesh mesh_of(const io::Dataset& dataset, const Segmentation& segmentation) {
  return dataset.dimension() == 3 ? Mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra), segmentation)
                                  : Mesh(Triangles<Id, HostMemory>(dataset.triangles), segmentation);
}

bool is_mesh_of(const Mesh& mesh, const io::Dataset& dataset) {
  const bool is_as_large = mesh.dimension() == dataset.dimension() &&
                           static_cast<std::size_t>(mesh.vertices()) == dataset.vertices() &&
                           static_cast<std::size_t>(mesh.cells()) == dataset.cells();
  if (!is_as_large || (mesh.grid() != nullptr && dataset.grid && *mesh.grid() == *dataset.grid)) return is_as_large;
  return mesh.dimension() == 3 ? has_cells<4>(mesh, dataset, dataset.tetrahedra.data())
                               : has_cells<3>(mesh, dataset, dataset.triangles.data());
}

VertexOrder order_of(const Mesh& mesh, const io::Dataset& dataset, const io::PointArray& field, std::string* note) {
  return std::visit([&](const auto& values) { return VertexOrder(mesh, values.data(), values.size()); },
                    order_values(dataset, field, mesh.vertices(), note).values);
}

}  // namespace gale::outputs
