#include <array>
#include <cstring>
#include <optional>
#include <unordered_map>

#include <gale/io/arrays.hpp>
#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/value_type.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/formats/readers.hpp>
#include <gale/io/formats/volume.hpp>
#include <gale/io/formats/vtu.hpp>

namespace gale::io::detail {

namespace {

constexpr std::uint8_t has_other_piece = 1;  // of vtkGhostType

/// What points of several pieces have in common that are one point: a global id, or all three coordinates.
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

/// By the point array of that name, or by coordinates if there is no name.
std::vector<Key> keys_of(const MeshParts& piece, const std::string& global_ids) {
  const std::size_t points = count_of(piece.points) / 3;
  std::vector<Key> keys(points);
  if (global_ids.empty()) {
    std::visit(
        [&](const auto& xyz) {
          for (std::size_t i = 0; i < 3 * points; ++i) keys[i / 3][i % 3] = bits_of(static_cast<double>(xyz[i]));
        },
        piece.points);
    return keys;
  }
  for (const PointArray& array : piece.arrays) {
    if (array.name != global_ids) continue;
    if (array.components != 1) damaged("its global ids '" + printable(global_ids) + "' have several components");
    std::visit(
        [&](const auto& ids) {
          if (!std::is_integral_v<typename std::decay_t<decltype(ids)>::value_type>)
            damaged("its global ids '" + printable(global_ids) + "' are no whole numbers");
          for (std::size_t i = 0; i < points; ++i) keys[i] = {static_cast<std::uint64_t>(ids[i]), 0, 0};
        },
        array.values);
    return keys;
  }
  damaged("it has no global ids '" + printable(global_ids) + "'");
}

/// Pieces that share points and, as ghosts, cells.
class SharedPieces {
 public:
  explicit SharedPieces(std::string global_ids) : global_ids_(std::move(global_ids)) {}

  void add(MeshParts piece, const std::optional<PointArray::Values>& ghosts) {
    const std::size_t before = joined_.points();
    std::vector<std::int64_t> fresh;  // of its points, those that no piece before has
    const std::vector<std::int64_t> places = place_points(piece, before, fresh);
    piece.cells = numbered_cells(piece.cells, places, ghosts);
    if (fresh.size() < places.size()) {
      const PointArray points = gather(PointArray{"", 3, std::move(piece.points)}, fresh);
      piece.points = points.values;
      for (PointArray& array : piece.arrays) array = gather(array, fresh);
    }
    joined_.add_numbered(std::move(piece));
  }

  MeshParts take() { return joined_.take(); }

 private:
  std::vector<std::int64_t> place_points(const MeshParts& piece, std::size_t before, std::vector<std::int64_t>& fresh) {
    const std::size_t points = count_of(piece.points) / 3;
    for (const PointArray& array : piece.arrays) require_size(array, points);
    const std::vector<Key> keys = points > 0 ? keys_of(piece, global_ids_) : std::vector<Key>();
    std::vector<std::int64_t> places(points);
    for (std::size_t i = 0; i < points; ++i) {
      const auto [found, is_new] = place_of_.emplace(keys[i], static_cast<std::int64_t>(before + fresh.size()));
      if (is_new) fresh.push_back(static_cast<std::int64_t>(i));
      places[i] = found->second;
    }
    return places;
  }

