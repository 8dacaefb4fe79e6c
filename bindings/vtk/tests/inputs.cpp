#include "inputs.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkGaleMorseSmaleComplex.h>
#include <vtkGaleSegmentation.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace gale::test {

namespace {

void keep_line(vtkObject*, unsigned long, void* kept, void* text) {
  static_cast<std::vector<std::string>*>(kept)->push_back(static_cast<const char*>(text));
}

/// What follows the place in the source and the object: "ERROR: In FILE, line N\nCLASS (ADDRESS): LINE\n\n".
std::string line_of(const std::string& error) {
  const auto begin = error.find("): ");
  return begin == std::string::npos ? error : error.substr(begin + 3, error.find_last_not_of('\n') - begin - 2);
}

/// Every object that isn't itself made of others: the output, or its blocks.
std::vector<vtkDataObject*> leaves_of(vtkDataObject* output) {
  auto* const blocks = vtkCompositeDataSet::SafeDownCast(output);
  if (blocks == nullptr) return {output};
  std::vector<vtkDataObject*> leaves;
  const auto at = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (at->InitTraversal(); !at->IsDoneWithTraversal(); at->GoToNextItem())
    leaves.push_back(at->GetCurrentDataObject());
  return leaves;
}

}  // namespace

std::vector<vtkSmartPointer<vtkGaleAlgorithm>> Inputs::all() {
  std::vector<vtkSmartPointer<vtkGaleAlgorithm>> filters = {vtkSmartPointer<vtkGaleCriticalPoints>::New(),
                                                            vtkSmartPointer<vtkGaleMorseSmaleComplex>::New(),
                                                            vtkSmartPointer<vtkGaleSegmentation>::New()};
  for (const auto& filter : filters) filter->SetNumberOfThreads(1);  // there are many runs, and little to do in each
  return filters;
}

vtkIdType Inputs::points_in(vtkDataObject* output) {
  vtkIdType points = 0;
  for (vtkDataObject* const leaf : leaves_of(output)) points += vtkDataSet::SafeDownCast(leaf)->GetNumberOfPoints();
  return points;
}

std::string Inputs::line(vtkGaleAlgorithm& filter, vtkDataObject* input, const char* array) {
  filter.SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "field");
  filter.SetInputData(grid_);
  filter.Update();
  EXPECT_GT(points_in(filter.GetOutputDataObject(0)), 0);
  std::vector<std::string> errors;
  const auto watch = vtkSmartPointer<vtkCallbackCommand>::New();
  watch->SetCallback(keep_line);
  watch->SetClientData(&errors);
  const auto tag = filter.AddObserver(vtkCommand::ErrorEvent, watch);
  const auto follows = vtkSmartPointer<vtkCallbackCommand>::New();  // keeps VTK's own quiet
  const auto other = filter.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, follows);
  if (array != nullptr) filter.SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
  filter.SetInputData(input);
  filter.Update();
  filter.RemoveObserver(tag);
  filter.GetExecutive()->RemoveObserver(other);
  for (int port = 0; port < filter.GetNumberOfOutputPorts(); ++port) {
    const char* const type = filter.GetOutputPortInformation(port)->Get(vtkDataObject::DATA_TYPE_NAME());
    for (vtkDataObject* const leaf : leaves_of(filter.GetOutputDataObject(port)))
      EXPECT_TRUE(leaf != nullptr && leaf->IsA(type)) << filter.GetClassName() << ", port " << port;
    // Blocks that can be analysed are.
    if (errors.empty() || input->IsA("vtkCompositeDataSet")) continue;
    EXPECT_EQ(points_in(filter.GetOutputDataObject(port)), 0) << filter.GetClassName();
  }
  EXPECT_LE(errors.size(), 1u) << filter.GetClassName();
  const std::string said = errors.empty() ? "" : line_of(errors[0]);
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  return said;
}

void Inputs::expect_line(vtkDataObject* input, const std::string& said, const char* array) {
  for (const auto& filter : all()) {
    const std::string found = line(*filter, input, array);
    if (said.empty()) {
      EXPECT_EQ(found, "");
    } else {
      EXPECT_NE(found.find(said), std::string::npos) << found;
    }
  }
}

vtkSmartPointer<vtkRectilinearGrid> Inputs::rectilinear_of(const std::vector<double>& axis) const {
  const auto image = image_of(dataset_, n);
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  vtkNew<vtkDoubleArray> coordinates;
  for (const double at : axis) coordinates->InsertNextValue(at);
  grid->SetDimensions(n, n, n);
  grid->SetXCoordinates(coordinates);
  grid->SetYCoordinates(coordinates);
  grid->SetZCoordinates(coordinates);
  grid->GetPointData()->SetScalars(image->GetPointData()->GetScalars());
  return grid;
}

}  // namespace gale::test
