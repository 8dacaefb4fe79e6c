#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <gale/io/read.hpp>
#include <gale/mesh/mesh.hpp>

#include "arrays.hpp"
#include "process.hpp"

namespace gale::python {

/// What options of an analysis are given, by their names: flags, thresholds (values, and whether they are in percent of
/// the field's range), choices and numbers.
using GivenOptions = std::tuple<std::map<std::string, bool>, std::map<std::string, std::pair<double, bool>>,
                                std::map<std::string, std::string>, std::map<std::string, int>>;

/// A mesh and its points.
class PyMesh : public Kept {
 public:
  /// Copies the arrays; cells before it checks them.
  PyMesh(Array1 points, Array1 cells, int capacity);

  PyMesh(io::Dataset::Positions points, const Mesh& mesh, int capacity);

  /// Makes the mesh that a file has, unless `like`, which may be null, has it already; shares its points.
  PyMesh(const io::Dataset& dataset, int capacity, const PyMesh* like);

  void end() override {
    mesh_.reset();
    dataset_ = {};
  }

  Id vertices() const { return mesh().vertices(); }
  int dimension() const { return mesh().dimension(); }
  Id cells() const { return mesh().cells(); }
  Id segments() const { return mesh().segments(); }
  int capacity() const { return capacity_; }
  nb::object points() const;

  /// The cube, or square, of the whole grid that each cell of a grid is of; None of other meshes.
  nb::object cubes() const;

  /// (where rows begin, their entries, how many simplices the entries are among)
  nb::tuple relation(const std::string& name, int threads, const nb::object& progress) const;

  /// What an analysis of outputs/analyses.hpp finds, by the names of its results, and a "note" where `order`, the
  /// places of vertices, contradicts the field.
  nb::dict analyse(const std::string& analysis, Array1 field, const std::string& name, const GivenOptions& given,
                   int threads, const nb::object& progress, const std::optional<Array1>& order) const;

  const Mesh& mesh() const;

  /// The points, which this mesh goes on owning, with the field as their array.
  io::Dataset with(io::PointArray field) const;

 private:
  int capacity_;
  io::Dataset dataset_;  ///< the points alone
  std::optional<Mesh> mesh_;
};

/// (the mesh of cells of any types of VTK's, the cell of each tetrahedron or triangle, or None where all are, what was
/// split and left out)
nb::tuple from_cells(Array1 points, Array1 connectivity, Array1 offsets, Array1 types, int capacity);

/// The grid of so many points along each axis, which are these, x fastest.
nb::object from_grid(Array1 points, Id nx, Id ny, Id nz, int capacity);

/// (time, path, its place among the times of that file or None) of each step that inputs are
nb::list steps_of(const std::vector<nb::bytes>& inputs, bool outside_files);

/// (the mesh that a file has, or shares with `like`, its point arrays, arrays of its cells, what of it was split and
/// left out)
nb::tuple read(const nb::bytes& path, std::optional<double> above, const std::string& array, bool tetrahedra_alone,
               bool outside_files, int capacity, const PyMesh* like, std::optional<std::uint64_t> time);

}  // namespace gale::python
