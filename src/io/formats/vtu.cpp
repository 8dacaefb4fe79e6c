#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include <gale/base/memory.hpp>
#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/cells/surface_cells.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/xml_file.hpp>

namespace gale::io::detail {
namespace {

constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 64);

std::uint64_t count_in(const XmlElement& piece, const char* of_what) {
  const std::uint64_t count = piece.number(of_what);
  if (count > most) damaged(of_what, " is ", count);
  return count;
}

/// Reads one of the arrays that say what cells there are, of that section.
PointArray::Values read_cells(const XmlFile& file, const XmlElement& piece, const char* name,
                              std::optional<std::uint64_t> count, const char* section = "Cells") {
  piece.require(section);
  const XmlElement* const array = piece.array(section, name);
  if (array == nullptr) damaged("its ", section, " have no ", name);
  return read_array(file, *array, count);
}

/// Reads the cells of one kind that a piece of a surface has, which may be none.
CellsOfKind read_kind(const XmlFile& file, const XmlElement& piece, const char* section, std::uint64_t count) {
  if (count == 0) return {};
  return {read_cells(file, piece, "connectivity", std::nullopt, section),
          read_cells(file, piece, "offsets", count, section)};
}

/// The number of cells of a kind; none where the piece doesn't say.
std::uint64_t count_of_kind(const XmlElement& piece, const char* of_what) {
  return piece.attributes.count(of_what) == 0 ? 0 : count_in(piece, of_what);
}

/// Reads the cells of a piece of a surface. Of points and lines the file has to have as many as it says.
FileCells read_surface_cells(const XmlFile& file, const XmlElement& piece) {
  SurfaceCells cells;
  for (const auto& [section, of_what] : {std::pair("Verts", "NumberOfVerts"), std::pair("Lines", "NumberOfLines")}) {
    const std::uint64_t count = count_of_kind(piece, of_what);
    if (count > 0) cells.below += count_of(read_cells(file, piece, "offsets", count, section));
  }
  cells.polygons = read_kind(file, piece, "Polys", count_of_kind(piece, "NumberOfPolys"));
  cells.strips = read_kind(file, piece, "Strips", count_of_kind(piece, "NumberOfStrips"));
  return cells_of_surface(std::move(cells));
}

/// The faces of polyhedra, and where those of each cell end.
struct PolyhedronFaces {
  std::vector<std::int64_t> entries, ends;
};

/// Reads faces as VTK has them from 9.4 on: each by itself, and of each cell which ones it has.
PolyhedronFaces read_numbered_faces(const XmlFile& file, const XmlElement& piece, std::size_t cells) {
  std::vector<std::int64_t> corners, corner_ends, members, member_ends;
  append(read_cells(file, piece, "face_connectivity", std::nullopt), std::int64_t(0), corners);
  append(read_cells(file, piece, "face_offsets", std::nullopt), std::int64_t(0), corner_ends);
  append(read_cells(file, piece, "polyhedron_to_faces", std::nullopt), std::int64_t(0), members);
  append(read_cells(file, piece, "polyhedron_offsets", cells), std::int64_t(0), member_ends);
  PolyhedronFaces faces;
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    gale::detail::stop_if_asked_at(static_cast<std::int64_t>(c));
    const std::int64_t end = member_ends[c];
    if (end < begin || end > static_cast<std::int64_t>(members.size()))
      damaged("the faces of cell ", c, " end at ", end, " of ", members.size(), ", and those before at ", begin);
    if (end > begin) faces.entries.push_back(end - begin);
    for (; begin < end; ++begin) {
      const auto face = static_cast<std::size_t>(members[static_cast<std::size_t>(begin)]);  // below 0: a huge one
      if (face >= corner_ends.size()) damaged("cell ", c, " has face ", members[begin], " of ", corner_ends.size());
      const std::int64_t first = face == 0 ? 0 : corner_ends[face - 1], last = corner_ends[face];
      if (first < 0 || last < first || last > static_cast<std::int64_t>(corners.size()))
        damaged("face ", face, " ends at ", last, " of ", corners.size(), " corners, and the one before it at ", first);
      faces.entries.push_back(last - first);
      faces.entries.insert(faces.entries.end(), corners.begin() + first, corners.begin() + last);
      // Two cells may share one, more make a small file large.
      if (faces.entries.size() > 2 * (corners.size() + members.size()) + cells)
        damaged("its faces are in more than two cells each");
    }
    faces.ends.push_back(static_cast<std::int64_t>(faces.entries.size()));
  }
  return faces;
}

