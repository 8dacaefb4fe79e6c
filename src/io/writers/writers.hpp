#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gale/io/atomic_file.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/write.hpp>
#include <gale/mesh/cells/cell_types.hpp>

/// How files are written: what stands in them first, of arrays that aren't copied, then that in VTK's XML or in its
/// legacy form. All write to the temporary file of another, whatever its name, and throw gale::Error without the path.
namespace gale::io::detail {

/// An array on its way into a file. Its values stay where they are, or are made when they are asked for.
struct WrittenArray {
  std::string name;
  int components;
  ValueType type;
  std::uint64_t count;  ///< values, not rows

  /// Puts the values [begin, end) to `to`, in this machine's order of bytes. Any number of threads may call it.
  std::function<void(std::uint64_t begin, std::uint64_t end, char* to)> copy;

  const char* values = nullptr;  ///< all of them, where they lie in memory
};

using WrittenArrays = std::vector<WrittenArray>;

/// The coordinates, which outlive it.
WrittenArray written(const Dataset::Positions& points);

/// All arrays, which outlive it. The later of two with one name takes the place of the earlier. One without a name is
/// called "unnamed", as VTK reads no other.
WrittenArrays written(const std::vector<PointArray>& arrays, const std::vector<PointArray>& more = {});

/// Puts values one after the other, as T. To be passed on by value: a pointer elsewhere would be read again for each.
template <class T>
struct PutInOrder {
  char* to;

  template <class Value>
  void operator()(Value value) {
    const T made = static_cast<T>(value);
    std::memcpy(to, &made, sizeof(T));
    to += sizeof(T);
  }
};

/// An array whose values [begin, end) are put one after the other by each(begin, end, put).
template <class T, class Each>
WrittenArray made_in_order(const std::string& name, std::uint64_t count, const Each& each) {
  return {name, 1, value_type_of<T>(), count,
          [each](std::uint64_t begin, std::uint64_t end, char* to) { each(begin, end, PutInOrder<T>{to}); }};
}

/// An array whose k-th value is value(k).
template <class T, class Value>
WrittenArray made(const std::string& name, std::uint64_t count, const Value& value) {
  return made_in_order<T>(name, count, [value](std::uint64_t begin, std::uint64_t end, auto put) {
    for (std::uint64_t k = begin; k < end; ++k) put(value(k));
  });
}

/// An array of integers, in the narrower of two types that holds values of up to `most`.
template <class Value>
WrittenArray made_integers(const std::string& name, std::uint64_t count, std::uint64_t most, const Value& value) {
  return most <= std::numeric_limits<std::int32_t>::max() ? made<std::int32_t>(name, count, value)
                                                          : made<std::int64_t>(name, count, value);
}

/// The content of one of VTK's XML files.
struct XmlContent {
  struct Section {
    std::string name;  ///< e.g. "PointData"
    WrittenArrays arrays;
    std::string global_ids{};  ///< the one of the arrays that has global ids, where there is one
  };

  std::string type;                                          ///< e.g. "UnstructuredGrid"
  std::vector<std::pair<std::string, std::uint64_t>> sizes;  ///< e.g. "NumberOfPoints"
  std::vector<Section> sections;
};

/// The content of a file of points, of lines and polygons, of a mesh with the arrays `more` behind its own, of such a
/// mesh of triangles as a surface, of lines alone. What it is made of outlives it, and is consistent: io::write_mesh
/// and the others see to that.
XmlContent content_of(const PointSet& points);
XmlContent content_of(const Surface& surface);
XmlContent content_of(const Dataset& mesh, const std::vector<PointArray>& more,
                      const std::vector<PointArray>& cell_arrays = {});
XmlContent content_of_triangles(const Dataset& mesh, const std::vector<PointArray>& more,
                                const std::vector<PointArray>& cell_arrays);
XmlContent content_of_lines(const Surface& lines);

/// The simplices of a mesh, which outlives it, wherever they come from: how many, of so many corners and that type of
/// VTK's.
struct WrittenCells {
  explicit WrittenCells(const Dataset& mesh)
      : count(mesh.cells()),
        corners(mesh.dimension() == 3 ? 4 : 3),
        type(mesh.dimension() == 3 ? cell_type::tetrahedron : cell_type::triangle),
        grid_(mesh.grid ? mesh.grid->in<HostMemory>() : GridView()),
        vertices_(mesh.grid               ? nullptr
                  : mesh.dimension() == 3 ? mesh.tetrahedra.data()
                                          : mesh.triangles.data()) {}

  std::uint64_t count, corners;
  int type;

  /// Their vertices, those of a grid's as they are asked for.
  template <class T>
  WrittenArray connectivity(const std::string& name) const {
    return made_in_order<T>(name, corners * count, [cells = *this](std::uint64_t begin, std::uint64_t end, auto put) {
      cells.each_corner(begin, end, put);
    });
  }

 private:
  template <class Put>
  void each_corner(std::uint64_t begin, std::uint64_t end, Put put) const {
    if (vertices_ != nullptr) {
      for (std::uint64_t k = begin; k < end; ++k) put(vertices_[k]);
      return;
    }
    const auto in_cube = static_cast<std::uint64_t>(grid_.cells_per_cube());
    for (std::uint64_t at = begin; at < end;) {
      const std::uint64_t cube = at / corners / in_cube;
      const Quad of_cube = grid_.corners_of_cube(static_cast<Id>(cube));
      constexpr std::uint64_t whole = 6 * 4;  // of tetrahedra, whose loops are unrolled
      if (in_cube * corners == whole && at % whole == 0 && end - at >= whole) {
        for (int i = 0; i < 6; ++i) {
          const Quad cell = grid_.cell_of_cube(of_cube, i);
          for (int k = 0; k < 4; ++k) put(cell[k]);
        }
        at += whole;
        continue;
      }
      for (const std::uint64_t last = std::min(end, (cube + 1) * in_cube * corners); at < last;) {
        const Quad cell = grid_.cell_of_cube(of_cube, static_cast<int>(at / corners % in_cube));
        for (auto k = at % corners; k < corners && at < last; ++k, ++at) put(cell[static_cast<int>(k)]);
      }
    }
  }

  GridView grid_;
  const std::int32_t* vertices_;  ///< null where they are a grid's
};

/// Writes it, its arrays in the encoding of `to`, compressed where can_compress(): block by block, so that it takes
/// little memory, and on as many threads as loops take.
void write_xml(const AtomicFile& to, const XmlContent& content);

/// Writes it as VTKHDF, likewise compressed in chunks: by no library, as a file that is written once needs little of
/// HDF5. Throws gale::Error for an array whose name has a '/', which HDF5 hasn't.
void write_vtkhdf(const AtomicFile& to, const XmlContent& content);

/// Writes the names of files, each of which has what `like` has, with other values.
void write_xml_pieces(const AtomicFile& to, const std::vector<std::string>& pieces, const XmlContent& like);

/// Writes the names of files, each with its time, as XML or as JSON.
void write_xml_series(const AtomicFile& to, const std::vector<Step>& steps);
void write_file_series(const AtomicFile& to, const std::vector<Step>& steps);

/// Writes a legacy file, binary, of the version 5.1.
void write_legacy_vtk(const AtomicFile& to, const Dataset& mesh, const std::vector<PointArray>& more);

}  // namespace gale::io::detail