  /// The cells that are no ghosts, with the joined points' numbers.
  static Cells numbered_cells(const Cells& cells, const std::vector<std::int64_t>& places,
                              const std::optional<PointArray::Values>& ghosts) {
    std::vector<std::int64_t> types, ends, connectivity, is_ghost;
    append(cells.types, std::int64_t(0), types);
    append(cells.ends, std::int64_t(0), ends);
    append(cells.connectivity, std::int64_t(0), connectivity);
    if (ghosts) append(*ghosts, std::int64_t(0), is_ghost);
    std::vector<std::int64_t> kept_types, kept_ends, kept_points;
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      if (ends[c] < begin || ends[c] > static_cast<std::int64_t>(connectivity.size())) {
        damaged("cell " + std::to_string(c) + " ends at " + std::to_string(ends[c]) + " in a connectivity of " +
                std::to_string(connectivity.size()) + ", and the one before it at " + std::to_string(begin));
      }
      if (is_ghost.empty() || (is_ghost[c] & has_other_piece) == 0) {
        for (std::int64_t k = begin; k < ends[c]; ++k) kept_points.push_back(place(places, connectivity[k], c));
        kept_types.push_back(types[c]);
        kept_ends.push_back(static_cast<std::int64_t>(kept_points.size()));
      }
      begin = ends[c];
    }
    return {std::move(kept_types), std::move(kept_ends), std::move(kept_points)};
  }

  static std::int64_t place(const std::vector<std::int64_t>& places, std::int64_t point, std::size_t cell) {
    if (point >= 0 && point < static_cast<std::int64_t>(places.size())) return places[static_cast<std::size_t>(point)];
    throw Error("cell " + std::to_string(cell) + " names point " + std::to_string(point) + " of " +
                std::to_string(places.size()));
  }

  std::string global_ids_;
  JoinedPieces joined_;
  std::unordered_map<Key, std::int64_t, HashOfKey> place_of_;
};

/// Adds a piece's file, and says what its cell arrays are called.
std::vector<std::string> add_file(const std::string& path, SharedPieces& shared) {
  std::vector<std::string> cell_arrays;
  const InputFile input(path);
  const XmlFile file = read_xml(input, "UnstructuredGrid");
  for (const XmlElement* piece : pieces_of(file)) {
    shared.add(read_piece(file, *piece), read_ghosts(file, *piece));
    if (cell_arrays.empty()) cell_arrays = names_of_cell_data(*piece);
  }
  return cell_arrays;
}

/// The names of its pieces' files.
std::vector<std::string> sources_of(const XmlElement& grid) {
  std::vector<std::string> sources;
  for (const XmlElement& piece : grid.children) {
    if (piece.name != "Piece") continue;
    sources.push_back(piece.attribute("Source"));
    if (sources.back().empty()) damaged("one of its pieces has no Source");
  }
  return sources;
}

}  // namespace

PieceNames names_of_pieces(const InputFile& input) {
  const XmlFile file = read_xml(input, "PUnstructuredGrid");
  const XmlElement& grid = file.root.require("PUnstructuredGrid");
  const XmlElement* const arrays = grid.child("PPointData");
  return {sources_of(grid), arrays != nullptr ? arrays->attribute("GlobalIds") : ""};
}

MeshParts read_pieces(const InputFile& input, const PieceNames& names, const ReadOptions& options) {
  SharedPieces shared(names.global_ids);
  std::vector<std::string> cell_arrays;
  for (const std::string& source : names.sources) {
    const std::string path = path_of_data(input.path(), source, options);
    try {
      const std::vector<std::string> found = add_file(path, shared);
      if (cell_arrays.empty()) cell_arrays = found;
    } catch (const Error& error) {
      throw Error("its piece '" + printable(source) + "': " + error.what());
    }
  }
  MeshParts parts = shared.take();
  for (auto name = cell_arrays.begin(); name != cell_arrays.end();)
    name = *name == ghost_array ? cell_arrays.erase(name) : name + 1;
  if (!cell_arrays.empty()) parts.notices.push_back(note_cell_arrays(cell_arrays));
  return parts;
}

Content read_pvtu(const InputFile& input, const ReadOptions& options) {
  MeshParts parts = read_pieces(input, names_of_pieces(input), options);
  return to_mesh(parts, options.tetrahedralize);
}

Dataset read_some_pieces(const InputFile& input, const PieceNames& some, const ReadOptions& options) {
  MeshParts parts = read_pieces(input, some, options);
  return to_mesh(parts, options.tetrahedralize, true);
}

}  // namespace gale::io::detail
