#include "vtkGaleAlgorithm.h"

#include <cstdlib>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <Kokkos_Core.hpp>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>

#include <gale/base/error.hpp>
#include <gale/outputs/analyses.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/segmentation.hpp>

#include "arrays.hpp"
#include "grid.hpp"
#include "initialize_kokkos.hpp"
#include "visible_cells.hpp"

namespace {

using gale::io::PointArray;

/// Thrown where somebody aborts a filter.
struct Aborted {};

/// What a filter's properties say of its input.
struct InputProperties {
  int threads;  ///< 0: as many as there are cores
  int capacity;
  std::optional<double> above;    ///< of voxels
  bool is_octree_wanted = false;  ///< its segments are the result
};

/// One execution of a filter: its input as GALE has it, and how it tells how far it is. To be used by the thread that
/// made it alone.
class Run {
 public:
  /// `field` is an array of the input's points, which has a name, or nullptr. Throws gale::Error for an input that is
  /// no mesh, and Aborted.
  Run(vtkAlgorithm& filter, vtkDataSet* input, vtkDataArray* field, const InputProperties& options)
      : filter_(filter),
        threads_(options.threads > 0 ? options.threads : gale::host_threads()),
        limit_(threads_),
        field_(field) {
    if (auto* const mesh = vtkPointSet::SafeDownCast(input)) {
      grid_ = gale::vtk::visible_cells(mesh);
    } else {
      tell(0, "Splitting voxels");
      gale::vtk::Voxels voxels = gale::vtk::voxels_of(input, field, options.above);
      voxels_ = std::move(voxels.grid);
      grid_ = voxels.mesh;
      if (options.is_octree_wanted) write_cells();
    }
    if (grid_ != input) {
      if (field) field_ = grid_->GetPointData()->GetArray(field->GetName());
      grid_->SetFieldData(input->GetFieldData());
    }
    if (is_empty()) return;
    tell(0, "Dividing the mesh into segments");
    dataset_.points = gale::vtk::positions_of(grid_);
    mesh_ =
        voxels_ ? gale::Mesh(*voxels_, options.capacity) : gale::vtk::mesh_of(grid_, dataset_.points, options.capacity);
  }

  /// Whether no cell is left.
  bool is_empty() const { return !voxels_ && grid_->GetNumberOfCells() == 0; }

  const gale::Mesh& mesh() const { return *mesh_; }

  /// Runs an analysis on the field, along the order of its values, or that of the array NAME_Order, and gives its
  /// results to the outputs in their order. Sweeps tell the filter's progress, with a text of what is done, and throw
  /// Aborted once the filter is to abort. Throws gale::Error if there is no field, or if it isn't of one number a
  /// point.
  void analyse(const char* analysis, const gale::outputs::Settings& settings, vtkInformationVector* outputs) {
    const PointArray values = field();
    const gale::VertexOrder order = order_of(values);
    const gale::outputs::Analysis& described = gale::outputs::analysis_named(analysis);
    const auto next = [this](const char* what, double begin, double end) { return compute(what, begin, end); };
    const auto found = described.run({dataset_, values, order, next}, settings);
    for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port) {
      const auto outcome = found.find(described.results[port].name);
      if (outcome == found.end()) continue;  // nobody asked for it
      if (const auto* const points = std::get_if<gale::io::PointSet>(&outcome->second))
        gale::vtk::to_poly_data(*points, grid_->GetPointData(), vtkPolyData::GetData(outputs, port));
      if (const auto* const surface = std::get_if<gale::io::Surface>(&outcome->second))
        gale::vtk::to_poly_data(*surface, vtkPolyData::GetData(outputs, port));
      if (const auto* const arrays = std::get_if<std::vector<PointArray>>(&outcome->second))
        give(*arrays, outputs, port);
    }
  }

  /// Gives the mesh, with these arrays at its points, to an output.
  void give(const std::vector<PointArray>& arrays, vtkInformationVector* outputs, int port) {
    write_cells();
    vtkUnstructuredGrid* const mesh = vtkUnstructuredGrid::GetData(outputs, port);
    mesh->ShallowCopy(grid_);
    gale::vtk::add(arrays, mesh->GetPointData());
  }

 private:
  /// Writes out the cells of voxels, once somebody wants them.
  void write_cells() {
    if (voxels_) gale::vtk::write_cells(*voxels_, grid_);
    voxels_.reset();
  }

  PointArray field() const {
    if (!field_)
      throw gale::Error("no point array to analyse: set the array to process, or make one the active scalars");
    const PointArray field = gale::vtk::point_array(field_);
    if (field.components != 1)
      throw gale::Error("array '" + field.name + "' has " + std::to_string(field.components) + " components, not 1");
    return field;
  }

