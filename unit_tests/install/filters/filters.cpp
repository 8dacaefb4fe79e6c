#include <vtkFloatArray.h>
#include <vtkGaleCriticalPoints.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

// A slope has two critical points on a cube: its ends.
int main() {
  vtkNew<vtkImageData> image;
  vtkNew<vtkFloatArray> slope;
  image->SetDimensions(5, 5, 5);
  for (int k = 0; k < 125; ++k) slope->InsertNextValue(static_cast<float>(k));
  image->GetPointData()->SetScalars(slope);
  vtkNew<vtkGaleCriticalPoints> points;
  points->SetInputData(image);
  points->Update();
  return points->GetOutput()->GetNumberOfPoints() == 2 ? 0 : 1;
}
