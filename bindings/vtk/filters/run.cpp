#include "run.hpp"

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/outputs/field.hpp>

#include "arrays.hpp"
#include "grid.hpp"
#include "voxels.hpp"

namespace gale::vtk {

Run::Run(vtkAlgorithm& filter, vtkDataSet* input, vtkDataArray* field, const InputOptions& options)
    : filter_(filter),
      threads_(options.threads > 0 ? options.threads : host_threads()),
      limit_(threads_),
      grid_(vtkUnstructuredGrid::SafeDownCast(input)),
      field_(field) {
  if (!grid_) {
    tell(0, "Splitting voxels");
    grid_ = split_voxels(input, field, options.above);
    field_ = grid_->GetPointData()->GetArray(0);
  }
  tell(0, "Dividing the mesh into segments");
  dataset_.points = positions_of(grid_);
  mesh_ = mesh_of(grid_, dataset_.points, options.capacity);
}

io::PointArray Run::field() const {
  if (!field_) throw Error("no point array to analyse: set the array to process, or make one the active scalars");
  const io::PointArray field = point_array(field_);
  if (field.components != 1)
    throw Error("array '" + field.name + "' has " + std::to_string(field.components) + " components, not 1");
  return field;
}

VertexOrder Run::order(const io::PointArray& field) const {
  io::Dataset dataset;
  vtkDataArray* const order = grid_->GetPointData()->GetArray((field.name + "_Order").c_str());
  if (order != nullptr) dataset.arrays.push_back(point_array(order));
  return outputs::order_of(mesh(), dataset, field);
}

void Run::tell(double progress, const char* text) const {
  filter_.SetProgressText(text);
  filter_.UpdateProgress(progress);
  if (filter_.GetAbortExecute() != 0) throw Aborted();
}

ComputeOptions Run::compute(const char* text, double begin, double end) const {
  tell(begin, text);
  ComputeOptions options;
  options.threads = threads_;
  options.progress = [this, begin, end](Id done, Id segments) {
    filter_.UpdateProgress(begin + (end - begin) * done / segments);
    if (filter_.GetAbortExecute() != 0) throw Aborted();
  };
  return options;
}

}  // namespace gale::vtk
