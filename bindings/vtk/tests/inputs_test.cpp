#include "inputs.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <vtkDataObjectTypes.h>
#include <vtkFloatArray.h>
#include <vtkGaleAlgorithm.h>
#include <vtkGaleSegmentation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>
#include <vtkTable.h>

namespace gale::test {
namespace {

TEST_F(Inputs, EmptyObjectsOfEveryType) {
  int refused = 0;
  for (int type = 0; type <= VTK_IMAGE_STENCIL_DATA; ++type) {
    const auto input = vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type));
    if (!input) continue;
    const std::string name = input->GetClassName();
    SCOPED_TRACE(name);
    const bool is_mesh = input->IsA("vtkPointSet") || input->IsA("vtkImageData") || input->IsA("vtkRectilinearGrid") ||
                         input->IsA("vtkCompositeDataSet");
    const bool is_other =
        input->IsA("vtkDataSet") || input->IsA("vtkHyperTreeGrid") || input->IsA("vtkTable") || input->IsA("vtkGraph");
    // What holds no data of points or rows the pipeline itself refuses.
    if (is_mesh || is_other)
      expect_line(input, is_mesh ? "" : "the input is a " + name + ", not a grid, a surface or an image");
    refused += is_other && !is_mesh ? 1 : 0;
  }
  EXPECT_GE(refused, 8);
}

TEST_F(Inputs, EmptyMeshesGiveEmptyOutputs) {
  vtkNew<vtkUnstructuredGrid> empty, points_alone;
  vtkNew<vtkImageData> image;
  vtkNew<vtkRectilinearGrid> rectilinear;
  points_alone->SetPoints(grid_->GetPoints());
  for (vtkDataObject* const input : std::initializer_list<vtkDataObject*>{empty, points_alone, image, rectilinear}) {
    for (const auto& filter : all()) {
      EXPECT_EQ(line(*filter, input, "nothing"), "");
      for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
        EXPECT_EQ(points_in(filter->GetOutputDataObject(port)), 0) << filter->GetClassName();
    }
  }
}

TEST_F(Inputs, BlocksAreMeshesOfTheirOwn) {
  vtkNew<vtkUnstructuredGrid> empty;
  const auto image = image_of(dataset_, n);
  vtkNew<vtkMultiBlockDataSet> blocks, inner;
  inner->SetBlock(0, empty);
  inner->SetBlock(1, image);
  blocks->SetBlock(0, grid_);
  blocks->SetBlock(1, empty);
  blocks->SetBlock(2, nullptr);
  blocks->SetBlock(3, inner);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, grid_);
  collection->SetPartition(0, 1, empty);
  collection->SetPartition(2, 0, image);
  for (vtkCompositeDataSet* const input : std::initializer_list<vtkCompositeDataSet*>{blocks, collection}) {
    for (const auto& filter : all()) {
      filter->SetInputData(grid_);
      filter->Update();
      std::vector<vtkIdType> alone;
      for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
        alone.push_back(points_in(filter->GetOutputDataObject(port)));
      EXPECT_EQ(line(*filter, input), "") << input->GetClassName();
      for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port) {
        vtkDataObject* const output = filter->GetOutputDataObject(port);
        ASSERT_TRUE(output->IsA("vtkCompositeDataSet")) << filter->GetClassName() << ", port " << port;
        EXPECT_EQ(points_in(output), 2 * alone[port]) << "the grid's and the image's";
      }
    }
  }
  vtkNew<vtkTable> table;
  blocks->SetBlock(2, table);
  expect_line(blocks, "the input is a vtkTable");
}

TEST_F(Inputs, OtherMeshesAreRefused) {
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(grid_->GetPoints());
  surface->GetPointData()->ShallowCopy(grid_->GetPointData());
  expect_line(surface, "");  // a surface without polygons
  vtkNew<vtkTable> table;
  table->AddColumn(grid_->GetPointData()->GetScalars());
  expect_line(table, "the input is a vtkTable");
}

TEST_F(Inputs, StructuredGridsAreMeshesOfHexahedra) {
  vtkNew<vtkStructuredGrid> curved;
  curved->SetDimensions(n, n, n);
  curved->SetPoints(grid_->GetPoints());
  curved->GetPointData()->ShallowCopy(grid_->GetPointData());
  // The lowest points of hexahedra in a row make the same tetrahedra as the grid has.
  for (const auto& filter : all()) {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "field");
    filter->SetInputData(grid_);
    filter->Update();
    const vtkIdType expected = points_in(filter->GetOutputDataObject(0));
    EXPECT_EQ(line(*filter, curved), "");
    EXPECT_EQ(points_in(filter->GetOutputDataObject(0)), expected);
  }
  curved->BlankCell(3);
  vtkNew<vtkGaleSegmentation> segmentation;
  segmentation->SetInputData(curved);
  segmentation->Update();
  EXPECT_EQ(vtkDataSet::SafeDownCast(segmentation->GetOutputDataObject(0))->GetNumberOfCells(),
            (n - 1) * (n - 1) * (n - 1) - 1);
}

TEST_F(Inputs, RectilinearGridsAreSplitAsImagesAre) {
  const auto image = image_of(dataset_, n);
  const std::vector<double> axis = {-2, 0, 1, 5, 5.5};
  const auto rectilinear = rectilinear_of(axis);
  for (const auto& filter : all()) {
    filter->UseThresholdOn();
    filter->SetThreshold(-0.5);
    filter->SetInputData(image);
    filter->Update();
    auto expected =
        vtkSmartPointer<vtkDataSet>::Take(vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->NewInstance());
    expected->DeepCopy(filter->GetOutputDataObject(0));
    filter->SetInputData(rectilinear);
    filter->Update();
    auto* const found = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    ASSERT_GT(found->GetNumberOfPoints(), 0);
    ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints());
    ASSERT_EQ(found->GetNumberOfCells(), expected->GetNumberOfCells());
    for (vtkIdType k = 0; filter->IsA("vtkGaleCriticalPoints") && k < found->GetNumberOfPoints(); ++k) {
      for (int d = 0; d < 3; ++d)
        EXPECT_EQ(found->GetPoint(k)[d], axis[static_cast<std::size_t>(expected->GetPoint(k)[d])]);
      for (const char* const name : {"field", "CriticalType"})
        EXPECT_EQ(found->GetPointData()->GetArray(name)->GetTuple1(k),
                  expected->GetPointData()->GetArray(name)->GetTuple1(k));
    }
  }
  expect_line(rectilinear_of({0, 1, 2}), "the grid has 3 coordinates along axis x, not 5");
  expect_line(rectilinear_of({0, 1, 2, 3, std::numeric_limits<double>::quiet_NaN()}), "not finite");
}

TEST_F(Inputs, VoxelsInOneDimensionAreRefused) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(n * n, 1, 1);
  vtkNew<vtkFloatArray> field;
  field->SetName("field");
  for (int k = 0; k < n * n; ++k) field->InsertNextValue(static_cast<float>(k % 7));
  image->GetPointData()->SetScalars(field);
  expect_line(image, "at least 2 in two directions");
}

}  // namespace
}  // namespace gale::test
