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

const std::string root = "VTKHDF", point_data = root + "/PointData", cell_data = root + "/CellData",
                  steps = root + "/Steps";

/// The numbers of an attribute of the image. Throws gale::Error if there aren't so many.
std::vector<double> numbers(Hdf5File& file, const char* name, std::size_t count, const std::vector<double>& otherwise) {
  const std::optional<FileAttribute> found = file.attribute(root, name);
  if (!found && !otherwise.empty()) return otherwise;
  if (!found) damaged("it has no ", name);
  if (found->numbers.size() != count) damaged("its ", name, " has ", found->numbers.size(), " numbers, not ", count);
  return found->numbers;
}

/// Where what belongs to a time begins in the arrays that have all times, one after the other.
class AtTime {
 public:
  /// Finds the time that is wanted; in a file without times all begins at 0.
  AtTime(Hdf5File& file, const ReadOptions& options, std::vector<std::string>& notices) : file_(file) {
    has_times_ = file.open_group(steps);
    if (has_times_) time_ = chosen_time(options, count(), notices);
    has_arrays_ = has_times_ && file.open_group(steps + "/PointDataOffsets");
  }

  bool has_times() const { return has_times_; }
  std::uint64_t time() const { return time_; }

  /// How many times there are.
  std::uint64_t count() const { return file_.require(steps + "/Values").rows(); }

  /// What an array of a number for each time says of this one; `otherwise` where there is none.
  std::uint64_t at(const std::string& name, std::uint64_t otherwise) const {
    const std::string path = steps + "/" + name;
    if (!has_times_ || file_.find(path) == nullptr) return otherwise;
    const FileArray& array = file_.require(path);
    if (array.is_text || *array.type >= ValueType::float32 || array.count(1) != 1)
      damaged("its '", path, "' is no list of whole numbers");
    const double value =
        std::visit([](const auto& values) { return static_cast<double>(values[0]); }, file_.read(array, {1, time_}));
    if (!(value >= 0 && value <= 9e15)) damaged("its '", path, "' says ", value);
    return static_cast<std::uint64_t>(value);
  }

  /// Where a point array begins.
  std::uint64_t of_array(const std::string& name, std::uint64_t otherwise) const {
    return has_arrays_ ? at("PointDataOffsets/" + name, otherwise) : otherwise;
  }

 private:
  Hdf5File& file_;
  std::uint64_t time_ = 0;
  bool has_times_ = false, has_arrays_ = false;
};

/// The point arrays of that shape, with components behind it or not; active scalars first. Those of several times are
/// `shape` for each, in one more dimension if `in_rows`, else one after the other; `first` is where this time's begin
/// that don't say it.
std::vector<PointArray> read_arrays(Hdf5File& file, std::vector<std::uint64_t> shape, const AtTime& time,
                                    std::uint64_t first, bool in_rows, std::vector<std::string>& notices) {
  if (in_rows) shape.insert(shape.begin(), 1);
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
    arrays.insert(
        is_active ? arrays.begin() : arrays.end(),
        PointArray{name, static_cast<int>(components), file.read(array, {shape[0], time.of_array(name, first)})});
  }
  if (file.open_group(cell_data, &cell_names) && !cell_names.empty()) notices.push_back(note_cell_arrays(cell_names));
  return arrays;
}

/// The whole numbers of a list, some of them.
std::vector<std::int64_t> read_integers(Hdf5File& file, const char* name, std::uint64_t count, std::uint64_t first) {
  const FileArray& array = file.require(root + "/" + name);
  if (array.shape.size() != 1 || *array.type >= ValueType::float32 || array.is_text)
    damaged("its ", name, " is no list of whole numbers");
  PointArray::Values values = file.read(array, {count, first});
  if (auto* const same = std::get_if<std::vector<std::int64_t>>(&values)) return std::move(*same);
  return std::visit([](const auto& from) { return std::vector<std::int64_t>(from.begin(), from.end()); }, values);
}

/// The parts of a mesh at a time.
struct Parts {
  Parts(const Hdf5File& file, const AtTime& time) {
    const std::uint64_t all = file.require(root + "/NumberOfPoints").rows();
    first = time.at("PartOffsets", 0);
    count = time.at("NumberOfParts", time.has_times() ? all / std::max<std::uint64_t>(time.count(), 1) : all);
    if (time.has_times() && count == 0) count = all > 0 ? 1 : 0;  // one that doesn't change
  }

  std::uint64_t first, count;
};

