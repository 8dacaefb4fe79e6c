#include <algorithm>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkDoubleArray.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkGaleMorseSmaleComplex.h>
#include <vtkGaleSegmentation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gale/mesh/segmentation.hpp>

#include "fixtures.hpp"

// What holds for all filters.

namespace gale::test {
namespace {

class Filters : public testing::Test {
 protected:
  Filters() : dataset_(synthetic(20)), grid_(grid_of(dataset_)) {}

  std::vector<vtkSmartPointer<vtkGaleAlgorithm>> all() const {
    return {vtkSmartPointer<vtkGaleCriticalPoints>::New(), vtkSmartPointer<vtkGaleMorseSmaleComplex>::New(),
            vtkSmartPointer<vtkGaleSegmentation>::New()};
  }

  io::Dataset dataset_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
};

/// Notes the filter's progress, and aborts it beyond a limit.
struct Watch {
  std::vector<double> told;
  double abort_at = 2;

  static void tell(vtkObject* caller, unsigned long, void* data, void*) {
    auto* const filter = vtkAlgorithm::SafeDownCast(caller);
    auto& watch = *static_cast<Watch*>(data);
    watch.told.push_back(filter->GetProgress());
    if (filter->GetProgress() >= watch.abort_at) filter->SetAbortExecute(1);
  }

  void observe(vtkAlgorithm& filter) {
    const auto command = vtkSmartPointer<vtkCallbackCommand>::New();
    command->SetCallback(tell);
    command->SetClientData(this);
    filter.AddObserver(vtkCommand::ProgressEvent, command);
  }
};

TEST_F(Filters, NeverChangeTheirInput) {
  const auto image = image_of(dataset_, 20);
  for (const vtkSmartPointer<vtkDataObject>& input :
       {vtkSmartPointer<vtkDataObject>(grid_.Get()), vtkSmartPointer<vtkDataObject>(image.Get())}) {
    const std::string before = content_of(input);
    for (const auto& filter : all()) {
      const auto time = input->GetMTime();
      filter->SetInputData(input);
      filter->Update();
      EXPECT_EQ(input->GetMTime(), time) << filter->GetClassName();
      EXPECT_EQ(content_of(input), before) << filter->GetClassName();
    }
  }
}

TEST_F(Filters, RefuseToGiveAPieceOfAMesh) {
  for (const auto& filter : all()) {
    filter->SetInputData(grid_);
    const std::string error = error_of(*filter, [&] { filter->UpdatePiece(1, 4, 0); });
    EXPECT_NE(error.find("asked for piece 1 of 4: the whole mesh is needed, in one process"), std::string::npos)
        << error;
    EXPECT_EQ(error_of(*filter, [&] { filter->UpdatePiece(0, 1, 0); }), "no error");
  }
}

TEST_F(Filters, TellTheirProgress) {
  for (const auto& filter : all()) {
    Watch watch;
    watch.observe(*filter);
    filter->SetNumberOfThreads(1);  // others tell nothing
    filter->SetInputData(grid_);
    filter->Update();
    EXPECT_TRUE(std::is_sorted(watch.told.begin(), watch.told.end())) << filter->GetClassName();
    EXPECT_EQ(watch.told.back(), 1) << filter->GetClassName();
    if (filter->IsA("vtkGaleSegmentation")) continue;
    EXPECT_GT(watch.told.size(), 20u) << filter->GetClassName();
  }
}

TEST_F(Filters, CanBeAborted) {
  for (const auto& filter : all()) {
    if (filter->IsA("vtkGaleSegmentation")) continue;
    Watch watch;
    watch.abort_at = 0.3;
    watch.observe(*filter);
    filter->SetNumberOfThreads(1);  // others tell nothing
    filter->SetInputData(grid_);
    EXPECT_EQ(error_of(*filter), "no error") << filter->GetClassName();
    EXPECT_LT(watch.told.back(), 0.4) << filter->GetClassName();
    EXPECT_EQ(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
    watch.abort_at = 2;
    filter->Modified();
    filter->Update();
    EXPECT_GT(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
  }
}

TEST_F(Filters, SayWhatIsWrong) {
  vtkNew<vtkDoubleArray> vectors, nan;
  vectors->SetName("vectors");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(grid_->GetNumberOfPoints());
  vectors->Fill(1);
  nan->SetName("nan");
  nan->SetNumberOfTuples(grid_->GetNumberOfPoints());
  nan->Fill(1);
  nan->SetValue(17, std::numeric_limits<double>::quiet_NaN());
  grid_->GetPointData()->AddArray(vectors);
  grid_->GetPointData()->AddArray(nan);
  for (const auto& filter : all()) {
    if (filter->IsA("vtkGaleSegmentation")) continue;
    filter->SetInputData(grid_);
    const auto error_with = [&](const char* name) {
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
      return error_of(*filter);
    };
    EXPECT_NE(error_with("nothing").find("the input has no point array 'nothing'"), std::string::npos);
    EXPECT_NE(error_with("vectors").find("array 'vectors' has 3 components, not 1"), std::string::npos);
    EXPECT_NE(error_with("nan").find("17"), std::string::npos) << error_with("nan");
    EXPECT_EQ(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
    EXPECT_EQ(error_with("field"), "no error");
  }
}

TEST_F(Filters, RefuseWhatIsNoMesh) {
  vtkNew<vtkUnstructuredGrid> empty;
  for (const auto& filter : all()) {
    filter->SetInputData(empty);
    EXPECT_NE(error_of(*filter), "no error") << filter->GetClassName();
    const vtkIdType corners[] = {0, 1, 21, 20, 400, 401, 421, 420};
    const auto mixed = grid_of(dataset_);
    mixed->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
    filter->SetInputData(mixed);
    EXPECT_NE(error_of(*filter).find("vtkHexahedron"), std::string::npos) << error_of(*filter);
  }
}

TEST_F(Filters, ImagesWithoutAFieldAreRefused) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  for (const auto& filter : all()) {
    filter->SetInputData(image);
    EXPECT_NE(error_of(*filter).find("no point array"), std::string::npos) << filter->GetClassName();
  }
}

TEST_F(Filters, PrintThemselves) {
  for (const auto& filter : all()) {
    std::ostringstream text;
    filter->Print(text);
    EXPECT_NE(text.str().find("Capacity: " + std::to_string(default_capacity)), std::string::npos);
  }
}

}  // namespace
}  // namespace gale::test
