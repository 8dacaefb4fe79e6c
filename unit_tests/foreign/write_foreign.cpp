// write_foreign SOURCE.vtu FILE.e|FILE.vtkhdf: the mesh of a .vtu in another format. write_foreign SIZE FILE.vtkhdf: an
// image of SIZE^3 points with the array "ramp", x + 2y + 3z. write_foreign SOURCE.vtu FILE.e TIMES: "field" grows by
// one from one time to the next. write_foreign strange FOLDER, write_foreign random FOLDER COUNT: see
// strange_files.hpp.
#include <cstdlib>
#include <string>
#include <vector>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkExodusIIWriter.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridAlgorithm.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "hdf5_writing.hpp"
#include "strange_files.hpp"

namespace {

void write_image(int size, const char* path) {
  const VtkHdf to(path, "ImageData");
  describe_image(to, size);
  std::vector<float> ramp;
  for (int i = 0; i < size * size * size; ++i)
    ramp.push_back(static_cast<float>(i % size + 2 * (i / size % size) + 3 * (i / size / size)));
  const auto n = static_cast<hsize_t>(size);
  put(to.arrays, "ramp", H5T_NATIVE_FLOAT, {n, n, n}, ramp.data());
}

void write_mesh(vtkUnstructuredGrid* grid, const char* path) {
  const VtkHdf to(path, "UnstructuredGrid");
  const auto points = static_cast<hsize_t>(grid->GetNumberOfPoints()),
             cells = static_cast<hsize_t>(grid->GetNumberOfCells());
  std::vector<float> xyz;
  std::vector<long long> ends{0}, corners;
  std::vector<unsigned char> types;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    for (int d = 0; d < 3; ++d) xyz.push_back(static_cast<float>(grid->GetPoint(p)[d]));
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    vtkIdType count;
    const vtkIdType* ids;
    grid->GetCellPoints(c, count, ids);
    corners.insert(corners.end(), ids, ids + count);
    ends.push_back(static_cast<long long>(corners.size()));
    types.push_back(static_cast<unsigned char>(grid->GetCellType(c)));
  }
  const long long of_points = grid->GetNumberOfPoints(), of_cells = grid->GetNumberOfCells(),
                  of_corners = static_cast<long long>(corners.size());
  put(to.root, "NumberOfPoints", H5T_NATIVE_LLONG, {1}, &of_points);
  put(to.root, "NumberOfCells", H5T_NATIVE_LLONG, {1}, &of_cells);
  put(to.root, "NumberOfConnectivityIds", H5T_NATIVE_LLONG, {1}, &of_corners);
  put(to.root, "Points", H5T_NATIVE_FLOAT, {points, 3}, xyz.data());
  put(to.root, "Offsets", H5T_NATIVE_LLONG, {cells + 1}, ends.data());
  put(to.root, "Connectivity", H5T_NATIVE_LLONG, {corners.size()}, corners.data());
  put(to.root, "Types", H5T_NATIVE_UCHAR, {cells}, types.data());
  std::vector<float> field;
  vtkDataArray* const array = grid->GetPointData()->GetArray("field");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p) field.push_back(static_cast<float>(array->GetTuple1(p)));
  put(to.arrays, "field", H5T_NATIVE_FLOAT, {points}, field.data());
}

/// Its input at the times 0, 1 ...
class AtTimes : public vtkUnstructuredGridAlgorithm {
 public:
  static AtTimes* New();
  vtkTypeMacro(AtTimes, vtkUnstructuredGridAlgorithm);
  int times = 1;

 protected:
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override {
    std::vector<double> steps;
    for (int t = 0; t < times; ++t) steps.push_back(t);
    const double range[] = {0, steps.back()};
    vtkInformation* const output = outputs->GetInformationObject(0);
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps.data(), times);
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override {
    auto* const from = vtkUnstructuredGrid::GetData(inputs[0]);
    auto* const to = vtkUnstructuredGrid::GetData(outputs);
    vtkInformation* const asked = outputs->GetInformationObject(0);
    auto* const key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    const double time = asked->Has(key) ? asked->Get(key) : 0;
    to->ShallowCopy(from);
    vtkNew<vtkDoubleArray> field;
    field->SetName("field");
    for (vtkIdType p = 0; p < from->GetNumberOfPoints(); ++p)
      field->InsertNextValue(from->GetPointData()->GetArray("field")->GetTuple1(p) + time);
    to->GetPointData()->AddArray(field);
    to->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(AtTimes);

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) return 2;
  const std::string from = argv[1], to = argv[2];
  if (from == "strange") {
    write_strange_files(to);
    return 0;
  }
  if (from == "random") {
    write_random_files(to, std::atoi(argv[3]));
    return 0;
  }
  if (from.find('.') == std::string::npos) {
    write_image(std::atoi(argv[1]), argv[2]);
    return 0;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  if (to.size() > 7 && to.substr(to.size() - 7) == ".vtkhdf") {
    write_mesh(reader->GetOutput(), argv[2]);
    return 0;
  }
  vtkNew<AtTimes> at_times;
  at_times->SetInputConnection(reader->GetOutputPort());
  if (argc == 4) at_times->times = std::atoi(argv[3]);
  vtkNew<vtkExodusIIWriter> writer;
  writer->SetInputConnection(at_times->GetOutputPort());
  writer->SetFileName(argv[2]);
  writer->SetWriteAllTimeSteps(argc == 4);
  return writer->Write() != 0 ? 0 : 1;
}
