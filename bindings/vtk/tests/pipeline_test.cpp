#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkGaleMorseSmaleComplex.h>
#include <vtkGaleSegmentation.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

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
  std::vector<std::string> texts;  ///< each as often as it changed
  double abort_at = 2;

  static void tell(vtkObject* caller, unsigned long, void* data, void*) {
    auto* const filter = vtkAlgorithm::SafeDownCast(caller);
    auto& watch = *static_cast<Watch*>(data);
    watch.told.push_back(filter->GetProgress());
    const std::string text = filter->GetProgressText() != nullptr ? filter->GetProgressText() : "";
    if (watch.texts.empty() || watch.texts.back() != text) watch.texts.push_back(text);
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

TEST_F(Filters, RefuseToGiveAPieceAtAnyPort) {
  for (int port = 0; port < 4; ++port) {
    vtkNew<vtkGaleMorseSmaleComplex> filter;
    filter->SetInputData(grid_);
    const std::string error = error_of(*filter, [&] {
      filter->UpdateInformation();
      vtkInformation* const output = filter->GetOutputInformation(port);
      output->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 4);
      output->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 1);
      filter->Update(port);
    });
    EXPECT_NE(error.find("asked for piece 1 of 4"), std::string::npos) << port << ": " << error;
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

TEST_F(Filters, TellWhatTheyDo) {
  for (const auto& filter : all()) {
    for (const bool is_image : {false, true}) {
      std::vector<std::string> expected;
      if (is_image) expected.push_back("Splitting voxels");
      expected.push_back("Dividing the mesh into segments");
      if (filter->IsA("vtkGaleCriticalPoints")) expected.push_back("Finding critical points");
      if (filter->IsA("vtkGaleMorseSmaleComplex")) {
        expected.push_back("Pairing simplices");
        expected.push_back("Tracing the complex");
      }
      Watch watch;
      watch.observe(*filter);
      is_image ? filter->SetInputData(image_of(dataset_, 20)) : filter->SetInputData(grid_);
      filter->Update();
      const auto begin = std::find(watch.texts.begin(), watch.texts.end(), expected[0]);
      EXPECT_EQ(std::vector<std::string>(begin, watch.texts.end()), expected) << filter->GetClassName();
      const std::size_t told = watch.told.size();
      filter->Update();
      EXPECT_EQ(watch.told.size(), told) << "telling changes no filter, so that nothing is done twice";
    }
  }
}

TEST_F(Filters, HaveAnOutputOfItsTypeAtEachPort) {
  vtkNew<vtkGaleCriticalPoints> points;
  vtkNew<vtkGaleMorseSmaleComplex> complex;
  vtkNew<vtkGaleSegmentation> segments;
  for (vtkGaleAlgorithm* const filter : std::initializer_list<vtkGaleAlgorithm*>{points, complex, segments}) {
    filter->SetInputData(grid_);
    filter->Update();
  }
  vtkPolyData* const found = points->GetOutput();
  EXPECT_GT(found->GetNumberOfPoints(), 0);
  EXPECT_EQ(points->GetOutput(0), found);
  vtkUnstructuredGrid* const divided = segments->GetOutput();
  EXPECT_GT(divided->GetNumberOfCells(), 0);
  EXPECT_EQ(segments->GetOutput(0), divided);
  vtkPolyData* const simplices = complex->GetOutput();
  EXPECT_GT(simplices->GetNumberOfPoints(), 0);
  const std::vector<vtkDataObject*> ports = {complex->GetCriticalPoints(), complex->GetSeparatrices1(),
                                             complex->GetSeparatrices2(), complex->GetSegmentation()};
  EXPECT_EQ(simplices, ports[0]);
  for (int port = 0; port < 4; ++port) EXPECT_EQ(complex->GetOutput(port), ports[port]) << port;
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
    for (const double told : watch.told)
      EXPECT_TRUE(told < 0.4 || told == 1)
          << told << ' ' << filter->GetClassName();  // newer VTKs tell the end themselves
    EXPECT_EQ(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
    watch.abort_at = 2;
    filter->SetAbortExecute(0);
    filter->Modified();
    filter->Update();
    EXPECT_GT(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
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
