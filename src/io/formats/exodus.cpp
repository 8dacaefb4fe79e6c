#include <algorithm>
#include <cstring>
#include <numeric>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/formats/exodus_names.hpp>
#include <gale/io/formats/hdf5_file.hpp>
#include <gale/io/formats/readers.hpp>
#include <gale/io/formats/volume.hpp>

// Exodus II is NetCDF with names agreed upon: coordx coordy coordz, or coord in older files; connect1 connect2 ..., the
// elements of each block, whose points are numbered from 1 on; vals_nod_var1 vals_nod_var2 ..., at each time, or
// vals_nod_var in older files.
namespace gale::io::detail {

namespace {

std::uint64_t require_dimension(const ArrayFile& file, const char* name) {
  const std::optional<std::uint64_t> length = file.dimension(name);
  if (!length) throw Error("it is no Exodus II file: it has no " + std::string(name));
  return *length;
}

/// Throws gale::Error unless the array has that shape.
void require_shape(const FileArray& array, const std::vector<std::uint64_t>& shape) {
  const auto text = [](const std::vector<std::uint64_t>& lengths) {
    std::string result;
    for (const std::uint64_t length : lengths) result += (result.empty() ? "" : " x ") + std::to_string(length);
    return result;
  };
  if (array.shape != shape)
    damaged("its '" + array.name + "' has " + text(array.shape) + " values, not " + text(shape));
}

void require_numbers(const FileArray& array, bool whole) {
  const bool is_whole = *array.type < ValueType::float32;
  if (array.is_text || is_whole != whole)
    damaged("its '" + array.name + "' has values of type " + (array.is_text ? "text" : name_of(*array.type)));
}

/// The coordinates, which are float or double, point by point.
template <class T>
PointArray::Values interleaved(const std::vector<PointArray::Values>& axes, std::uint64_t points) {
  std::vector<T> xyz(3 * points);
  for (std::size_t d = 0; d < axes.size(); ++d) {
    std::visit(
        [&](const auto& from) {
          for (std::uint64_t k = 0; k < points; ++k) xyz[3 * k + d] = static_cast<T>(from[k]);
        },
        axes[d]);
  }
  return xyz;
}

PointArray::Values read_points(ArrayFile& file, std::uint64_t dimensions, std::uint64_t points) {
  std::vector<PointArray::Values> axes;
  if (points > 0 && file.find("coordx") == nullptr && file.find("coord") != nullptr) {
    const FileArray& all = file.require("coord");
    require_numbers(all, false);
    require_shape(all, {dimensions, points});
    const PointArray::Values values = file.read(all);
    std::visit(
        [&](const auto& from) {
          using Vector = std::decay_t<decltype(from)>;
          const auto step = static_cast<std::ptrdiff_t>(points);
          for (auto at = from.begin(); at != from.end(); at += step) axes.emplace_back(Vector(at, at + step));
        },
        values);
  } else {
    for (std::uint64_t d = 0; d < dimensions && points > 0; ++d) {
      const FileArray& axis = file.require(std::string("coord") + "xyz"[d]);
      require_numbers(axis, false);
      require_shape(axis, {points});
      axes.push_back(file.read(axis));
    }
  }
  const bool is_float = std::all_of(axes.begin(), axes.end(), [](const PointArray::Values& axis) {
    return std::holds_alternative<std::vector<float>>(axis);
  });
  return is_float ? interleaved<float>(axes, points) : interleaved<double>(axes, points);
}

/// The numbers of the blocks in the order of their ids, as VTK has them.
std::vector<std::uint64_t> ordered_blocks(ArrayFile& file) {
  const std::uint64_t blocks = file.dimension("num_el_blk").value_or(0);
  if (blocks == 0) return {};
  const FileArray& ids = file.require("eb_prop1");
  require_numbers(ids, true);
  require_shape(ids, {blocks});
  const PointArray::Values values = file.read(ids);
  std::vector<std::uint64_t> order(blocks);
  std::iota(order.begin(), order.end(), std::uint64_t(1));
  std::visit(
      [&](const auto& id) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint64_t a, std::uint64_t b) { return id[a - 1] < id[b - 1]; });
      },
      values);
  return order;
}

class Elements {
 public:
  explicit Elements(ArrayFile& file) : file_(file) {}

  void add_block(const std::string& number) {
    const std::optional<std::uint64_t> count = file_.dimension("num_el_in_blk" + number);
    if (count.value_or(0) == 0) return;
    const FileArray& connect = file_.require("connect" + number);
    require_numbers(connect, true);
    if (connect.shape.size() != 2 || connect.shape[0] != *count)
      require_shape(connect, {*count, file_.dimension("num_nod_per_el" + number).value_or(1)});
    const std::optional<FileAttribute> type = file_.attribute(connect.name, "elem_type");
    const ElementType element = find_element_type(type ? type->text : "", connect.shape[1], connect.name);
    std::visit([&](const auto& points) { add(points, element, connect); }, file_.read(connect));
  }

