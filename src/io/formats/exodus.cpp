#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <numeric>

#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/exodus.hpp>
#include <gale/io/formats/hdf5_file.hpp>
#include <gale/io/formats/volume.hpp>

// Exodus II is NetCDF with names agreed upon: coordx coordy coordz, or coord in older files; connect1 connect2 ..., the
// elements of each block, whose points are numbered from 1 on; vals_nod_var1 vals_nod_var2 ..., at each time, or
// vals_nod_var in older files.
namespace gale::io::detail {
namespace {

// Exodus has the middles of edges between bottom and top before those of the top, VTK behind them.
const std::vector<std::uint8_t> hexahedron_20 = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
const std::vector<std::uint8_t> hexahedron_27 = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 16, 17,
                                                 18, 19, 12, 13, 14, 15, 23, 24, 25, 26, 21, 22, 20};
const std::vector<std::uint8_t> wedge_15 = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};
const std::vector<std::uint8_t> wedge_18 = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11, 15, 16, 17};

constexpr int any = 0, as_many = 0;

/// Elements whose names begin with one of these, of three letters each.
struct Family {
  const char* names;
  int element_points;  ///< or any
  int cell_type;
  int cell_points;  ///< or as many as the element has
  const std::vector<std::uint8_t>* order = nullptr;
};

const Family families[] = {{"TET", 10, 24, 10},
                           {"TET", 11, 24, 10},
                           {"TET", 15, 71, 15},
                           {"TET", any, cell_type::tetrahedron, 4},
                           {"HEX", 20, 25, 20, &hexahedron_20},
                           {"HEX", 21, 25, 20, &hexahedron_20},
                           {"HEX", 27, 29, 27, &hexahedron_27},
                           {"HEX", any, cell_type::hexahedron, 8},
                           {"WED", 15, 26, 15, &wedge_15},
                           {"WED", 18, 32, 18, &wedge_18},
                           {"WED", 21, 73, 21},
                           {"WED", any, 13, 6},
                           {"PYR", 13, 27, 13},
                           {"PYR", any, 14, 5},
                           {"TRI", 6, 22, 6},
                           {"TRI", any, 5, 3},
                           {"QUA SHE", 8, 23, 8},
                           {"QUA", 9, 28, 9},
                           {"SHE", 9, 23, 8},
                           {"SHE", 3, 5, 3},
                           {"QUA SHE", any, 9, 4},
                           {"TRU BEA BAR EDG", 3, 21, 3},
                           {"TRU BEA BAR EDG STR", any, 3, 2},
                           {"SPH CIR", any, 1, 1},
                           {"SUP", any, 2, as_many}};

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// The common begin, before these endings, of the names from `first` on; empty if they don't end so.
std::string common_name(const std::vector<PointArray>& arrays, std::size_t first,
                        const std::vector<std::string>& endings) {
  if (arrays.size() - first < endings.size()) return "";
  std::string common;
  for (std::size_t k = 0; k < endings.size(); ++k) {
    const PointArray& array = arrays[first + k];
    const std::string& name = array.name;
    const std::size_t rest = name.size() - std::min(name.size(), endings[k].size());
    if (upper_case(name.substr(rest)) != endings[k] || array.values.index() != arrays[first].values.index()) return "";
    if (k == 0) common = name.substr(0, rest);
    if (name.substr(0, rest) != common) return "";
  }
  return common;
}

PointArray joined(const std::vector<PointArray>& arrays, std::size_t first, std::size_t count, std::string name,
                  std::size_t components) {
  return std::visit(
      [&](const auto& example) {
        using Vector = std::decay_t<decltype(example)>;
        Vector all(example.size() * components);
        for (std::size_t c = 0; c < count; ++c) {
          const auto& from = std::get<Vector>(arrays[first + c].values);
          for (std::size_t k = 0; k < from.size(); ++k) all[k * components + c] = from[k];
        }
        return PointArray{std::move(name), static_cast<int>(components), std::move(all)};
      },
      arrays[first].values);
}

}  // namespace

ElementType find_element_type(const std::string& name, std::uint64_t points, const std::string& array) {
  const std::string begin = upper_case(name.substr(0, 3));
  for (const Family& family : families) {
    const std::vector<std::string> names = words_of(family.names);
    const bool is_it = std::find(names.begin(), names.end(), begin) != names.end() &&
                       (family.element_points == any || static_cast<std::uint64_t>(family.element_points) == points);
    if (!is_it || points < static_cast<std::uint64_t>(family.cell_points)) continue;
    const std::size_t used = family.cell_points == as_many ? points : static_cast<std::size_t>(family.cell_points);
    return {family.cell_type, used, family.order != nullptr ? *family.order : std::vector<std::uint8_t>()};
  }
  refuse("its '", printable(array), "' has elements of the type '", printable(name), "' with ", points,
         " points each, which is unknown");
}

