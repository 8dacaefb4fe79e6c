#include "run.hpp"

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/outputs/field.hpp>

#include "arrays.hpp"
#include "grid.hpp"
#include "image.hpp"

namespace gale::vtk {

Run::Run(vtkAlgorithm& filter, vtkDataSet* input, vtkDataArray* field, const InputOptions& options)
    : filter_(filter),
      threads_(options.threads > 0 ? options.threads : host_threads()),
      limit_(threads_),
      grid_(vtkUnstructuredGrid::SafeDownCast(input)),
      field_(field) {
  if (auto* const image = vtkImageData::SafeDownCast(input)) {
    grid_ = split_image(image, field, options.above);
    field_ = grid_->GetPointData()->GetArray(0);
  }
  if (!grid_) throw Error("the input is neither an unstructured grid nor an image");
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

SweepOptions Run::sweep(double begin, double end) const {
  if (filter_.GetAbortExecute() != 0) throw Aborted();
  SweepOptions options;
  options.threads = threads_;
  options.progress = [this, begin, end](Id done, Id segments) {
    filter_.UpdateProgress(begin + (end - begin) * done / segments);
    if (filter_.GetAbortExecute() != 0) throw Aborted();
  };
  return options;
}

}  // namespace gale::vtk