PolyhedronFaces read_faces(const XmlFile& file, const XmlElement& piece, std::size_t cells) {
  if (piece.array("Cells", "face_connectivity") != nullptr) return read_numbered_faces(file, piece, cells);
  PolyhedronFaces faces;
  append(read_cells(file, piece, "faces", std::nullopt), std::int64_t(0), faces.entries);
  append(read_cells(file, piece, "faceoffsets", cells), std::int64_t(0), faces.ends);
  return faces;
}

/// Gives polyhedra, whose points the connectivity has, the faces that the file has beside it: how many, and of each how
/// many corners, and these.
void take_faces(const XmlFile& file, const XmlElement& piece, FileCells& cells) {
  const auto has_polyhedron = [](const auto& types) {
    return std::find(types.begin(), types.end(), cell_type::polyhedron) != types.end();
  };
  if (!std::visit(has_polyhedron, cells.types)) return;
  std::vector<std::int64_t> types, ends, connectivity;
  append(cells.types, std::int64_t(0), types);
  append(cells.ends, std::int64_t(0), ends);
  append(cells.connectivity, std::int64_t(0), connectivity);
  const PolyhedronFaces faces = read_faces(file, piece, types.size());
  std::vector<std::int64_t> all;
  std::int64_t begin = 0, face_begin = 0;
  for (std::size_t c = 0; c < types.size(); ++c) {
    gale::detail::stop_if_asked_at(static_cast<std::int64_t>(c));
    const bool has_faces = types[c] == cell_type::polyhedron;
    const std::vector<std::int64_t>& from = has_faces ? faces.entries : connectivity;
    const std::int64_t first = has_faces ? face_begin : begin, end = has_faces ? faces.ends[c] : ends[c];
    if (ends[c] < begin || ends[c] > static_cast<std::int64_t>(connectivity.size()))
      damaged("cell ", c, " ends at ", ends[c], " in a connectivity of ", connectivity.size(),
              ", and the one before it at ", begin);
    if (end < first || end > static_cast<std::int64_t>(from.size()))
      damaged("cell ", c, " ends at ", end, " of ", from.size(), (has_faces ? " faces'" : ""),
              " entries, and the one before it at ", first);
    all.insert(all.end(), from.begin() + first, from.begin() + end);
    (has_faces ? face_begin : begin) = end;
    begin = ends[c];
    ends[c] = static_cast<std::int64_t>(all.size());
  }
  cells = {std::move(types), std::move(ends), std::move(all)};
}

}  // namespace

MeshParts read_piece(const XmlFile& file, const XmlElement& piece) {
  MeshParts parts;
  const bool is_surface = file.root.attribute("type") == "PolyData";
  const std::uint64_t points = count_in(piece, "NumberOfPoints"),
                      cells = is_surface ? 0 : count_in(piece, "NumberOfCells");
  if (points > 0) {
    const XmlElement& array = piece.require("Points").require("DataArray");
    if (array.attribute("NumberOfComponents", "3") != "3")
      damaged("its points have ", array.attribute("NumberOfComponents"), " components");
    parts.points = read_array(file, array, 3 * points);
  }
  if (is_surface) parts.cells = read_surface_cells(file, piece);
  if (cells > 0) {
    parts.cells.types = read_cells(file, piece, "types", cells);
    parts.cells.ends = read_cells(file, piece, "offsets", cells);
    parts.cells.connectivity = read_cells(file, piece, "connectivity", std::nullopt);
    take_faces(file, piece, parts.cells);
  }
  XmlArrays data = read_point_data(file, piece, points);
  parts.arrays = std::move(data.arrays);
  parts.notices = std::move(data.notices);
  return parts;
}

std::optional<PointArray::Values> read_cell_array(const XmlFile& file, const XmlElement& piece,
                                                  const std::string& name) {
  const XmlElement* const array = piece.array("CellData", name);
  if (array == nullptr) return std::nullopt;
  return read_array(file, *array, count_in(piece, "NumberOfCells"));
}

std::vector<const XmlElement*> pieces_of(const XmlFile& file) {
  return file.root.require(file.root.attribute("type")).all("Piece");
}

