#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/hdf5_file.hpp>
#include <gale/io/formats/volume.hpp>

// VTKHDF: the group VTKHDF has the arrays of a mesh, whose parts follow each other in each array, or says where the
// voxels of an image are; its groups PointData and CellData have the arrays of points and cells.
namespace gale::io::detail {
namespace {

const std::string root = "VTKHDF", point_data = root + "/PointData", cell_data = root + "/CellData";

/// The numbers of an attribute of the image. Throws gale::Error if there aren't so many.
std::vector<double> numbers(Hdf5File& file, const char* name, std::size_t count, const std::vector<double>& otherwise) {
  const std::optional<FileAttribute> found = file.attribute(root, name);
  if (!found && !otherwise.empty()) return otherwise;
  if (!found) damaged("it has no ", name);
  if (found->numbers.size() != count) damaged("its ", name, " has ", found->numbers.size(), " numbers, not ", count);
  return found->numbers;
}

/// The point arrays of that shape, with components behind it or not; active scalars first.
std::vector<PointArray> read_arrays(Hdf5File& file, const std::vector<std::uint64_t>& shape,
                                    std::vector<std::string>& notices) {
  std::vector<PointArray> arrays;
  std::vector<std::string> names, cell_names;
  if (!file.open_group(point_data, &names)) names.clear();
  const std::optional<FileAttribute> active = names.empty() ? std::nullopt : file.attribute(point_data, "Scalars");
  for (const std::string& name : names) {
    const FileArray& array = *file.find(point_data + "/" + name);
    if (!array.type || array.is_text) {
      notices.push_back(note_array(printable(name), "its values are no numbers"));
      continue;
    }
    const bool has_components = array.shape.size() == shape.size() + 1;
    const std::uint64_t components = has_components ? array.shape.back() : 1;
    if (array.shape.size() < shape.size() || array.shape.size() > shape.size() + 1 ||
        !std::equal(shape.begin() + 1, shape.end(), array.shape.begin() + 1) || components < 1 ||
        components > (1u << 20))
      damaged("its point array '", name, "' has another shape than the points");
    const bool is_active = active && active->text.c_str() == name;
    arrays.insert(is_active ? arrays.begin() : arrays.end(),
                  PointArray{name, static_cast<int>(components), file.read(array, shape[0])});
  }
  if (file.open_group(cell_data, &cell_names) && !cell_names.empty()) notices.push_back(note_cell_arrays(cell_names));
  return arrays;
}

/// The whole numbers of a list, all or the first `count`.
std::vector<std::int64_t> read_integers(Hdf5File& file, const char* name, std::optional<std::uint64_t> count = {}) {
  const FileArray& array = file.require(root + "/" + name);
  if (array.shape.size() != 1 || *array.type >= ValueType::float32 || array.is_text)
    damaged("its ", name, " is no list of whole numbers");
  PointArray::Values values = file.read(array, count.value_or(array.rows()));
  if (auto* const same = std::get_if<std::vector<std::int64_t>>(&values)) return std::move(*same);
  return std::visit([](const auto& from) { return std::vector<std::int64_t>(from.begin(), from.end()); }, values);
}

/// How many of something each part has, and all together.
struct Counts {
  Counts(Hdf5File& file, const char* name) : of_part(read_integers(file, name)) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() / 64;
    for (const std::int64_t count : of_part) {
      if (count < 0 || count > most || sum > std::uint64_t(most)) damaged("its ", name, " says ", count);
      sum += static_cast<std::uint64_t>(count);
    }
  }

  std::vector<std::int64_t> of_part;
  std::uint64_t sum = 0;
};

struct MeshCounts {
  explicit MeshCounts(Hdf5File& file)
      : points(file, "NumberOfPoints"), cells(file, "NumberOfCells"), corners(file, "NumberOfConnectivityIds") {
    const std::size_t parts = points.of_part.size();
    if (cells.of_part.size() != parts || corners.of_part.size() != parts)
      damaged("its numbers of points, cells and corners are of ", parts, ", ", cells.of_part.size(), " and ",
              corners.of_part.size(), " parts");
  }