/// How many of something each part has, and all together.
struct Counts {
  Counts(Hdf5File& file, const char* name, const Parts& parts)
      : of_part(read_integers(file, name, parts.count, parts.first)) {
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
  MeshCounts(Hdf5File& file, const Parts& parts)
      : points(file, "NumberOfPoints", parts),
        cells(file, "NumberOfCells", parts),
        corners(file, "NumberOfConnectivityIds", parts) {
    const auto rows = [&](const char* name) { return file.require(root + "/" + name).rows(); };
    const std::uint64_t of_points = rows("NumberOfPoints"), of_cells = rows("NumberOfCells"),
                        of_corners = rows("NumberOfConnectivityIds");
    if (of_cells != of_points || of_corners != of_points)
      damaged("its numbers of points, cells and corners are of ", of_points, ", ", of_cells, " and ", of_corners,
              " parts");
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
  MeshParts parts;
  const AtTime time(file, options, parts.notices);
  const Parts of_mesh(file, time);
  const MeshCounts counts(file, of_mesh);
  const std::uint64_t first_point = time.at("PointOffsets", 0), first_cell = time.at("CellOffsets", 0);
  const FileArray& xyz = file.require(root + "/Points");
  if (xyz.shape.size() != 2 || xyz.shape[1] != 3) damaged("its Points have no three coordinates each");
  parts.points = file.read(xyz, {counts.points.sum, first_point});
  std::vector<std::int64_t> connectivity =
      read_integers(file, "Connectivity", counts.corners.sum, time.at("ConnectivityIdOffsets", 0));
  const std::uint64_t offsets = counts.cells.sum + counts.points.of_part.size();
  parts.cells.ends =
      join_parts(counts, read_integers(file, "Offsets", offsets, first_cell + of_mesh.first), connectivity);
  parts.cells.connectivity = std::move(connectivity);
  parts.cells.types = file.read(file.require(root + "/Types"), {counts.cells.sum, first_cell});
  const std::size_t polyhedron = find_polyhedron(parts.cells.types);
  if (polyhedron < counts.cells.sum) refuse("cell ", polyhedron, " is a vtkPolyhedron, which isn't read from VTKHDF");
  parts.arrays = read_arrays(file, {counts.points.sum}, time, first_point, false, parts.notices);
  return to_mesh(parts, options);
}

Content read_image(Hdf5File& file, const ReadOptions& options) {
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
  const AtTime time(file, options, image.notices);
  image.arrays = read_arrays(file, shape, time, time.time(), time.has_times(), image.notices);
  return image;
}

/// A file, with the arrays of its group VTKHDF known.
class VtkHdfFile {
 public:
  explicit VtkHdfFile(const InputFile& input) : file_(require_hdf5(input)) {
    if (!file_.open_group(root)) throw Error(other);
    const std::optional<FileAttribute> version = file_.attribute(root, "Version"), type = file_.attribute(root, "Type");
    if (!version || version->numbers.size() != 2 || !type) throw Error(other);
    if (version->numbers[0] != 1 && version->numbers[0] != 2)
      refuse("its version of VTKHDF is ", version->numbers[0], ", and 1 and 2 are read");
    kind_ = type->text.c_str();
  }

  Hdf5File& arrays() { return file_; }
  const std::string& kind() const { return kind_; }

 private:
  static constexpr char other[] = "it is no VTKHDF file of a mesh or an image";

  static const InputFile& require_hdf5(const InputFile& input) {
    if (!input.begins_with(hdf5_magic)) throw Error(other);
    return input;
  }

  Hdf5File file_;
  std::string kind_;
};

}  // namespace

Content read_vtkhdf(const InputFile& input, const ReadOptions& options) {
  VtkHdfFile file(input);
  if (file.kind() == "UnstructuredGrid") return read_mesh(file.arrays(), options);
  if (file.kind() == "ImageData") return read_image(file.arrays(), options);
  refuse("it holds a ", printable(file.kind()), ", neither a mesh nor an image");
}

std::vector<Step> steps_of_vtkhdf(const InputFile& input, const ReadOptions&) {
  VtkHdfFile file(input);
  std::vector<double> times;
  if (file.arrays().open_group(steps)) {
    const FileArray& values = file.arrays().require(steps + "/Values");
    if (values.is_text || values.shape.size() != 1) damaged("its '", values.name, "' is no list of times");
    if (values.rows() > most_files) damaged("it has ", values.rows(), " times, more than ", most_files);
    std::visit([&](const auto& all) { times.assign(all.begin(), all.end()); }, file.arrays().read(values));
  }
  return steps_at(input, times);
}

}  // namespace gale::io::detail