  gale::VertexOrder order_of(const PointArray& field) const {
    gale::io::Dataset dataset;
    vtkDataArray* const order = grid_->GetPointData()->GetArray((field.name + "_Order").c_str());
    if (order != nullptr) dataset.arrays.push_back(gale::vtk::point_array(order));
    std::string note;
    gale::VertexOrder found = gale::outputs::order_of(mesh(), dataset, field, &note);
    if (!note.empty()) vtkWarningWithObjectMacro(&filter_, << note);
    return found;
  }

  void tell(double progress, const char* text) const {
    filter_.SetProgressText(text);
    filter_.UpdateProgress(progress);
    if (filter_.GetAbortExecute() != 0) throw Aborted();
  }

  gale::ComputeOptions compute(const char* text, double begin, double end) const {
    tell(begin, text);
    gale::ComputeOptions options;
    options.threads = threads_;
    options.progress = [this, begin, end](gale::Id done, gale::Id segments) {
      filter_.UpdateProgress(begin + (end - begin) * done / segments);
      if (filter_.GetAbortExecute() != 0) throw Aborted();
    };
    return options;
  }

  vtkAlgorithm& filter_;
  int threads_;
  gale::ThreadLimit limit_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  std::optional<gale::Grid> voxels_;  ///< whose cells `grid_` hasn't got
  vtkSmartPointer<vtkDataArray> field_;
  gale::io::Dataset dataset_;
  std::optional<gale::Mesh> mesh_;
};

void initialize_once() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (!gale::bindings::initialize_kokkos()) return;
    std::atexit([] {
      if (Kokkos::is_initialized()) Kokkos::finalize();
    });
  });
}

vtkDataArray* first_field(vtkPointData* arrays) {
  if (arrays->GetScalars()) return arrays->GetScalars();
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
    vtkDataArray* const array = arrays->GetArray(k);
    if (!array || !array->GetName()) continue;
    const bool is_whole = array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
    if (gale::outputs::may_be_field(array->GetName(), array->GetNumberOfComponents(), is_whole)) return array;
  }
  return nullptr;
}

/// A server of several processes asks each for a piece, and gives it a piece: which says nothing of the whole mesh.
void require_whole(vtkInformationVector* outputs) {
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port) {
    vtkInformation* const output = outputs->GetInformationObject(port);
    const int pieces = output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
    if (pieces <= 1) continue;
    throw gale::Error("asked for piece " + std::to_string(output->Get(Pipeline::UPDATE_PIECE_NUMBER())) + " of " +
                      std::to_string(pieces) + ": the whole mesh is needed, in one process");
  }
}

/// Throws gale::Error where an array hasn't one row for each of so many points or cells.
void require_rows(vtkDataSetAttributes* arrays, vtkIdType rows, const std::string& array_of, const char* whole) {
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
    vtkAbstractArray* const array = arrays->GetAbstractArray(k);
    if (array->GetNumberOfTuples() == rows) continue;
    throw gale::Error(array_of + "array '" + (array->GetName() ? array->GetName() : "") + "' has " +
                      std::to_string(array->GetNumberOfTuples()) + " rows for " + std::to_string(rows) + whole);
  }
}

/// The field's name, where it has none: one that neither an array nor its order has.
std::string free_name(vtkFieldData* arrays) {
  std::string name = "field";
  while (arrays->HasArray(name.c_str()) || arrays->HasArray((name + "_Order").c_str())) name += '_';
  return name;
}

/// The mesh; a copy with a name for the field where it has none.
vtkSmartPointer<vtkDataSet> with_name(vtkDataSet* mesh, vtkSmartPointer<vtkDataArray>& field) {
  if (!field || (field->GetName() && *field->GetName())) return mesh;
  const auto copy = vtkSmartPointer<vtkDataSet>::Take(mesh->NewInstance());
  copy->ShallowCopy(mesh);
  const auto named = vtkSmartPointer<vtkDataArray>::Take(field->NewInstance());
  named->ShallowCopy(field);
  vtkPointData* const arrays = copy->GetPointData();
  named->SetName(free_name(arrays).c_str());
  const bool is_active = arrays->GetScalars() == field;
  for (int k = arrays->GetNumberOfArrays() - 1; k >= 0; --k)
    if (arrays->GetAbstractArray(k) == field) arrays->RemoveArray(k);
  arrays->AddArray(named);
  if (is_active) arrays->SetActiveScalars(named->GetName());
  field = named;
  return copy;
}