  Counts points, cells, corners;
};

/// Where each cell ends, among the corners of all parts; corners become points of all.
std::vector<std::int64_t> join_parts(const MeshCounts& counts, const std::vector<std::int64_t>& offsets,
                                     std::vector<std::int64_t>& corners) {
  std::vector<std::int64_t> ends;
  std::int64_t first_point = 0, first_corner = 0;
  std::size_t offset = 0;
  for (std::size_t part = 0; part < counts.points.of_part.size(); ++part) {
    const std::int64_t own_corners = counts.corners.of_part[part], own_points = counts.points.of_part[part];
    for (std::int64_t k = 0; k <= counts.cells.of_part[part]; ++k, ++offset) {
      const std::int64_t end = offsets[offset];
      if (end < 0 || end > own_corners || (k == 0 && end != 0))
        damaged("a cell ends at ", end, " of the ", own_corners, " corners of part ", part);
      if (k > 0) ends.push_back(first_corner + end);
    }
    for (std::int64_t k = 0; k < own_corners; ++k) {
      std::int64_t& corner = corners[static_cast<std::size_t>(first_corner + k)];
      if (corner < 0 || corner >= own_points)
        refuse("corner ", k, " of part ", part, " is point ", corner, " of ", own_points);
      corner += first_point;
    }
    first_point += own_points;
    first_corner += own_corners;
  }
  return ends;
}

/// The first polyhedron, or how many cells there are. Its faces are in arrays that aren't read.
std::size_t find_polyhedron(const PointArray::Values& types) {
  return std::visit(
      [](const auto& all) {
        const auto is_it = [](auto type) { return type == static_cast<decltype(type)>(cell_type::polyhedron); };
        return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), is_it) - all.begin());
      },
      types);
}

Content read_mesh(Hdf5File& file, const ReadOptions& options) {
  const MeshCounts counts(file);
  const FileArray& xyz = file.require(root + "/Points");
  if (xyz.shape.size() != 2 || xyz.shape[1] != 3) damaged("its Points have no three coordinates each");
  MeshParts parts;
  parts.points = file.read(xyz, counts.points.sum);
  std::vector<std::int64_t> connectivity = read_integers(file, "Connectivity", counts.corners.sum);
  const std::uint64_t offsets = counts.cells.sum + counts.points.of_part.size();
  parts.cells.ends = join_parts(counts, read_integers(file, "Offsets", offsets), connectivity);
  parts.cells.connectivity = std::move(connectivity);
  parts.cells.types = file.read(file.require(root + "/Types"), counts.cells.sum);
  const std::size_t polyhedron = find_polyhedron(parts.cells.types);
  if (polyhedron < counts.cells.sum) refuse("cell ", polyhedron, " is a vtkPolyhedron, which isn't read from VTKHDF");
  parts.arrays = read_arrays(file, {counts.points.sum}, parts.notices);
  return to_mesh(parts, options);
}

Content read_image(Hdf5File& file) {
  const std::vector<double> extent = numbers(file, "WholeExtent", 6, {});
  std::array<std::int64_t, 3> low{}, high{};
  for (int d = 0; d < 3; ++d) {
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    for (const double end : {extent[2 * d], extent[2 * d + 1]}) {
      if (!(std::abs(end) <= most)) damaged("its WholeExtent has the number ", end);
    }
    low[d] = static_cast<std::int64_t>(extent[2 * d]);
    high[d] = static_cast<std::int64_t>(extent[2 * d + 1]);
  }
  const std::vector<double> origin = numbers(file, "Origin", 3, {0, 0, 0}),
                            spacing = numbers(file, "Spacing", 3, {1, 1, 1}),
                            direction = numbers(file, "Direction", 9, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  Image image = oriented_image(low, high, origin, spacing, direction);
  std::vector<std::uint64_t> shape;
  for (int d = 3; d-- > 0;) shape.push_back(static_cast<std::uint64_t>(image.dimensions[d]));
  image.arrays = read_arrays(file, shape, image.notices);
  return image;
}

}  // namespace

Content read_vtkhdf(const InputFile& input, const ReadOptions& options) {
  constexpr char other[] = "it is no VTKHDF file of a mesh or an image";
  if (!input.begins_with(hdf5_magic)) throw Error(other);
  Hdf5File file(input);
  if (!file.open_group(root)) throw Error(other);
  const std::optional<FileAttribute> version = file.attribute(root, "Version"), type = file.attribute(root, "Type");
  if (!version || version->numbers.size() != 2 || !type) throw Error(other);
  if (version->numbers[0] != 1 && version->numbers[0] != 2)
    refuse("its version of VTKHDF is ", version->numbers[0], ", and 1 and 2 are read");
  if (file.open_group(root + "/Steps")) throw Error("it has several times, which are not read");
  const std::string kind = type->text.c_str();
  if (kind == "UnstructuredGrid") return read_mesh(file, options);
  if (kind == "ImageData") return read_image(file);
  refuse("it holds a ", printable(kind), ", neither a mesh nor an image");
}

}  // namespace gale::io::detail
