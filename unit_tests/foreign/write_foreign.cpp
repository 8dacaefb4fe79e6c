// write_foreign SOURCE.vtu FILE.e|FILE.vtkhdf [TIMES [ONLY]]: the mesh of a .vtu in another format; "field" grows by
// one from one time to the next; or at one of these times alone. write_foreign SIZE FILE.vtkhdf [TIMES [ONLY]]: an
// image of SIZE^3 points with the array "ramp", (1 + time) x + 2y + 3z. write_foreign strange FOLDER, write_foreign
// random FOLDER COUNT: see strange_files.hpp.
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

/// Times from `first` on; the arrays of a file that has one don't say so.
struct Times {
  int first = 0, count = 1;
  bool are_several() const { return count > 1; }
};

void put_integers(hid_t group, const char* name, const std::vector<long long>& values) {
  put(group, name, H5T_NATIVE_LLONG, {values.size()}, values.data());
}

/// Says where what belongs to each time begins; of point arrays each has `rows` rows a time.
void put_steps(const VtkHdf& to, const char* array, int count, long long rows,
               const std::vector<std::pair<const char*, std::vector<long long>>>& offsets) {
  const hid_t steps = H5Gcreate(to.root, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
              arrays = H5Gcreate(steps, "PointDataOffsets", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const long long all = count;
  describe(steps, "NSteps", H5T_NATIVE_LLONG, {1}, &all);
  std::vector<double> times;
  std::vector<long long> begins;
  for (int t = 0; t < count; ++t) {
    times.push_back(t);
    begins.push_back(rows * t);
  }
  put(steps, "Values", H5T_NATIVE_DOUBLE, {times.size()}, times.data());
  put_integers(arrays, array, begins);
  for (const auto& [name, values] : offsets) put_integers(steps, name, values);
  H5Gclose(arrays);
  H5Gclose(steps);
}

void write_image(int size, const char* path, const Times& times) {
  const VtkHdf to(path, "ImageData");
  describe_image(to, size);
  std::vector<float> ramp;
  for (int t = 0; t < times.count; ++t) {
    for (int i = 0; i < size * size * size; ++i)
      ramp.push_back(
          static_cast<float>((t + times.first + 1) * (i % size) + 2 * (i / size % size) + 3 * (i / size / size)));
  }
  const auto n = static_cast<hsize_t>(size), count = static_cast<hsize_t>(times.count);
  const std::vector<hsize_t> alone{n, n, n}, several{count, n, n, n};
  put(to.arrays, "ramp", H5T_NATIVE_FLOAT, times.are_several() ? several : alone, ramp.data());
  if (times.are_several()) put_steps(to, "ramp", times.count, 1, {});
}

/// The second of several times has the mesh of the first.
void write_mesh(vtkUnstructuredGrid* grid, const char* path, const Times& times) {
  const VtkHdf to(path, "UnstructuredGrid");
  const long long points = grid->GetNumberOfPoints(), cells = grid->GetNumberOfCells();
  std::vector<float> xyz, field;
  std::vector<long long> ends, corners, of_points, of_cells, of_corners, parts, first_points, first_cells,
      first_corners;
  std::vector<unsigned char> types;
  vtkDataArray* const array = grid->GetPointData()->GetArray("field");
  for (int t = 0; t < times.count; ++t) {
    for (vtkIdType p = 0; p < points; ++p) field.push_back(static_cast<float>(array->GetTuple1(p) + t + times.first));
    if (t != 1) {
      const std::size_t first_corner = corners.size();
      of_points.push_back(points);
      of_cells.push_back(cells);
      for (vtkIdType p = 0; p < points; ++p)
        for (int d = 0; d < 3; ++d) xyz.push_back(static_cast<float>(grid->GetPoint(p)[d]));
      ends.push_back(0);
      for (vtkIdType c = 0; c < cells; ++c) {
        vtkIdType count;
        const vtkIdType* ids;
        grid->GetCellPoints(c, count, ids);
        corners.insert(corners.end(), ids, ids + count);
        ends.push_back(static_cast<long long>(corners.size() - first_corner));
        types.push_back(static_cast<unsigned char>(grid->GetCellType(c)));
      }
      of_corners.push_back(static_cast<long long>(corners.size() - first_corner));
    }
    const auto part = static_cast<long long>(of_points.size()) - 1;
    parts.push_back(part);
    first_points.push_back(part * points);
    first_cells.push_back(part * cells);
    first_corners.push_back(part * of_corners[0]);
  }
  put_integers(to.root, "NumberOfPoints", of_points);
  put_integers(to.root, "NumberOfCells", of_cells);
  put_integers(to.root, "NumberOfConnectivityIds", of_corners);
  put(to.root, "Points", H5T_NATIVE_FLOAT, {xyz.size() / 3, 3}, xyz.data());
  put_integers(to.root, "Offsets", ends);
  put_integers(to.root, "Connectivity", corners);
  put(to.root, "Types", H5T_NATIVE_UCHAR, {types.size()}, types.data());
  const hid_t chunks = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t chunk = 100;
  H5Pset_chunk(chunks, 1, &chunk);
  H5Pset_deflate(chunks, 4);
  put(to.arrays, "field", H5T_NATIVE_FLOAT, {field.size()}, field.data(), times.are_several() ? chunks : H5P_DEFAULT);
  H5Pclose(chunks);
  if (!times.are_several()) return;
  put_steps(to, "field", times.count, points,
            {{"PartOffsets", parts},
             {"NumberOfParts", std::vector<long long>(parts.size(), 1)},
             {"PointOffsets", first_points},
             {"CellOffsets", first_cells},
             {"ConnectivityIdOffsets", first_corners}});
}

/// Its input at these times.
class AtTimes : public vtkUnstructuredGridAlgorithm {
 public:
  static AtTimes* New();
  vtkTypeMacro(AtTimes, vtkUnstructuredGridAlgorithm);
  Times times;

 protected:
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override {
    std::vector<double> steps;
    for (int t = 0; t < times.count; ++t) steps.push_back(times.first + t);
    const double range[] = {steps.front(), steps.back()};
    vtkInformation* const output = outputs->GetInformationObject(0);
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps.data(), times.count);
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
  if (argc < 3 || argc > 5) return 2;
  const std::string from = argv[1], to = argv[2];
  if (from == "strange") {
    write_strange_files(to);
    return 0;
  }
  if (from == "random") {
    write_random_files(to, std::atoi(argv[3]));
    return 0;
  }
  Times times;
  if (argc >= 4) times.count = std::atoi(argv[3]);
  if (argc == 5) times = {std::atoi(argv[4]), 1};
  if (from.find('.') == std::string::npos) {
    write_image(std::atoi(argv[1]), argv[2], times);
    return 0;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  if (to.size() > 7 && to.substr(to.size() - 7) == ".vtkhdf") {
    write_mesh(reader->GetOutput(), argv[2], times);
    return 0;
  }
  vtkNew<AtTimes> at_times;
  at_times->SetInputConnection(reader->GetOutputPort());
  at_times->times = times;
  vtkNew<vtkExodusIIWriter> writer;
  writer->SetInputConnection(at_times->GetOutputPort());
  writer->SetFileName(argv[2]);
  writer->SetWriteAllTimeSteps(argc >= 4);
  return writer->Write() != 0 ? 0 : 1;
}
