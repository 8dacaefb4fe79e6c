#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gale/io/bytes/input_file.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/read.hpp>

/// VTK's XML files: a tree of elements, whose arrays hold their values in themselves, as text or base64, or behind the
/// tree, as base64 or raw.
namespace gale::io::detail {

/// The array in which VTK's writers say of each cell, and of each point, by a bit whether another piece has it, too.
inline constexpr char ghost_array[] = "vtkGhostType";
inline constexpr std::uint8_t has_other_piece = 1;

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;
  std::string text;  ///< what arrays of points and cells have, of ghosts, and what else read_xml() was told of

  /// The attribute's value, or `otherwise`.
  std::string attribute(const std::string& key, const std::string& otherwise = "") const;

  /// A whole number, 0 or more. Throws gale::Error if it isn't there or isn't one.
  std::uint64_t number(const std::string& key) const;

  /// The first child of that name, or nullptr.
  const XmlElement* child(const std::string& name) const;

  /// The first child of that name. Throws gale::Error if there is none.
  const XmlElement& require(const std::string& name) const;

  /// All children of that name.
  std::vector<const XmlElement*> all(const std::string& name) const;

  /// The array of that name in the child `section`, or nullptr.
  const XmlElement* array(const std::string& section, const std::string& name) const;
};

struct XmlFile {
  const InputFile& file;
  XmlElement root;
  std::uint64_t appended_begin = 0;  ///< in the file, of what is behind the tree; 0 if nothing is
  bool appended_is_raw = false;

  // What the root says.
  ByteOrder order = byte_order_of_machine();
  std::size_t header_bytes = 4;  ///< the size of numbers that say how long an array is
  std::string compressor{};      ///< VTK's class, or empty

  /// Bytes so far: arrays that lie on each other would make them more than there are.
  mutable std::uint64_t appended_read = 0;
};

/// Reads the tree, of which `type` must be the root's, and the cell array of that name. Throws gale::Error for a file
/// that isn't well-formed, nested too deeply, of too many elements, or of another type. The file must outlive what is
/// returned.
XmlFile read_xml(const InputFile& file, const std::string& type, const std::string& cell_array = "");

/// Reads the tree up to what is appended; the file's part of read_xml(). Through expat, which comes with VTK.
void read_tree(XmlFile& to, const std::string& cell_array);

/// The values of an array: `count` of them, or all that it has. Throws gale::Error if it has less, or they are damaged.
PointArray::Values read_array(const XmlFile& file, const XmlElement& array, std::optional<std::uint64_t> count);

/// Takes values of an array: so many, from the place `first` on.
using UseBlock = std::function<void(ValueType type, std::uint64_t first, const char* values, std::size_t count)>;

/// Gives all `count` values of an array to use(), which any number of threads may call, in any order: nothing keeps
/// them. False, and nothing is done, for an array that isn't in many compressed blocks behind the tree, or has another
/// number of values. Throws gale::Error if one is damaged, and what use() throws.
bool use_blocks(const XmlFile& file, const XmlElement& array, std::uint64_t count, const UseBlock& use);

/// The arrays of a PointData element, of `points` points each, the active scalars first, global ids last; a notice
/// about each whose values are no numbers.
struct XmlArrays {
  std::vector<PointArray> arrays;
  std::vector<std::string> notices;
};
XmlArrays read_point_data(const XmlFile& file, const XmlElement& piece, std::uint64_t points);

/// The names of a piece's cell arrays.
std::vector<std::string> names_of_cell_data(const XmlElement& piece);

// Common parts of `.vtu` and of the `.pvtu` that names several of them.

/// The pieces of a `.vtu` or `.vtp`.
std::vector<const XmlElement*> pieces_of(const XmlFile& file);

/// Points, cells and point arrays of one of them. Throws gale::Error for what the file lacks.
MeshParts read_piece(const XmlFile& file, const XmlElement& piece);

/// The values of a cell array of one component, which read_xml() was told of. Nothing if there is no such array.
std::optional<PointArray::Values> read_cell_array(const XmlFile& file, const XmlElement& piece,
                                                  const std::string& name);

/// The pieces that a `.pvtu` names, and some of these as one mesh, which may be empty.
PieceNames names_of_pieces(const InputFile& input);
SomePieces read_some_pieces(const InputFile& input, const PieceNames& some, const ReadOptions& options);

}  // namespace gale::io::detail
