#pragma once

#include <optional>

#include <vtkSmartPointer.h>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/mesh/segmentation.hpp>
#include <gale/outputs/analyses.hpp>

class vtkAlgorithm;
class vtkDataArray;
class vtkDataSet;
class vtkInformationVector;
class vtkUnstructuredGrid;

namespace gale::vtk {

/// Thrown where somebody aborts a filter.
struct Aborted {};

/// What a filter's properties say of its input.
struct InputOptions {
  int threads = 0;  ///< 0: as many as there are cores
  int capacity = default_capacity;
  std::optional<double> above;  ///< of voxels
};

/// One execution of a filter: its input as GALE has it, and how it tells how far it is. To be used by the thread that
/// made it alone.
class Run {
 public:
  /// `field` is an array of the input's points, or nullptr. Throws gale::Error for an input that is no mesh, and
  /// Aborted.
  Run(vtkAlgorithm& filter, vtkDataSet* input, vtkDataArray* field, const InputOptions& options);

  /// The input, or the tetrahedra of the voxels with their point arrays.
  vtkUnstructuredGrid* grid() const { return grid_; }

  const Mesh& mesh() const { return *mesh_; }

  /// Runs an analysis on the field, along the order of its values, or that of the array NAME_Order, and gives its
  /// results to the outputs in their order. Sweeps tell the filter's progress, with a text of what is done, and throw
  /// Aborted once the filter is to abort. Throws gale::Error if there is no field, or if it isn't of one number a
  /// point.
  void analyse(const char* analysis, const outputs::Settings& settings, vtkInformationVector* outputs) const;

  /// Gives the mesh, with these arrays at its points, to an output.
  void give(const std::vector<io::PointArray>& arrays, vtkInformationVector* outputs, int port) const;

 private:
  io::PointArray field() const;
  VertexOrder order(const io::PointArray& field) const;
  ComputeOptions compute(const char* text, double begin, double end) const;
  void tell(double progress, const char* text) const;

  vtkAlgorithm& filter_;
  int threads_;
  ThreadLimit limit_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  vtkSmartPointer<vtkDataArray> field_;
  io::Dataset dataset_;
  std::optional<Mesh> mesh_;
};

}  // namespace gale::vtk
