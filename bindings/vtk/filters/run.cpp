#include "run.hpp"

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkInformationVector.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/outputs/field.hpp>

#include "arrays.hpp"
#include "grid.hpp"

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

void Run::analyse(const char* analysis, const outputs::Settings& settings, vtkInformationVector* outputs) const {
  const io::PointArray values = field();
  const VertexOrder values_order = order(values);
  const outputs::Analysis& described = outputs::analysis_named(analysis);
  const auto next = [this](const char* what, double begin, double end) { return compute(what, begin, end); };
  const auto found = described.run({dataset_, values, values_order, next}, settings);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port) {
    const auto outcome = found.find(described.results[port].name);
    if (outcome == found.end()) continue;  // it wasn't asked for
    if (const auto* const points = std::get_if<io::PointSet>(&outcome->second))
      to_poly_data(*points, grid_->GetPointData(), vtkPolyData::GetData(outputs, port));
    if (const auto* const surface = std::get_if<io::Surface>(&outcome->second))
      to_poly_data(*surface, vtkPolyData::GetData(outputs, port));
    if (const auto* const arrays = std::get_if<std::vector<io::PointArray>>(&outcome->second))
      give(*arrays, outputs, port);
  }
}

void Run::give(const std::vector<io::PointArray>& arrays, vtkInformationVector* outputs, int port) const {
  vtkUnstructuredGrid* const mesh = vtkUnstructuredGrid::GetData(outputs, port);
  mesh->ShallowCopy(grid_);
  add(arrays, mesh->GetPointData());
}

}  // namespace gale::vtk