/// The input. Throws gale::Error if it is no mesh, or where an array hasn't one row a point or a cell.
vtkDataSet* mesh_of(vtkInformationVector* inputs) {
  vtkDataObject* const input = vtkDataObject::GetData(inputs);
  if (!vtkPointSet::SafeDownCast(input) && !vtkImageData::SafeDownCast(input) &&
      !vtkRectilinearGrid::SafeDownCast(input))
    throw gale::Error(std::string("the input is a ") + input->GetClassName() + ", not a grid, a surface or an image");
  auto* const mesh = vtkDataSet::SafeDownCast(input);
  require_rows(mesh->GetPointData(), mesh->GetNumberOfPoints(), "", " points");
  require_rows(mesh->GetCellData(), mesh->GetNumberOfCells(), "cell ", " cells");
  return mesh;
}

/// Leaves nothing of what was begun.
void empty(vtkInformationVector* outputs) {
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
    vtkDataObject::GetData(outputs, port)->Initialize();
}

}  // namespace

/// What a filter asks for.
struct vtkGaleAlgorithm::Request {
  const char* analysis;
  int mesh_port;
  gale::outputs::Settings settings;
};

vtkGaleAlgorithm::vtkGaleAlgorithm(const char* analysis, int outputPorts, int meshPort)
    : Asked(new Request{analysis, meshPort, {}}) {
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(outputPorts);
}

vtkGaleAlgorithm::~vtkGaleAlgorithm() = default;

void vtkGaleAlgorithm::AskFlag(const char* option, bool isOn) { this->Asked->settings.flags[option] = isOn; }

void vtkGaleAlgorithm::AskThreshold(const char* option, double value, bool isPercent) {
  this->Asked->settings.thresholds[option] = {value, isPercent};
}

void vtkGaleAlgorithm::AskChoice(const char* option, int place) {
  const auto& choices = gale::outputs::analysis_named(this->Asked->analysis).option(option).choices;
  this->Asked->settings.choices[option] = choices.at(static_cast<std::size_t>(place));
}

void vtkGaleAlgorithm::AskNumber(const char* option, int number) { this->Asked->settings.numbers[option] = number; }

int vtkGaleAlgorithm::FillInputPortInformation(int, vtkInformation* info) {
  // More than is taken: RequestData refuses the others. Where the pipeline does, outputs stay those of the input
  // before.
  for (const char* const type : {"vtkDataSet", "vtkHyperTreeGrid", "vtkTable", "vtkGraph"})
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  return 1;
}

int vtkGaleAlgorithm::FillOutputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == this->Asked->mesh_port ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

vtkTypeBool vtkGaleAlgorithm::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                             vtkInformationVector* outputs) {
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA())) {
    return this->RequestData(inputs, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

vtkDataArray* vtkGaleAlgorithm::SelectField(vtkInformationVector** inputs) {
  vtkInformation* const chosen = this->GetInputArrayInformation(0);
  const char* const name = chosen->Get(vtkDataObject::FIELD_NAME());
  const bool is_named = name && *name;
  if (!is_named && !chosen->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
    return first_field(vtkDataSet::GetData(inputs[0])->GetPointData());
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* const field = this->GetInputArrayToProcess(0, inputs, association);
  const std::string called = is_named ? std::string(" '") + name + "'" : "";
  if (!field) throw gale::Error("the input has no point array" + called);
  if (association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
    throw gale::Error("the array" + called + " is not one of points");
  return field;
}

int vtkGaleAlgorithm::RequestData(vtkInformationVector** inputs, vtkInformationVector* outputs) {
  InputProperties options;
  options.threads = this->NumberOfThreads;
  options.capacity = this->Capacity;
  if (this->UseThreshold) options.above = this->Threshold;
  options.is_octree_wanted = this->Asked->analysis == nullptr;
  try {
    require_whole(outputs);
    vtkDataSet* const mesh = mesh_of(inputs[0]);
    const bool has_points = vtkUnstructuredGrid::SafeDownCast(mesh) || mesh->GetNumberOfPoints() > 0;
    if (mesh->GetNumberOfCells() == 0 || !has_points)
      return 1;  // as empty blocks are: the pipeline has emptied the outputs
    initialize_once();
    vtkSmartPointer<vtkDataArray> field = this->SelectField(inputs);
    const vtkSmartPointer<vtkDataSet> named = with_name(mesh, field);
    Run run(*this, named, field, options);
    if (run.is_empty()) return 1;
    this->Asked->settings = {};
    this->Ask();
    if (this->Asked->analysis) {
      run.analyse(this->Asked->analysis, this->Asked->settings, outputs);
    } else {
      run.give({gale::outputs::segments_of(run.mesh())}, outputs, this->Asked->mesh_port);
    }
    return 1;
  } catch (const Aborted&) {
    empty(outputs);
    return 1;
  } catch (const std::bad_alloc&) {
    vtkErrorMacro("out of memory");
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
  }
  empty(outputs);
  return 0;
}

void vtkGaleAlgorithm::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Capacity: " << this->Capacity << "\n";
  os << indent << "UseThreshold: " << this->UseThreshold << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
}
