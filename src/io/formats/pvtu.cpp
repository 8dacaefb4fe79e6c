#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <unordered_map>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/volume.hpp>
#include <gale/io/formats/xml_file.hpp>

namespace gale::io::detail {
namespace {

using Ids = std::vector<std::int64_t>;

/// The key by which points of several pieces are one point: a global id, or all three coordinates.
using Key = std::array<std::uint64_t, 3>;

struct HashOfKey {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : key) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

std::uint64_t bits_of(double coordinate) {
  coordinate += 0.0;  // 0 and -0 are one
  std::uint64_t bits;
  std::memcpy(&bits, &coordinate, sizeof bits);
  return bits;
}

/// The global ids that an array gives points or cells, `of_what`. Throws gale::Error for one that ranks can't number
/// by.
Ids to_ids(const PointArray::Values& values, const std::string& name, const std::string& of_what) {
  return std::visit(
      [&](const auto& all) {
        if (!std::is_integral_v<typename std::decay_t<decltype(all)>::value_type>)
          damaged("its global ids '", printable(name), "' are no whole numbers");
        constexpr std::int64_t greatest = (std::int64_t(1) << 62) - 1;
        Ids ids(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
          ids[i] = static_cast<std::int64_t>(all[i]);  // what lies beyond, in 64 bits without a sign, becomes negative
          if (ids[i] >= 0 && ids[i] <= greatest) continue;
          refuse("the array '", printable(name), "' gives ", of_what, " ", i, " the id ", all[i],
                 ", which is none: ids are 0 to ", greatest);
        }
        return ids;
      },
      values);
}

Ids ids_of_points(const MeshParts& piece, const std::string& name) {
  for (const PointArray& array : piece.arrays) {
    if (array.name != name) continue;
    if (array.components != 1) damaged("its global ids '", printable(name), "' have several components");
    return to_ids(array.values, name, "point");
  }
  damaged("it has no global ids '", printable(name), "'");
}

/// All three coordinates of each point.
std::vector<Key> coordinates_of(const MeshParts& piece) {
  std::vector<Key> keys(count_of(piece.points) / 3);
  std::visit(
      [&](const auto& xyz) {
        for (std::size_t i = 0; i < 3 * keys.size(); ++i) keys[i / 3][i % 3] = bits_of(static_cast<double>(xyz[i]));
      },
      piece.points);
  return keys;
}

/// One of the pieces as its file has it.
struct FilePiece {
  MeshParts parts;
  std::optional<PointArray::Values> ghosts;  ///< the array that says which cells are ghosts
  Ids cell_ids;                              ///< empty without ids
};

/// The joined pieces and their ids: of points, each once, and of cells that are no ghosts.
struct JoinedWithIds {
  MeshParts parts;
  Ids point_ids, cell_ids;
};

/// Pieces that share points and, as ghosts, cells.
class SharedPieces {
 public:
  explicit SharedPieces(const PieceNames& names) : names_(names) {}

  void add(FilePiece piece) {
    MeshParts& parts = piece.parts;
    drop_ghosts(parts.arrays);
    const std::size_t before = joined_.points();
    Ids fresh;  // the points that no piece before has
    const Ids places = place_points(parts, before, fresh);
    parts.cells = numbered_cells(parts.cells, places, piece);
    if (fresh.size() < places.size()) {
      const PointArray points = gather(PointArray{"", 3, std::move(parts.points)}, fresh);
      parts.points = points.values;
      for (PointArray& array : parts.arrays) array = gather(array, fresh);
    }
    joined_.add_numbered(std::move(parts), !places.empty());
  }

  /// Points and cells are in the order of their ids, so that no result depends on how they were dealt out to pieces.
  /// The array of the points' ids comes last: it is no field that one looks at.
  JoinedWithIds take() {
    JoinedWithIds all{joined_.take(), std::move(point_ids_), std::move(cell_ids_)};
    number_points(all.point_ids, all.parts);
    number_cells(all.cell_ids, all.parts.cells);
    auto& arrays = all.parts.arrays;
    std::stable_partition(arrays.begin(), arrays.end(),
                          [&](const PointArray& array) { return array.name != names_.point_ids; });
    return all;
  }