std::vector<PointArray> with_vectors(std::vector<PointArray> arrays, std::uint64_t dimensions) {
  static const std::vector<std::string> endings[] = {{"XX", "YY", "ZZ", "XY", "XZ", "YZ"}, {"X", "Y", "Z"}, {"X", "Y"}};
  std::vector<PointArray> result;
  for (std::size_t k = 0; k < arrays.size();) {
    std::size_t count = 1;
    for (const auto& some : endings) {
      std::string name = common_name(arrays, k, some);
      if (name.empty()) continue;
      count = some.size();
      result.push_back(joined(arrays, k, count, std::move(name), count == 2 && dimensions == 2 ? 3 : count));
      break;
    }
    if (count == 1) result.push_back(std::move(arrays[k]));
    k += count;
  }
  return result;
}

namespace {

std::uint64_t require_dimension(const ArrayFile& file, const char* name) {
  const std::optional<std::uint64_t> length = file.dimension(name);
  if (!length) refuse("it is no Exodus II file: it has no ", name);
  return *length;
}

/// Throws gale::Error unless the array has that shape.
void require_shape(const FileArray& array, const std::vector<std::uint64_t>& shape) {
  const auto text = [](const std::vector<std::uint64_t>& lengths) {
    std::string result;
    for (const std::uint64_t length : lengths) result += (result.empty() ? "" : " x ") + std::to_string(length);
    return result;
  };
  if (array.shape != shape) damaged("its '", array.name, "' has ", text(array.shape), " values, not ", text(shape));
}

void require_numbers(const FileArray& array, bool whole) {
  const bool is_whole = *array.type < ValueType::float32;
  if (array.is_text || is_whole != whole)
    damaged("its '", array.name, "' has values of type ", (array.is_text ? "text" : name_of(*array.type)));
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
  return interleaved(axes, points);
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

  FileCells take() { return {std::move(types_), std::move(ends_), std::move(points_)}; }

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
    damaged("its '", name, "' isn't ", count, " names");
  const auto characters = std::get<std::vector<std::int8_t>>(file.read(array));
  std::vector<std::string> names;
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto* const begin = reinterpret_cast<const char*>(characters.data()) + k * array.shape[1];
    names.push_back(trimmed(std::string(begin, strnlen(begin, static_cast<std::size_t>(array.shape[1])))));
  }
  return names;
}

/// How many times there are: NetCDF-4 doesn't say how long an unlimited dimension is.
std::uint64_t count_times(const ArrayFile& file) {
  const FileArray* const time = file.find("time_whole");
  return time != nullptr ? time->rows() : file.dimension("time_step").value_or(0);
}

/// Nodal variables at the time that is wanted.
void read_variables(ArrayFile& file, std::uint64_t points, const ReadOptions& options, MeshParts& parts) {
  const std::uint64_t count = file.dimension("num_nod_var").value_or(0);
  if (count == 0 || points == 0) return;
  const std::uint64_t times = count_times(file);
  const std::vector<std::string> names = read_names(file, "name_nod_var", count);
  if (times == 0) {
    parts.notices.push_back("left out its nodal variables: it has no time yet");
    return;
  }
  const std::uint64_t time = chosen_time(options, times, parts.notices);
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
        file.read(*all, {1, time}));
  } else {
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::string name = "vals_nod_var" + std::to_string(k + 1);
      if (file.find(name) == nullptr)
        damaged("its nodal variable '", names[k], "' is declared and has no values: there is no '", name, "'");
      const FileArray& array = file.require(name);
      require_numbers(array, false);
      require_shape(array, {array.rows(), points});
      add(file.read(array, {1, time}));
    }
  }
  parts.arrays = with_vectors(std::move(variables), require_dimension(file, "num_dim"));
}

Content read_exodus_from(ArrayFile& file, const ReadOptions& options) {
  const std::uint64_t dimensions = require_dimension(file, "num_dim"), points = require_dimension(file, "num_nodes");
  if (dimensions < 1 || dimensions > 3) damaged("it has ", dimensions, " dimensions");
  MeshParts parts;
  parts.points = read_points(file, dimensions, points);
  Elements elements(file);
  for (const std::uint64_t block : ordered_blocks(file)) elements.add_block(std::to_string(block));
  parts.cells = elements.take();
  read_variables(file, points, options, parts);
  return to_mesh(parts, options);
}

std::vector<double> times_of(ArrayFile& file) {
  const std::uint64_t count = count_times(file);
  if (count > most_files) damaged("it has ", count, " times, more than ", most_files);
  std::vector<double> times(count);
  std::iota(times.begin(), times.end(), 0);
  if (count == 0 || file.find("time_whole") == nullptr) return times;
  const FileArray& array = file.require("time_whole");
  require_numbers(array, false);
  require_shape(array, {count});
  std::visit([&](const auto& values) { times.assign(values.begin(), values.end()); }, file.read(array));
  return times;
}

std::unique_ptr<ArrayFile> open_exodus(const InputFile& input) {
  if (input.begins_with(netcdf_magic)) return open_netcdf(input);
  if (!input.begins_with(hdf5_magic)) throw Error("it is no Exodus II file");
  auto file = std::make_unique<Hdf5File>(input);
  file->open_group("");
  return file;
}

}  // namespace

Content read_exodus(const InputFile& input, const ReadOptions& options) {
  return read_exodus_from(*open_exodus(input), options);
}

std::vector<Step> steps_of_exodus(const InputFile& input, const ReadOptions&) {
  return steps_at(input, times_of(*open_exodus(input)));
}

}  // namespace gale::io::detail