  Cells take() { return {std::move(types_), std::move(ends_), std::move(points_)}; }

 private:
  template <class Points>
  void add(const Points& points, const ElementType& element, const FileArray& connect) {
    const std::uint64_t width = connect.shape[1];
    for (std::uint64_t e = 0; e < connect.shape[0]; ++e) {
      for (std::size_t k = 0; k < element.points; ++k) {
        const std::size_t place = element.order.empty() ? k : element.order[k];
        points_.push_back(static_cast<std::int64_t>(points[e * width + place]) - 1);
      }
      types_.push_back(static_cast<std::uint8_t>(element.cell_type));
      ends_.push_back(static_cast<std::int64_t>(points_.size()));
    }
  }

  ArrayFile& file_;
  std::vector<std::uint8_t> types_;
  std::vector<std::int64_t> ends_, points_;
};

/// The rows of a text array, without what fills them up.
std::vector<std::string> read_names(ArrayFile& file, const std::string& name, std::uint64_t count) {
  const FileArray& array = file.require(name);
  if (!array.is_text || array.shape.size() != 2 || array.shape[0] != count || array.shape[1] == 0)
    damaged("its '" + name + "' isn't " + std::to_string(count) + " names");
  const auto characters = std::get<std::vector<std::int8_t>>(file.read(array));
  std::vector<std::string> names;
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto* const begin = reinterpret_cast<const char*>(characters.data()) + k * array.shape[1];
    names.push_back(trimmed(std::string(begin, strnlen(begin, static_cast<std::size_t>(array.shape[1])))));
  }
  return names;
}

/// Nodal variables at the first time.
void read_variables(ArrayFile& file, std::uint64_t points, MeshParts& parts) {
  const std::uint64_t count = file.dimension("num_nod_var").value_or(0);
  if (count == 0 || points == 0) return;
  // NetCDF-4 doesn't say how long an unlimited dimension is.
  const FileArray* const time = file.find("time_whole");
  const std::uint64_t times = time != nullptr ? time->rows() : file.dimension("time_step").value_or(0);
  const std::vector<std::string> names = read_names(file, "name_nod_var", count);
  if (times == 0) {
    parts.notices.push_back("left out its nodal variables: it has no time yet");
    return;
  }
  std::vector<PointArray> variables;
  const auto add = [&](PointArray::Values values) {
    variables.push_back({names[variables.size()], 1, std::move(values)});
  };
  if (const FileArray* const all = file.find("vals_nod_var")) {
    require_numbers(file.require(all->name), false);
    require_shape(*all, {all->rows(), count, points});
    std::visit(
        [&](const auto& values) {
          using Vector = std::decay_t<decltype(values)>;
          const auto step = static_cast<std::ptrdiff_t>(points);
          for (auto at = values.begin(); at != values.end(); at += step) add(Vector(at, at + step));
        },
        file.read(*all, 1));
  } else {
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::string name = "vals_nod_var" + std::to_string(k + 1);
      if (file.find(name) == nullptr)
        damaged("its nodal variable '" + names[k] + "' is declared and has no values: there is no '" + name + "'");
      const FileArray& array = file.require(name);
      require_numbers(array, false);
      require_shape(array, {array.rows(), points});
      add(file.read(array, 1));
    }
  }
  parts.arrays = with_vectors(std::move(variables), require_dimension(file, "num_dim"));
  if (times > 1) parts.notices.push_back("left out all but the first of " + std::to_string(times) + " time steps");
}

Content read_exodus_from(ArrayFile& file, const ReadOptions& options) {
  const std::uint64_t dimensions = require_dimension(file, "num_dim"), points = require_dimension(file, "num_nodes");
  if (dimensions < 1 || dimensions > 3) damaged("it has " + std::to_string(dimensions) + " dimensions");
  MeshParts parts;
  parts.points = read_points(file, dimensions, points);
  Elements elements(file);
  for (const std::uint64_t block : ordered_blocks(file)) elements.add_block(std::to_string(block));
  parts.cells = elements.take();
  read_variables(file, points, parts);
  return to_mesh(parts, options.tetrahedralize);
}

}  // namespace

Content read_exodus(const InputFile& input, const ReadOptions& options) {
  if (is_netcdf(input)) return read_exodus_from(*open_netcdf(input), options);
  if (!is_hdf5(input)) throw Error("it is no Exodus II file");
  Hdf5File file(input);
  file.open_group("");
  return read_exodus_from(file, options);
}

}  // namespace gale::io::detail