 private:
  /// Drops the array that says which points other pieces have: it is true of none any more.
  static void drop_ghosts(std::vector<PointArray>& arrays) {
    const auto is_ghosts = [](const PointArray& array) { return array.name == ghost_array; };
    arrays.erase(std::remove_if(arrays.begin(), arrays.end(), is_ghosts), arrays.end());
  }

  Ids place_points(const MeshParts& piece, std::size_t before, Ids& fresh) {
    const std::size_t points = count_of(piece.points) / 3;
    for (const PointArray& array : piece.arrays) require_size(array, points);
    Ids places(points);
    const auto place_all = [&](const auto& keys, auto& place_of) {
      for (std::size_t i = 0; i < points; ++i) {
        gale::detail::stop_if_asked_at(static_cast<std::int64_t>(i));
        const auto [found, is_new] = place_of.emplace(keys[i], static_cast<std::int64_t>(before + fresh.size()));
        if (is_new) fresh.push_back(static_cast<std::int64_t>(i));
        places[i] = found->second;
      }
    };
    if (names_.point_ids.empty()) {
      place_all(coordinates_of(piece), place_of_coordinates_);
    } else if (points > 0) {
      const Ids ids = ids_of_points(piece, names_.point_ids);
      place_all(ids, place_of_id_);
      for (const std::int64_t i : fresh) point_ids_.push_back(ids[i]);
    }
    return places;
  }

  /// The cells that are no ghosts, with the joined points' numbers.
  FileCells numbered_cells(const FileCells& cells, const Ids& places, const FilePiece& piece) {
    Ids types, ends, connectivity, is_ghost;
    append(cells.types, std::int64_t(0), types);
    append(cells.ends, std::int64_t(0), ends);
    append(cells.connectivity, std::int64_t(0), connectivity);
    if (piece.ghosts) append(*piece.ghosts, std::int64_t(0), is_ghost);
    for_each_point(types, ends, 0, connectivity,
                   [&](std::size_t c, std::int64_t& point) { point = place(places, point, c); });
    Ids kept_types, kept_ends, kept_points;
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      gale::detail::stop_if_asked_at(static_cast<std::int64_t>(c));
      if (ends[c] < begin || ends[c] > static_cast<std::int64_t>(connectivity.size()))
        damaged("cell ", c, " ends at ", ends[c], " in a connectivity of ", connectivity.size(),
                ", and the one before it at ", begin);
      if (is_ghost.empty() || (is_ghost[c] & has_other_piece) == 0) {
        kept_points.insert(kept_points.end(), connectivity.begin() + begin, connectivity.begin() + ends[c]);
        kept_types.push_back(types[c]);
        kept_ends.push_back(static_cast<std::int64_t>(kept_points.size()));
        if (!piece.cell_ids.empty()) cell_ids_.push_back(piece.cell_ids[c]);
      }
      begin = ends[c];
    }
    return {std::move(kept_types), std::move(kept_ends), std::move(kept_points)};
  }

  static std::int64_t place(const Ids& places, std::int64_t point, std::size_t cell) {
    if (point >= 0 && point < static_cast<std::int64_t>(places.size())) return places[static_cast<std::size_t>(point)];
    refuse("cell ", cell, " names point ", point, " of ", places.size());
  }