namespace {

/// Whether use(value, place) holds for all values of an array, which are `count` integers in blocks.
template <class Use>
bool all_of_blocks(const XmlFile& file, const XmlElement* array, std::uint64_t count, const Use& use) {
  std::atomic<bool> all{true};
  const auto look = [&](ValueType type, std::uint64_t first, const char* values, std::size_t some) {
    with_type(type, [&](auto example) {
      const auto* const at = reinterpret_cast<const decltype(example)*>(values);
      bool is = std::is_integral_v<decltype(example)>;
      for (std::size_t k = 0; k < some; ++k) is &= use(static_cast<std::int64_t>(at[k]), first + k);
      if (!is) all = false;
    });
  };
  return array != nullptr && use_blocks(file, *array, count, look) && all;
}

template <class Coordinate>
bool read_points(const XmlFile& file, const XmlElement& array, std::uint64_t count, Dataset& mesh) {
  const auto points = allocate<Dataset::Points<Coordinate>>("GALE::points", count);
  mesh.points = points;
  return use_blocks(file, array, 3 * count, [&](ValueType, std::uint64_t first, const char* values, std::size_t some) {
    std::memcpy(points.data() + first, values, some * sizeof(Coordinate));
  });
}

/// Reads tetrahedra, or triangles, whose vertices follow each other, straight to where they stay. False for all else.
template <int Corners, class Simplices>
bool read_simplices(const XmlFile& file, const XmlElement& piece, int type, Simplices& simplices, Dataset& mesh) {
  const std::uint64_t points = count_in(piece, "NumberOfPoints"), cells = count_in(piece, "NumberOfCells");
  constexpr std::uint64_t most_ids = std::numeric_limits<Id>::max();
  const XmlElement* const section = piece.child("Points");
  const XmlElement* const at = section == nullptr ? nullptr : section->child("DataArray");
  if (at == nullptr || cells == 0 || at->attribute("NumberOfComponents", "3") != "3" || points > most_ids ||
      cells > most_ids)
    return false;
  const auto array = [&](const char* name) { return piece.array("Cells", name); };
  if (!all_of_blocks(file, array("types"), cells, [&](std::int64_t one, std::uint64_t) { return one == type; }) ||
      !all_of_blocks(file, array("offsets"), cells,
                     [](std::int64_t end, std::uint64_t k) { return end == std::int64_t(Corners * (k + 1)); }))
    return false;
  simplices = allocate<Simplices>("GALE::simplices", cells);
  const auto keep = [&, to = simplices.data()](std::int64_t point, std::uint64_t k) {
    to[k] = static_cast<Id>(point);
    return std::uint64_t(point) < points;
  };
  if (!all_of_blocks(file, array("connectivity"), Corners * cells, keep)) return false;
  return at->attribute("type") == "Float64"
             ? read_points<double>(file, *at, points, mesh)
             : at->attribute("type") == "Float32" && read_points<float>(file, *at, points, mesh);
}

/// Reads the mesh of a piece of tetrahedra alone, or of triangles alone; nothing for any other piece.
std::optional<Dataset> read_plain(const XmlFile& file, const XmlElement& piece) {
  if (file.root.attribute("type") != "UnstructuredGrid") return std::nullopt;
  const std::uint64_t read_before = file.appended_read;
  Dataset mesh;
  if (!read_simplices<4>(file, piece, cell_type::tetrahedron, mesh.tetrahedra, mesh)) {
    file.appended_read = read_before;
    if (!read_simplices<3>(file, piece, cell_type::triangle, mesh.triangles, mesh)) {
      file.appended_read = read_before;
      return std::nullopt;
    }
  }
  XmlArrays data = read_point_data(file, piece, count_in(piece, "NumberOfPoints"));
  mesh.arrays = std::move(data.arrays);
  mesh.notices = std::move(data.notices);
  return mesh;
}

/// The mesh of all pieces, of that type of file.
Content read_all_pieces(const InputFile& input, const char* type, const ReadOptions& options) {
  const XmlFile file = read_xml(input, type);
  const std::vector<const XmlElement*> pieces = pieces_of(file);
  if (pieces.empty()) throw Error("it has no tetrahedra and no triangles");
  DistinctTexts names;
  for (const XmlElement* const piece : pieces) names.add(names_of_cell_data(*piece));
  const std::vector<std::string> cell_arrays = names.take();
  if (pieces.size() == 1) {
    if (std::optional<Dataset> mesh = read_plain(file, *pieces.front())) {
      if (!cell_arrays.empty()) mesh->notices.push_back(note_cell_arrays(cell_arrays));
      return std::move(*mesh);
    }
  }
  MeshParts parts = read_piece(file, *pieces.front());
  if (pieces.size() > 1) {
    JoinedPieces joined;
    joined.add(std::move(parts));
    for (std::size_t k = 1; k < pieces.size(); ++k) joined.add(read_piece(file, *pieces[k]));
    parts = joined.take();
  }
  if (!cell_arrays.empty()) parts.notices.push_back(note_cell_arrays(cell_arrays));
  return to_mesh(parts, options);
}

}  // namespace

Content read_vtu(const InputFile& input, const ReadOptions& options) {
  return read_all_pieces(input, "UnstructuredGrid", options);
}

Content read_vtp(const InputFile& input, const ReadOptions& options) {
  return read_all_pieces(input, "PolyData", options);
}

}  // namespace gale::io::detail