  const PieceNames& names_;
  JoinedPieces joined_;
  std::unordered_map<Key, std::int64_t, HashOfKey> place_of_coordinates_;
  std::unordered_map<std::int64_t, std::int64_t> place_of_id_;
  Ids point_ids_, cell_ids_;  ///< the ids of the joined ones
};

/// The global ids of cells; empty if nothing names them.
Ids ids_of_cells(const XmlFile& file, const XmlElement& piece, std::size_t cells, const std::string& name) {
  if (name.empty() || cells == 0) return {};
  const auto values = read_cell_array(file, piece, name);
  if (!values) damaged("it has no global ids '", printable(name), "' of cells");
  return to_ids(*values, name, "cell");
}

/// Adds a piece's file, and what its cell arrays are called.
void add_file(const InputFile& input, const PieceNames& names, SharedPieces& shared, DistinctTexts& cell_arrays) {
  const XmlFile file = read_xml(input, "UnstructuredGrid", names.cell_ids);
  for (const XmlElement* element : pieces_of(file)) {
    FilePiece piece{read_piece(file, *element), read_cell_array(file, *element, ghost_array), {}};
    piece.cell_ids = ids_of_cells(file, *element, count_of(piece.parts.cells.types), names.cell_ids);
    shared.add(std::move(piece));
    cell_arrays.add(names_of_cell_data(*element));
  }
}

/// The names of its pieces' files. Who reads some of them alone sees here that none is named twice.
std::vector<std::string> sources_of(const XmlElement& grid) {
  std::vector<std::string> sources;
  std::set<std::filesystem::path> paths;
  for (const XmlElement* const piece : grid.all("Piece")) {
    sources.push_back(piece->attribute("Source"));
    if (sources.back().empty()) damaged("one of its pieces has no Source");
    if (!paths.insert(std::filesystem::path(sources.back()).lexically_normal()).second)
      refuse("it names the piece '", printable(sources.back()), "' twice");
  }
  return sources;
}

/// The name that a section has for its array of ids.
std::string name_of_ids(const XmlElement& grid, const char* section) {
  const XmlElement* const arrays = grid.child(section);
  return arrays != nullptr ? arrays->attribute("GlobalIds") : "";
}

JoinedWithIds join(const InputFile& input, const PieceNames& names, const ReadOptions& options) {
  SharedPieces shared(names);
  DistinctTexts names_of_arrays;
  DistinctFiles files;
  for (const std::string& source : names.sources) {
    const std::string path = path_of_data(input.path(), source, options);
    try {
      const InputFile piece(path);
      files.add(piece, source);
      add_file(piece, names, shared, names_of_arrays);
    } catch (const Error& error) {
      refuse("its piece '", printable(source), "': ", error.what());
    }
  }
  JoinedWithIds all = shared.take();
  std::vector<std::string> cell_arrays = names_of_arrays.take();
  for (const std::string& used : {std::string(ghost_array), names.cell_ids})
    cell_arrays.erase(std::remove(cell_arrays.begin(), cell_arrays.end(), used), cell_arrays.end());
  if (!cell_arrays.empty()) all.parts.notices.push_back(note_cell_arrays(cell_arrays));
  return all;
}

}  // namespace

PieceNames names_of_pieces(const InputFile& input) {
  const XmlFile file = read_xml(input, "PUnstructuredGrid");
  const XmlElement& grid = file.root.require("PUnstructuredGrid");
  return {sources_of(grid), name_of_ids(grid, "PPointData"), name_of_ids(grid, "PCellData")};
}

Content read_pvtu(const InputFile& input, const ReadOptions& options) {
  MeshParts parts = join(input, names_of_pieces(input), options).parts;
  return to_mesh(parts, options);
}

SomePieces read_some_pieces(const InputFile& input, const PieceNames& some, const ReadOptions& options) {
  JoinedWithIds all = join(input, some, options);
  const auto taken = [](PointArray::Values& values) { return std::get<Ids>(std::move(values)); };
  FileCells& cells = all.parts.cells;
  return {to_points_alone(all.parts), taken(cells.types),       taken(cells.ends),
          taken(cells.connectivity),  std::move(all.point_ids), std::move(all.cell_ids)};
}

}  // namespace gale::io::detail
